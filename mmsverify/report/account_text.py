"""Why findings stand, as text: for somebody who has been up all night and has the recording open."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

from mmsverify.report.audit_text import heading
from mmsverify.report.wording import printable
from mmsverify.results import Account, Edit, Evidence, Ground

WIDTH, LABEL = 100, 12
MOST_MESSAGES, MOST_OTHERS = 8, 4
"""So many messages of one set, and so many further sets on a page; the JSON holds all."""


def render(path: str, index: int, accounts: Sequence[Account]) -> str:
    """The accounts of the findings of one message; ends with a line feed."""
    head = f"{printable(path)}: message {index}"
    if not accounts:
        return f"{head}: nothing is wrong with it\n"
    return "\n\n".join([head, *map(account, accounts)]) + "\n"


def account(told: Account) -> str:
    """One account, without a line feed at its end."""
    return "\n".join(_lines(told))


def facts(account: Account) -> Iterator[tuple[str, list[str]]]:
    """What was found out by replaying, as labels with lines: for pages that tell the rest themselves."""
    if account.grounds:
        yield "because", [because(account.grounds[0]), *_numbered(account.grounds[0])]
    others = [line for ground in account.grounds[1 : MOST_OTHERS + 1] for line in _numbered(ground)]
    if others:
        yield "excluded as well by", others
    right = (
        []
        if account.right is None or account.right in account.edits
        else [_unrelieved(account.right, account)]
    )
    legal = [edited(edit) for edit in account.edits] + right
    if legal:
        yield "nearest legal", legal
    if account.remarks:
        yield "remark", list(account.remarks)


def _numbered(ground: Ground) -> list[str]:
    """The messages of one set in a line each, the later ones of a set of several after an "and"."""
    lines = [
        f"{'and ' * (number > 0)}message {each.index}: {evidence(each)}"
        for number, each in enumerate(ground.messages[:MOST_MESSAGES])
    ]
    rest = len(ground.messages) - MOST_MESSAGES
    return [*lines, *([f"and {rest} more"] if rest > 0 else [])]


def _unrelieved(edit: Edit, account: Account) -> str:
    later = ", ".join(f"#{index}" for index in account.later)
    return f"{edited(edit)}; but then {later} would be wrong"


def _lines(account: Account) -> Iterator[str]:
    finding = account.finding
    yield heading(finding)
    if account.event:
        answers = "" if account.asked is None else f", the answer to #{account.asked}"
        yield from _told("event", f"{account.event}{answers}")
    yield from _told("wrong", finding.message)
    for statement in account.statements:
        yield from _told("clause", f"{statement.id}: {statement.says}")
    for cited, says in account.readings.items():
        yield from _told("reading", f"{cited}: {says}")
    yield from _told("cites also", " ".join(_unknown(account)))
    yield from _grounds(account)
    yield from _told("legal here", " or ".join(finding.expected))
    yield from _right(account)
    for number, edit in enumerate(account.edits):
        yield from _told("one edit" if number == 0 else "or", edited(edit))
    for remark in account.remarks:
        yield from _told("remark", remark)


def _unknown(account: Account) -> list[str]:
    """What the finding cites and nobody has words for."""
    known = {*account.readings, *(statement.id for statement in account.statements)}
    cited = (*account.finding.clauses, *account.finding.readings)
    return [each for each in cited if each not in known]


def _grounds(account: Account) -> Iterator[str]:
    """The smallest set in full, then the others: first those of one message each, under one heading."""
    for ground in account.grounds[:1]:
        yield from _told("because", because(ground))
        yield from _messages(ground)
        if len(ground.messages) > 1:
            yield from _told("earliest", f"#{ground.earliest}")
    others = account.grounds[1:]
    single = [ground for ground in others if len(ground.messages) == 1]
    if single:
        each = "each of these excludes it, too" if len(single) > 1 else "this one excludes it, too"
        yield from _told("as well", f"{each}, by itself:")
    for ground in single:
        yield from _messages(ground)
    for ground in others:
        if ground not in single:
            yield from _told("as well", "these together exclude it, too:")
            yield from _messages(ground)


def _messages(ground: Ground) -> Iterator[str]:
    for message in ground.messages[:MOST_MESSAGES]:
        yield from _told("", evidence(message), bullet=f"#{message.index}")
    yield from _told("", f"and {rest} more" if (rest := len(ground.messages) - MOST_MESSAGES) > 0 else "")


def because(ground: Ground) -> str:
    count = len(ground.messages)
    if not count:
        return "no earlier message is needed: it is wrong by itself, or with its own request"
    if ground.stretch:
        first = "these samples exclude it" if count > 1 else "this sample excludes it"
        return f"{first}, whatever was before{', with all between them' if count > 1 else ''}:"
    fewer = "" if ground.irreducible else " (fewer might do: the search was broken off)"
    what = "this message excludes it" if count == 1 else f"these {count} messages together exclude it"
    return f"{what}, whatever the others say{fewer}:"


def evidence(message: Evidence) -> str:
    asked = "" if message.asked is None else f" (asked in #{message.asked})"
    return f"{message.words}{asked}"


def _right(account: Account) -> Iterator[str]:
    """What the event should have been, where the whole would not be legal with it."""
    if account.right is None or account.right in account.edits:
        return
    yield from _told("right", _unrelieved(account.right, account))


def edited(edit: Edit) -> str:
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
