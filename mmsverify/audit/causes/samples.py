"""The account of findings of one controller: how far back its samples must be known for the finding to come.

A sample says how the machine is, and the next ones go by all that was before; so what excludes a sample is a
stretch of samples, from one of which the whole state need not be known on to the last. The first of a stretch
is given all cells that were known there, for a cell that a sample does not show keeps its value.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from mmsverify.audit.parts import Parts
from mmsverify.audit.telling import Place
from mmsverify.errors import DecodeError
from mmsverify.formats import vr
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Account, Edit, Evidence, Finding, Ground, Statement

AFTER = 10
"""So many samples after the event must go without a new finding."""
MODE, STATUS, COMMAND, HOMED = "C_RunMD", "CS_RunSTA", "C_Cmd", "CF_Home"
SHOWN = (MODE, STATUS, COMMAND, HOMED)
NO_EDIT = "no single sample, changed or left out, would make this recording legal"
Marks = set[tuple[int | None, str]]


class Samples:
    """Tells of the findings of one controller; ``messages`` are its samples."""

    def __init__(self, parts: Parts, place: Place, messages: Sequence[TraceMessage]) -> None:
        self._parts, self._place, self._messages = parts, place, messages
        self._at = {message.index: at for at, message in enumerate(messages)}
        numbers = parts.numbering
        words = {MODE: numbers.modes, STATUS: numbers.statuses}
        self._meanings: dict[str, Mapping[int, str]] = {
            cell: {n: " or ".join(sorted(meant)) for n, meant in table.items()}
            for cell, table in words.items()
        }
        self._meanings[COMMAND] = numbers.commands
        self._cells: list[Mapping[str, Any]] = []
        held: dict[str, Any] = {}
        for message in messages:
            held = {**held, **_cells(message)}
            self._cells.append(held)

    def account(self, finding: Finding, statements: tuple[Statement, ...]) -> Account | None:
        """Why the finding stands; ``None`` where it does not come of these samples."""
        event = self._at.get(-1 if finding.index is None else finding.index)
        if event is None or not self._comes(finding, 0, event):
            return None
        first = self._latest(finding, event)
        ends = sorted({first, event - 1}) if first < event else []
        ground = Ground(tuple(map(self._evidence, ends)), irreducible=True, stretch=True)
        changes = [*self._changes(finding, first, event)]
        right = changes[0] if changes else (None, ())
        legal = [edit for edit, later in changes if not later][:1]
        if (dropped := self._dropped(first, event)) is not None:
            legal.append(dropped)
        return Account(
            finding=finding,
            event=self._words(event),
            asked=None,
            statements=statements,
            grounds=(ground,),
            right=right[0],
            later=right[1],
            edits=tuple(legal),
            remarks=() if legal else (NO_EDIT,),
        )

    def _told(self, messages: Sequence[TraceMessage]) -> Marks:
        controller = self._parts.controller(self._place)
        return {(each.index, each.rule) for said in messages for each in controller.sample(said)}

    def _from(self, first: int, end: int) -> list[TraceMessage]:
        """The samples from one on, which is given all cells that were known there, if it is sound itself."""
        if not _is_sound(self._messages[first]):
            return [*self._messages[first:end]]
        whole = replace(self._messages[first], data=json.dumps(dict(self._cells[first])).encode())
        return [whole, *self._messages[first + 1 : end]]

    def _comes(self, finding: Finding, first: int, event: int) -> bool:
        """Whether the finding comes when nothing is known before a sample; the next one may be what tells."""
        return (finding.index, finding.rule) in self._told(self._from(first, event + 2))

    def _latest(self, finding: Finding, event: int) -> int:
        """The latest sample from which on it comes."""
        back, too_late = 1, event + 1
        while not self._comes(finding, first := max(0, event - back + 1), event):
            too_late, back = first, 2 * back
        while too_late - first > 1:
            middle = (too_late + first) // 2
            if self._comes(finding, middle, event):
                first = middle
            else:
                too_late = middle
        return first

    def _evidence(self, at: int) -> Evidence:
        return Evidence(self._messages[at].index, self._words(at))

    def _words(self, at: int) -> str:
        held = self._cells[at]
        shown = ", ".join(self._cell(name, held[name]) for name in SHOWN if name in held)
        return f"sample: {shown}" if shown else "sample"

    def _cell(self, name: str, held: Any) -> str:
        """A cell with its number, and what that means."""
        meant = self._meanings.get(name, {}).get(held)
        return f"{name} {held}" if meant is None else f"{name} {held} ({meant})"

    # What would have been legal.

    def _changes(self, finding: Finding, first: int, event: int) -> Iterator[tuple[Edit, tuple[int, ...]]]:
        """The sample with a cell that may follow, and which samples after it would then be wrong.

        That the cell stays as it was comes first.
        """
        was = self._cells[max(0, event - 1)]
        told = [each.partition("=") for each in finding.expected]
        for cell, _, number in sorted(told, key=lambda each: str(was.get(each[0])) != each[2]):
            if not number.isdecimal():
                continue
            cells = {**_cells(self._messages[event]), cell: int(number)}
            other = replace(self._messages[event], data=json.dumps(cells).encode())
            new = self._new(first, event, [other])
            if finding.index not in new:
                said = ((other.topic, other.data),)
                yield (
                    Edit("change", other.index, f"shows {self._cell(cell, int(number))}", said),
                    tuple(sorted(new)),
                )

    def _dropped(self, first: int, event: int) -> Edit | None:
        if self._new(first, event, []):
            return None
        return Edit("drop", self._messages[event].index, "the sample is not there")

    def _new(self, first: int, event: int, said: Sequence[TraceMessage]) -> set[int]:
        """The samples with findings that they did not have, when others are said in place of the event."""
        after = self._messages[event + 1 : event + 2 + AFTER]
        begin = min(first, max(0, event - 1))
        before = self._from(begin, event) if begin < event else []
        here = self._messages[event]
        old = {mark for mark in self._told([*before, here, *after]) if mark[0] != here.index}
        return {int(index or 0) for index, _ in self._told([*before, *said, *after]) - old}


def _is_sound(message: TraceMessage) -> bool:
    try:
        return not vr.decode(message.data).bad
    except DecodeError:
        return False


def _cells(message: TraceMessage) -> Mapping[str, Any]:
    try:
        return {name: vr.plain(value) for name, value in vr.decode(message.data).cells.items()}
    except DecodeError:
        return {}
