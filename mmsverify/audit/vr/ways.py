"""The shortest legal way between two samples: the steps of the tasks that lead to what the second shows."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator
from dataclasses import dataclass
from enum import Enum, auto

from mmsverify.audit.vr.scans import PRE, Scans
from mmsverify.concrete.automaton import Edge, States
from mmsverify.model import Clause, Row


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

    ``barred``: in one scan, the commands that were not given and the rows that do not apply.
    """

    before: States
    after: States
    one_scan: bool
    barred: frozenset[str] = frozenset()


def shortest(scans: Scans, between: Segment) -> tuple[Stage, ...] | None:
    """The fewest steps that lead from one sample to the next; ``None`` if none do.

    Breadth first over states and phases, so that a way is found exactly where ``Scans`` reaches the sample.
    """
    edges = scans.automaton.edges
    begin = [(state, Phase.BEGUN) for state in sorted(between.before)]
    came: dict[tuple[int, Phase], tuple[tuple[int, Phase], Edge] | None] = dict.fromkeys(begin)
    ahead = deque(begin)
    while ahead:
        at = ahead.popleft()
        if at[0] in between.after and _ends(at[1], came[at] is None, between):
            return tuple(_stage(scans, edge) for edge in reversed(list(_back(came, at))))
        for edge in edges[at[0]]:
            phase = _next(at[1], edge.row, between)
            reached = None if phase is None else (edge.target, phase)
            if reached is not None and reached not in came:
                came[reached] = at, edge
                ahead.append(reached)
    return None


def _stage(scans: Scans, edge: Edge) -> Stage:
    mode, status = (str(scans.automaton.value(edge.target, name)) for name in ("mode", "status"))
    return Stage(edge.row, edge.row.clause, mode, status)


def _ends(phase: Phase, at_once: bool, between: Segment) -> bool:
    """Whether a sample may be taken here: a scan has passed, or between two polled ones none."""
    return phase is not Phase.BEGUN or (at_once and not between.one_scan)


def _next(phase: Phase, row: Row, between: Segment) -> Phase | None:
    """Where a row leads in the scan; ``None`` where it does not come."""
    if row.on.service == PRE:
        return _set(phase) if between.one_scan else Phase.SET
    if "mode" in row.writes:
        barred = between.barred & {row.on.service, row.name}
        return Phase.MOVED if phase is Phase.SET and not barred else None
    return None if phase is Phase.SET_AGAIN or not row.writes else phase


def _set(phase: Phase) -> Phase | None:
    """Where SetPreMode leads within one scan: it begins it, and may have begun the next one."""
    return {Phase.BEGUN: Phase.SET, Phase.SET: Phase.SET_AGAIN, Phase.MOVED: Phase.SET_AGAIN}.get(phase)


def _back(
    came: dict[tuple[int, Phase], tuple[tuple[int, Phase], Edge] | None], at: tuple[int, Phase]
) -> Iterator[Edge]:
    while (step := came[at]) is not None:
        at, edge = step
        yield edge
