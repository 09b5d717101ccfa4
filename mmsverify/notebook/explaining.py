"""A finding in words: the clauses as the register has them, and what led to the message."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from mmsverify.errors import InputError
from mmsverify.explaining import explain_findings, explain_sample
from mmsverify.incident import Saying
from mmsverify.incidents import statements
from mmsverify.report.finding_text import Known, as_html, as_text
from mmsverify.results import Account, Audit, Explanation, Finding

SAMPLE = "sample"


class Explained:
    """A finding explained; ``text`` is the whole of it."""

    def __init__(self, finding: Finding, text: str, html: str) -> None:
        self.finding = finding
        self.text = text
        self._html = html

    def __str__(self) -> str:
        return self.text

    __repr__ = __str__

    def _repr_html_(self) -> str:
        return self._html


def explained(finding: Finding, sayings: Sequence[Saying], profile: Path | None, variant: str) -> Explained:
    """A finding with the statements that it cites, why it stands, what it refers to, the legal way if any."""
    cited = statements(Audit([], [finding]))
    related = [said for said in sayings if said.index in finding.related]
    itself = next((said for said in sayings if said.index == finding.index), None)
    way = _way(finding, itself, profile, variant)
    account = _account(finding, profile, variant)
    known = Known(finding, cited, related, itself, way, account)
    return Explained(finding, as_text(known), as_html(known))


def _account(finding: Finding, profile: Path | None, variant: str) -> Account | None:
    """Why it stands; nothing of a file that cannot be read, which says so itself."""
    if finding.index is None:
        return None
    with suppress(InputError):
        return explain_findings(finding.path, [finding], profile=profile, variant=variant)[0]
    return None


def _way(finding: Finding, itself: Saying | None, profile: Path | None, variant: str) -> Explanation | None:
    """Of a sample: how it may follow from the one before."""
    if itself is None or itself.title != SAMPLE or itself.fault:
        return None
    return explain_sample(Path(finding.path), itself.index, profile=profile, variant=variant)
