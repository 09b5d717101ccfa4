"""Why a finding stands: the messages that exclude the event, and the nearest legal conversation."""

from __future__ import annotations

from mmsverify.report.account_text import facts
from mmsverify.report.html.text import text
from mmsverify.results import Account


def why(account: Account | None) -> list[tuple[str, str]]:
    """Names and values (markup) for the list of what is told of a finding; nothing without an account."""
    if account is None:
        return []
    return [(label, "<br>".join(map(text, lines))) for label, lines in facts(account)]
