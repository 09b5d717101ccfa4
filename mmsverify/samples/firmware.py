"""One acceptance test before and after a new firmware of the robot: two faults mended, one made, one kept."""

from __future__ import annotations

from mmsverify.samples.cell import ARM, CONFLICT, Cell, selection
from mmsverify.samples.faults import (
    DOOR,
    EXECUTING,
    IDLE,
    INTERVENTION,
    LOADED,
    PAUSED,
    READY,
    ROOF,
    prepared,
    stop_midway,
)  # fmt: skip
from mmsverify.samples.pdus import ALL_WELL, controlling, robot_status, status
from mmsverify.samples.recording import Recording


def before() -> Recording:
    """With firmware 4.2.1."""
    cell = _prepared("4.2.1")
    cell.select(ROOF)
    cell.status(READY, ROOF)
    _put_back(cell)
    cell.start(DOOR, cycles=1)
    cell.recording.wait(45)
    cell.attributes(DOOR, "idle", controlling([], ("cycleLimited", 0)))
    return _emergency(cell, "stopped")


def after() -> Recording:
    """With firmware 4.3.0, which refuses what it must, and does not stop what it must."""
    cell = _prepared("4.3.0")
    cell.refuse(cell.ask("select", selection(ROOF)), CONFLICT)
    cell.status(PAUSED, DOOR)
    _put_back(cell)
    cell.is_refused("start", DOOR, CONFLICT, "idle")
    return _emergency(cell, "running")


def _prepared(revision: str) -> Cell:
    """Two programs, one of them stopped in the middle of its work."""
    cell = prepared("weld8", {"vendorName": "Nordarm", "modelName": "NW-16", "revision": revision})
    stop_midway(cell)
    return cell


def _put_back(cell: Cell) -> None:
    """The stopped program is put back to its beginning, and nothing is selected."""
    cell.run("reset", DOOR)
    cell.select(None)
    cell.status(LOADED)


def _emergency(cell: Cell, left: str) -> Recording:
    """VMD Stop of a running program; then what only an operator may end is ended from the cell controller."""
    cell.select(ROOF, ARM)
    cell.start(ROOF, free=True)
    cell.status(EXECUTING, ROOF)
    cell.recording.wait(18)
    cell.call("vMDStop")
    cell.status(INTERVENTION, ROOF, logical=1, physical=3)
    cell.attributes(ROOF, left, controlling([ARM]))
    cell.recording.wait(40)
    nothing = robot_status(IDLE, ALL_WELL, ("noneSelected", None))
    cell.call("vMDReset", False, gives=status(0, 0), extra=nothing)
    cell.status(IDLE)
    cell.close()
    return cell.recording
