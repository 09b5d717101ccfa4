"""Findings in the order and the groups in which a page tells them, each with the name of its anchor."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby

from mmsverify.report.order import ordered
from mmsverify.results import Audit, Finding

WHOLE = 25
"""So many findings of one rule and device are told in full; of the others one line each."""


@dataclass(frozen=True, slots=True)
class Numbered:
    """A finding with its number on the page, from 1, and whether it is told in full."""

    number: int
    finding: Finding
    whole: bool

    @property
    def anchor(self) -> str:
        """The name of its place on the page."""
        return f"finding-{self.number}"


@dataclass(frozen=True, slots=True)
class Group:
    """The findings of one device of one recording that rest on the same clause first of all."""

    path: str
    device: str
    clause: str
    findings: Sequence[Numbered]


def numbered(audit: Audit) -> list[Numbered]:
    """All findings, by path and place, numbered; of each rule and device the first are told in full."""
    met: dict[tuple[str, str | None, str], int] = {}
    made: list[Numbered] = []
    for number, finding in enumerate(ordered(audit.findings), 1):
        key = finding.path, finding.vmd, finding.rule
        met[key] = met.get(key, 0) + 1
        made.append(Numbered(number, finding, met[key] <= WHOLE))
    return made


def grouped(findings: Sequence[Numbered]) -> Iterator[Group]:
    """The same by recording, device and first clause; a group stands where its first finding does."""
    first: dict[tuple[str, str, str], int] = {}
    for each in findings:
        first.setdefault(_key(each), each.number)
    by_group = sorted(findings, key=lambda each: (first[_key(each)], each.number))
    for key, members in groupby(by_group, key=_key):
        yield Group(*key, list(members))


def _key(each: Numbered) -> tuple[str, str, str]:
    finding = each.finding
    cited = (*finding.clauses, *finding.readings)
    return finding.path, finding.vmd or "", cited[0] if cited else finding.rule
