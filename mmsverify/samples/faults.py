"""Robots that do what they must not: short conversations with one or two faults each."""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.samples.cell import ARM, OFFERED, ROBOT_ADDITIONAL, Cell, resumption, selection
from mmsverify.samples.pdus import ALL_WELL, controlling, robot_status, status, vmd
from mmsverify.samples.recording import Recording

DOOR, ROOF = "Weld_Door", "Weld_Roof"
IDLE, LOADED, READY = "robot-idle", "robot-loaded", "robot-ready"
EXECUTING, PAUSED, INTERVENTION = "robot-executing", "robot-motion-paused", "manualInterventionRequired"
SEMAPHORE = {"semaphoreName": vmd("R_CTRL")}


def prepared(vmd_name: str, maker: Mapping[str, str] | None = None) -> Cell:
    """A robot with two task programs, nothing selected; ``maker`` is what Identify gives, if it is asked."""
    cell = Cell(Recording(vmd_name))
    cell.begin()
    if maker is not None:
        cell.call("identify", gives=maker)
    cell.status(IDLE)
    cell.arm("idle")
    for name in (DOOR, ROOF):
        cell.download(name, [b"JOB", b"END"])
        cell.create(name)
    cell.status(LOADED)
    return cell


def stop_midway(cell: Cell) -> None:
    """One of the programs is stopped in the middle of its work."""
    cell.select(DOOR, ARM)
    cell.start(DOOR, cycles=4)
    cell.status(EXECUTING, DOOR)
    cell.recording.wait(20)
    cell.run("stop", DOOR)
    cell.recording.wait(2)
    cell.tell_status(PAUSED, DOOR)
    cell.attributes(DOOR, "stopped", controlling([ARM], ("cycleLimited", 3)))


def faulty_select() -> Recording:
    """Select does not ask whether the selected program is through; Start does not ask what is selected."""
    cell = prepared("weld3")
    stop_midway(cell)
    cell.select(ROOF)
    cell.recording.wait(5)
    cell.status(READY, ROOF)
    cell.attributes(ROOF, "idle", controlling([]))
    cell.run("kill", DOOR)
    cell.call("deleteProgramInvocation", DOOR)
    cell.create(DOOR)
    cell.select(None)
    cell.status(LOADED)
    cell.recording.wait(3)
    cell.start(DOOR, cycles=1)
    cell.recording.wait(45)
    cell.attributes(DOOR, "idle", controlling([], ("cycleLimited", 0)))
    cell.status(LOADED)
    cell.close()
    return cell.recording


def faulty_vmd_stop() -> Recording:
    """VMD Stop lets the task program run on; VMD Reset ends what only an operator may end."""
    cell = prepared("weld5")
    cell.select(ROOF, ARM)
    cell.start(ROOF, free=True)
    cell.status(EXECUTING, ROOF)
    cell.recording.wait(18)
    cell.call("vMDStop")
    cell.status(INTERVENTION, ROOF, logical=1, physical=3)
    cell.arm("stopped", ROOF)
    cell.attributes(ROOF, "running", controlling([ARM]))
    cell.recording.wait(40)
    nothing = robot_status(IDLE, ALL_WELL, ("noneSelected", None))
    cell.call("vMDReset", False, gives=status(0, 0), extra=nothing)
    cell.status(IDLE)
    cell.arm("idle")
    cell.close()
    return cell.recording


def two_clients() -> Recording:
    """Two clients share a robot by R_CTRL; once, it forgets to ask who holds it."""
    cell = prepared_for_two()
    station = Cell(cell.recording, "maintenance")
    station.open(OFFERED, ROBOT_ADDITIONAL, 2)
    station.status(LOADED)
    taken = station.ask("takeControl", SEMAPHORE)
    station.refuse(taken, ("service", "object-state-conflict"))
    cell.select(DOOR, ARM)
    cell.start(DOOR, free=True)
    station.status(EXECUTING, DOOR)
    station.run("stop", ARM)
    station.status(PAUSED, DOOR)
    cell.run("resume", DOOR, resumption())
    cell.run("stop", DOOR)
    cell.recording.wait(2)
    cell.status(PAUSED, DOOR)
    cell.run("reset", DOOR)
    cell.call("relinquishControl", SEMAPHORE)
    station.call("takeControl", SEMAPHORE, gives=("noResult", None))
    refused = cell.ask("select", selection(None))
    cell.refuse(refused, ("access", "object-access-denied"))
    station.select(None)
    station.close()
    cell.call("takeControl", SEMAPHORE, gives=("noResult", None))
    cell.status(LOADED)
    cell.close()
    return cell.recording


def prepared_for_two() -> Cell:
    """A robot with one task program; the cell controller has taken control to make it."""
    cell = Cell(Recording("weld9"))
    cell.begin(2)
    cell.call("takeControl", SEMAPHORE, gives=("noResult", None))
    cell.download(DOOR, [b"JOB", b"END"])
    cell.create(DOOR)
    return cell
