"""Why findings stand, as text: for somebody who has been up all night and has the recording open."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

from mmsverify.report.audit_text import heading
from mmsverify.report.wording import printable
from mmsverify.results import Account, Edit, Evidence, Ground

WIDTH, LABEL = 100, 12


def render(path: str, index: int, accounts: Sequence[Account]) -> str:
    """The accounts of the findings of one message; ends with a line feed."""
    head = f"{printable(path)}: message {index}"
    if not accounts:
        return f"{head}: nothing is wrong with it\n"
    return "\n\n".join([head, *("\n".join(_lines(each)) for each in accounts)]) + "\n"


def _lines(account: Account) -> Iterator[str]:
    finding = account.finding
    yield heading(finding)
    if account.event:
        answers = "" if account.asked is None else f", the answer to #{account.asked}"
        yield from _told("event", f"{account.event}{answers}")
    yield from _told("wrong", finding.message)
    for statement in account.statements:
        yield from _told("clause", f"{statement.id}: {statement.says}")
    readings = [*finding.readings, *_unknown(account)]
    yield from _told("cites also", " ".join(readings))
    yield from _grounds(account)
    yield from _told("legal here", " or ".join(finding.expected))
    yield from _right(account)
    for number, edit in enumerate(account.edits):
        yield from _told("one edit" if number == 0 else "or", _edit(edit))
    for remark in account.remarks:
        yield from _told("remark", remark)


def _unknown(account: Account) -> list[str]:
    """Clauses whose statement no register of ours has."""
    known = {statement.id for statement in account.statements}
    return [clause for clause in account.finding.clauses if clause not in known]


def _grounds(account: Account) -> Iterator[str]:
    for number, ground in enumerate(account.grounds):
        yield from _told("because" if number == 0 else "as well", _because(ground, first=number == 0))
        for message in ground.messages:
            yield from _told("", _evidence(message), bullet=f"#{message.index}")
    if account.earliest is not None and len(account.grounds[0].messages) > 1:
        yield from _told("earliest", f"#{account.earliest}")


def _because(ground: Ground, *, first: bool) -> str:
    count = len(ground.messages)
    if not count:
        return "no earlier message is needed: it is wrong by itself, or with its own request"
    if ground.stretch:
        return "the samples from the first of these to the last exclude it, whatever was before"
    fewer = "" if ground.irreducible else " (fewer might do: the search was broken off)"
    if first:
        what = "this message excludes it" if count == 1 else f"these {count} messages together exclude it"
        return f"{what}, whatever any other says{fewer}"
    return f"{'this' if count == 1 else 'these together'} would exclude it without those above{fewer}"


def _evidence(message: Evidence) -> str:
    asked = "" if message.asked is None else f" (asked in #{message.asked})"
    return f"{message.words}{asked}"


def _right(account: Account) -> Iterator[str]:
    """What the event should have been, where the whole would not be legal with it."""
    if account.right is None or account.right in account.edits:
        return
    later = ", ".join(f"#{index}" for index in account.later)
    yield from _told("right", f"{_edit(account.right)}; but then {later} would be wrong")


def _edit(edit: Edit) -> str:
    if edit.kind == "insert":
        return f"put in before #{edit.index}: {edit.words}"
    if edit.kind == "drop":
        both = f"#{edit.index}" if edit.asked is None else f"#{edit.asked} and #{edit.index}"
        return f"leave out {both}: {edit.words}"
    return f"change #{edit.index}: it {edit.words}"


def _told(label: str, text: str, *, bullet: str = "") -> Iterator[str]:
    """The text under its label, folded; nothing where there is none."""
    if not text:
        return
    begin = f"  {label:<{LABEL}}" + (f"{bullet:<6}" if bullet else "")
    indent = " " * len(begin)
    yield from textwrap.wrap(
        printable(text), WIDTH, initial_indent=begin, subsequent_indent=indent, break_long_words=False,
        break_on_hyphens=False,
    )  # fmt: skip
