"""The shortest legal way between two samples: the steps of the tasks that lead to what the second shows."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from enum import Enum, auto

from mmsverify.audit.vr.scans import PRE, Scans
from mmsverify.concrete.automaton import Edge, States
from mmsverify.model import PLUS, Clause, Row


class Phase(Enum):
    """Where in a scan a way stands: before SetPreMode, after it, after the mode changed, and set again."""

    BEGUN = auto()
    SET = auto()
    MOVED = auto()
    SET_AGAIN = auto()


@dataclass(frozen=True, slots=True)
class Stage:
    """One step of a way: the row taken and what it cites, and the mode and status after it."""

    row: Row
    clause: Clause
    mode: str
    status: str


@dataclass(frozen=True, slots=True)
class Segment:
    """What lies between two samples: the states that may hold before and after, and whether it is one scan.

    ``barred``: in one scan, the commands that were not given and the rows that do not apply. ``held`` and
    ``was``: what C_SubMD holds and held, where it is shown; ``sub_modes``: what commands set it to, ``None``
    for any number.
    """

    before: States
    after: States
    one_scan: bool
    barred: frozenset[str] = frozenset()
    held: float | None = None
    was: float | None = None
    sub_modes: Mapping[str, int | None] = field(default_factory=dict)

    def fits(self, last: str | None) -> bool:
        """Whether C_SubMD holds what ``last`` set it to, the last command of the user's, or is as it was."""
        ought = self.was if last is None else self.sub_modes[last]
        return None in (self.held, ought) or self.held == ought


@dataclass(frozen=True, slots=True)
class At:
    """Where a way has come to: the state, the phase, and the last command of the user's that was obeyed."""

    state: int
    phase: Phase
    last: str | None = None


Came = dict[At, tuple[At, Edge] | None]
"""How each point was reached first."""


def shortest(scans: Scans, between: Segment) -> tuple[Stage, ...] | None:
    """The fewest steps that lead from one sample to the next; ``None`` if none do.

    Breadth first over states and phases, so that a way is found exactly where ``Scans`` reaches the sample.
    """
    begin = [At(state, Phase.BEGUN) for state in sorted(between.before)]
    came: Came = dict.fromkeys(begin)
    ahead = deque(begin)
    while ahead:
        at = ahead.popleft()
        if _ends(at, came[at] is None, between):
            return tuple(_stage(scans, edge) for edge in reversed(list(_back(came, at))))
        for edge in scans.automaton.edges[at.state]:
            reached = _next(at, edge, between)
            if reached is not None and reached not in came:
                came[reached] = at, edge
                ahead.append(reached)
    return None


def _stage(scans: Scans, edge: Edge) -> Stage:
    mode, status = (str(scans.automaton.value(edge.target, name)) for name in ("mode", "status"))
    return Stage(edge.row, edge.row.clause, mode, status)


def _ends(at: At, at_once: bool, between: Segment) -> bool:
    """Whether the sample may be taken here: a scan has passed, or between two polled ones none."""
    passed = at.phase is not Phase.BEGUN or (at_once and not between.one_scan)
    return passed and at.state in between.after and between.fits(at.last)


def _next(at: At, edge: Edge, between: Segment) -> At | None:
    """Where a row leads in the scan; ``None`` where it does not come."""
    row, phase = edge.row, at.phase
    last = row.on.service if row.on.service in between.sub_modes and row.answer == PLUS else at.last
    if row.on.service == PRE:
        phase_then = _set(phase) if between.one_scan else Phase.SET
    elif "mode" in row.writes:
        barred = between.barred & {row.on.service, row.name}
        phase_then = Phase.MOVED if phase is Phase.SET and not barred else None
    else:
        phase_then = None if phase is Phase.SET_AGAIN or not row.writes else phase
    return None if phase_then is None else At(edge.target, phase_then, last)


def _set(phase: Phase) -> Phase | None:
    """Where SetPreMode leads within one scan: it begins it, and may have begun the next one."""
    return {Phase.BEGUN: Phase.SET, Phase.SET: Phase.SET_AGAIN, Phase.MOVED: Phase.SET_AGAIN}.get(phase)


def _back(came: Came, at: At) -> Iterator[Edge]:
    while (step := came[at]) is not None:
        at, edge = step
        yield edge
