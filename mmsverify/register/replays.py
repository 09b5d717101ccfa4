"""Which sample recordings exercise a statement: by the rows that a replay takes, and by its findings."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path

from mmsverify.audit.parts import FRAMEWORK, ROBOT, SIGNALS
from mmsverify.audit.replay import Replay
from mmsverify.formats.mcap import read_trace
from mmsverify.profiles import for_recording
from mmsverify.results import Exercise, Register


def replayed(root: Path, register: Register) -> Iterator[tuple[str, Exercise]]:
    """What the samples of the checkout at ``root`` exercise of a register whose model judges recordings."""
    if register.model not in (ROBOT, FRAMEWORK, SIGNALS):
        return
    known = {entry.statement.id for entry in register.entries}
    for path in sorted(root.glob("traces/*.mcap")):
        yield from ((i, Exercise("sample", path.name)) for i in sorted(exercised(path) & known))


@cache
def exercised(path: Path) -> frozenset[str]:
    """The statements that the rows taken in a replay and its findings cite."""
    trace = read_trace(path)
    tables = for_recording(None, trace.profile, str(path))
    replay = Replay(trace, tables, None, "repaired")
    cited = {i for finding in replay.run() for i in finding.clauses}
    return frozenset(cited) | {
        i for coverage in replay.coverage for clause in coverage.clauses for i in clause.ids
    }
