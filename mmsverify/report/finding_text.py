"""One finding explained, as text and as a piece of HTML: the same facts in the same order."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mmsverify.incident import Saying
from mmsverify.report.account_text import facts
from mmsverify.report.audit_text import heading
from mmsverify.report.carried import in_short
from mmsverify.report.explanation_text import render
from mmsverify.report.markup import code, element, folding, joined, text, word
from mmsverify.report.wording import assignments, instant, printable
from mmsverify.results import Account, Explanation, Finding

WIDTH = 96
BEFORE = "known before"
Told = tuple[str, list[str]]
"""A label, and the lines that belong to it."""


@dataclass(frozen=True, slots=True)
class Known:
    """All there is to tell of a finding.

    ``cited``: what statements and readings say, by id; ``related``: the messages that it refers to;
    ``itself``: its own; ``way``: how a sample may follow; ``account``: why it stands.
    """

    finding: Finding
    cited: Mapping[str, str]
    related: Sequence[Saying]
    itself: Saying | None = None
    way: Explanation | None = None
    account: Account | None = None


def as_text(known: Known) -> str:
    """The finding for a terminal; ends with a line feed."""
    finding = known.finding
    lines = [heading(finding), printable(finding.message)]
    for label, told in _facts(known):
        lines += ["", f"{label}:"]
        for line in told:
            lines += textwrap.wrap(line, WIDTH, initial_indent="  ", subsequent_indent="    ")
    return "\n".join(lines) + "\n"


def as_html(known: Known) -> str:
    """The finding as a piece of a page."""
    finding = known.finding
    place = "" if finding.index is None else f" #{finding.index}"
    time = "" if finding.time is None else f" {instant(finding.time)}"
    parts = [element("p", word(finding.severity), " ", code(finding.rule), place + time)]
    parts.append(element("p", element("b", finding.message)))
    for label, told in _facts(known):
        listed = element("ul", *(element("li", text(line)) for line in told))
        if label == BEFORE:
            parts.append(folding(label, listed))
        elif len(told) == 1:
            parts.append(element("p", element("i", f"{label}: "), told[0]))
        else:
            parts.append(joined([element("i", label), listed]))
    return element("div", *parts)


def _facts(known: Known) -> Iterator[Told]:
    finding, cited, itself = known.finding, known.cited, known.itself
    if itself is not None:
        yield "the message", [_said(itself)]
    yield "clauses broken", [_clause(each, cited) for each in finding.clauses]
    if finding.readings:
        yield "read as", [_clause(each, cited) for each in finding.readings]
    if finding.observed:
        yield "observed", [printable(finding.observed)]
    if finding.expected:
        yield "would have been legal", [" or ".join(map(printable, finding.expected))]
    if known.account is not None:
        yield from facts(known.account)
    if known.related:
        yield "what it refers to", [_said(each) for each in known.related]
    if known.way is not None:
        yield "how a sample may follow", [line.strip() for line in render(known.way, ()).splitlines()[1:]]
    if finding.before:
        yield BEFORE, assignments(finding.before)


def _clause(name: str, cited: Mapping[str, str]) -> str:
    says = cited.get(name, "")
    return printable(f"{name}: {says}" if says else name)


def _said(said: Saying) -> str:
    who = {"client": f"{said.partner} to {said.device}", "server": f"{said.device} to {said.partner}"}
    told = f"#{said.index} {instant(said.time)} {who.get(said.sender, said.device)}: {said.title}"
    if said.about and said.about not in in_short(said):
        told += f" ({said.about})"
    return " ".join(part for part in (printable(told), in_short(said)) if part)
