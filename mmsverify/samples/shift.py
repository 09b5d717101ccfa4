"""The early shift of a welding robot, from switching on to the end of work: a conforming conversation.

It calibrates, loads three programs, welds batches of doors and roofs, pauses and goes on, refuses what it
must, gives control to the panel and takes it back, survives an emergency stop, ends the day with VMD Reset.
"""

from __future__ import annotations

from mmsverify.samples.cell import ARM, CALIBRATION, CONFLICT, NOT_ADMITTED, Cell, resumption, selection
from mmsverify.samples.pdus import NORMAL, controlling, enrollment, of_domain, robot_status, status, vmd
from mmsverify.samples.recording import Recording

DOOR, ROOF, GUN = "Weld_Door", "Weld_Roof", "Gun_Check"
ENROLLED = "Cell_Standstill"
IDLE, LOADED, READY = "robot-idle", "robot-loaded", "robot-ready"
EXECUTING, PAUSED, INTERVENTION = "robot-executing", "robot-motion-paused", "manualInterventionRequired"
UNCALIBRATED = ("anyPhysicalResourcePowerOn",)


def production_run() -> Recording:
    """The whole shift."""
    recording = Recording("weld7")
    cell = Cell(recording)
    morning(cell)
    calibration(cell)
    loading(cell)
    first_batch(cell)
    pauses(cell)
    single_steps(cell)
    gun_check(cell)
    panel(cell)
    emergency(cell)
    routine(cell)
    evening(cell)
    return recording


def morning(cell: Cell) -> None:
    """The association is set up; the cell controller finds out whom it is talking to."""
    cell.begin()
    maker = {"vendorName": "Nordarm", "modelName": "NW-16", "revision": "4.2.1"}
    cell.call("identify", gives=maker)
    abilities = {"listOfCapabilities": ["ARC-WELDING", "SEAM-TRACKING"], "moreFollows": False}
    cell.call("getCapabilityList", {}, gives=abilities)
    for kind in (9, 10):
        asked = {"extendedObjectClass": ("objectClass", kind), "objectScope": ("vmdSpecific", None)}
        cell.call("getNameList", asked, gives={"listOfIdentifier": [ARM, CALIBRATION], "moreFollows": False})
    cell.status(IDLE, flags=UNCALIBRATED)
    cell.arm("idle")
    cell.calibration("idle")
    cell.domain(ARM, "in-use", [ARM])
    cell.read(("R_VPWR", ("boolean", True)), ("R_VCAL", ("boolean", False)), ("R_VSAFEV", ("boolean", False)))
    cell.read(("R_VLOCAL", ("boolean", False)))
    joints = ("array", [("integer", 0)] * 6)
    cell.read((of_domain(ARM, "R_NJ"), ("integer", 6)), (of_domain(ARM, "R_JT"), joints))
    cell.call("defineEventEnrollment", enrollment(ENROLLED, ARM, ARM))


def calibration(cell: Cell) -> None:
    """The arm is calibrated by its own program."""
    cell.start(CALIBRATION)
    cell.calibration("running")
    cell.recording.wait(12)
    cell.calibration("running")
    cell.recording.wait(9)
    cell.calibration("idle")
    cell.status(IDLE)
    cell.read(("R_VCAL", ("boolean", True)))
    calibrated = ("array", [("boolean", True)] * 6)
    cell.read((of_domain(ARM, "R_DCAL"), ("integer", 0)), (of_domain(ARM, "R_JCAL"), calibrated))


def loading(cell: Cell) -> None:
    """The day's programs are loaded; program invocations are made of them."""
    cell.download(DOOR, [b"JOB DOOR", b"SEAM 1-14", b"END"])
    cell.domain(DOOR, "ready", [])
    cell.create(DOOR)
    cell.status(LOADED)
    cell.download(ROOF, [b"JOB ROOF", b"END"])
    cell.create(ROOF)
    cell.attributes(ROOF, "idle", controlling([]))
    cell.download(GUN, [b"TIP DRESS"])
    cell.create(GUN, 0)
    cell.attributes(GUN, "idle", NORMAL)
    cell.domain(DOOR, "in-use", [DOOR])
    body = {"programInvocationName": DOOR, "listOfDomainNames": [DOOR], "reusable": True}
    cell.refuse(cell.ask("createProgramInvocation", body, 1), ("definition", "object-exists"))
    cell.is_refused("start", DOOR, CONFLICT, "idle")


def first_batch(cell: Cell) -> None:
    """Five doors, watched closely."""
    cell.select(DOOR, ARM)
    cell.status(READY, DOOR)
    cell.attributes(DOOR, "idle", controlling([ARM]))
    cell.arm("idle", DOOR)
    cell.start(DOOR, cycles=5)
    cell.tell_status(EXECUTING, DOOR)
    cell.arm("running", DOOR)
    for left in (4, 3, 2):
        cell.recording.wait(41.5)
        cell.report("Part_Count", ("integer", 5 - left))
        cell.attributes(DOOR, "running", controlling([ARM], ("cycleLimited", left)))
        cell.read(("Seam_Current", ("integer", 180 + left)), ("R_VSAFEV", ("boolean", False)))
    cell.refuse(cell.ask("select", selection(ROOF, ARM)), CONFLICT)
    cell.refuse(cell.ask("deleteProgramInvocation", DOOR), CONFLICT)
    cell.status(EXECUTING, DOOR)
    cell.recording.wait(80)
    finished(cell)
    cell.attributes(DOOR, "idle", controlling([], ("cycleLimited", 0)))


def finished(cell: Cell) -> None:
    """The selected program has come to its end: the robot says so, the arm is free."""
    cell.tell_status(LOADED)
    cell.arm_left_running(ENROLLED, "idle")


def pauses(cell: Cell) -> None:
    """Roofs, interrupted in three ways: the arm alone, the program and the arm, and a change of plan."""
    cell.select(ROOF, ARM)
    cell.start(ROOF, cycles=10, at="20")
    cell.status(EXECUTING, ROOF)
    cell.run("stop", ARM)
    cell.arm_left_running(ENROLLED, "stopped", ROOF)
    cell.status(PAUSED, ROOF)
    cell.attributes(ROOF, "running", controlling([ARM], ("cycleLimited", 10)))
    cell.run("resume", ROOF, resumption())
    cell.status(EXECUTING, ROOF)
    cell.recording.wait(33)
    cell.run("stop", ROOF)
    cell.attributes(ROOF, "stopped", controlling([ARM], ("cycleLimited", 9)))
    cell.recording.wait(2)
    cell.tell_status(PAUSED, ROOF)
    cell.is_refused("start", ROOF, CONFLICT, "stopped")
    cell.run("resume", ROOF, resumption(cycles=3))
    cell.call("alterPI", {"programInvocation": ROOF, "startCount": ("cycleCount", 2)})
    cell.attributes(ROOF, "running", controlling([ARM], ("cycleLimited", 2)))
    cell.run("stop", ARM)
    cell.arm_left_running(ENROLLED, "stopped", ROOF)
    cell.run("stop", ROOF)
    cell.tell_status(PAUSED, ROOF)
    cell.run("reset", ROOF)
    cell.status(READY, ROOF)
    cell.arm("idle", ROOF)
    cell.start(ROOF, cycles=1)
    cell.recording.wait(39)
    finished(cell)


def single_steps(cell: Cell) -> None:
    """A seam is tried step by step."""
    cell.select(ROOF, ARM)
    cell.start(ROOF, steps=2)
    cell.recording.wait(6)
    cell.attributes(ROOF, "stopped", controlling([ARM], ("stepLimited", 0)))
    cell.run("resume", ROOF, resumption(steps=1))
    cell.recording.wait(3)
    cell.attributes(ROOF, "stopped", controlling([ARM], ("stepLimited", 0)))
    cell.is_refused("resume", ROOF, CONFLICT, "stopped")
    cell.run("resume", ROOF, resumption(free=True))
    cell.status(EXECUTING, ROOF)
    cell.recording.wait(20)
    finished(cell)


def gun_check(cell: Cell) -> None:
    """A program that does not move the arm; it hangs, is killed, made again."""
    cell.start(GUN)
    cell.attributes(GUN, "running", NORMAL)
    cell.run("stop", GUN)
    cell.run("reset", GUN)
    cell.start(GUN)
    cell.recording.wait(60)
    cell.attributes(GUN, "running", NORMAL)
    cell.run("kill", GUN)
    cell.attributes(GUN, "unrunnable", NORMAL)
    cell.is_refused("start", GUN, CONFLICT, "unrunnable")
    cell.call("deleteProgramInvocation", GUN)
    gone = cell.ask("getProgramInvocationAttributes", GUN)
    cell.refuse(gone, ("access", "object-non-existent"))
    cell.create(GUN, 0)


def panel(cell: Cell) -> None:
    """An operator takes local control to change a nozzle, and gives it back."""
    cell.select(DOOR, ARM)
    cell.status(READY, DOOR)
    cell.tell_status(READY, DOOR, logical=1, local=True)
    cell.read(("R_VLOCAL", ("boolean", True)))
    cell.is_refused("start", DOOR, NOT_ADMITTED, "idle")
    cell.refuse(cell.ask("select", selection(None)), NOT_ADMITTED)
    cell.recording.wait(145)
    cell.status(READY, DOOR, logical=1, local=True)
    cell.recording.wait(31)
    cell.tell_status(READY, DOOR)
    cell.read(("R_VLOCAL", ("boolean", False)))
    cell.select(None)
    cell.status(LOADED)


def emergency(cell: Cell) -> None:
    """The light curtain is broken; only the operator can end what follows."""
    cell.select(DOOR, ARM)
    cell.start(DOOR, cycles=8)
    cell.status(EXECUTING, DOOR)
    cell.recording.wait(55)
    tripped = ("safetyInterlocksViolated", "allPhysicalResourcesCalibrated")
    cell.tell_status(INTERVENTION, DOOR, logical=1, physical=3, flags=tripped)
    cell.arm_left_running(ENROLLED, "stopped", DOOR)
    cell.attributes(DOOR, "stopped", controlling([ARM], ("cycleLimited", 7)))
    cell.refuse(cell.ask("vMDReset", False), NOT_ADMITTED)
    cell.is_refused("resume", DOOR, NOT_ADMITTED, "stopped")
    cell.read(("R_VSAFEV", ("boolean", True)), ("R_VPWR", ("boolean", False)))
    cell.recording.wait(210)
    cell.tell_status(PAUSED, DOOR)
    cell.arm("stopped", DOOR)
    cell.run("resume", DOOR, resumption(cycles=7))
    cell.status(EXECUTING, DOOR)
    cell.recording.wait(300)
    finished(cell)


def routine(cell: Cell) -> None:
    """Batch after batch, doors and roofs in turn."""
    for number, job in enumerate((ROOF, DOOR, DOOR, ROOF), 1):
        cell.select(job, ARM)
        cell.start(job, cycles=4 + number)
        for done in range(1, number + 2):
            cell.recording.wait(40 + done)
            cell.status(EXECUTING, job)
            cell.report("Part_Count", ("integer", 20 * number + done))
        cell.attributes(job, "running", controlling([ARM], ("cycleLimited", 3)))
        cell.recording.wait(130)
        finished(cell)


def evening(cell: Cell) -> None:
    """A program is saved, the memory cleared, the association ended."""
    cell.call("initiateUploadSequence", DOOR, gives={"ulsmID": 1, "listOfCapabilities": []})
    segment = {"loadData": ("non-coded", b"JOB DOOR SEAM 1-14 END"), "moreFollows": False}
    cell.call("uploadSegment", 1, gives=segment)
    cell.call("terminateUploadSequence", 1)
    written = {"variableAccessSpecification": cell_variable("Shift_Done"), "listOfData": [("boolean", True)]}
    cell.call("write", written, gives=[("success", None)])
    cell.call("deleteProgramInvocation", ROOF)
    cell.call(
        "vMDReset", False, gives=status(0, 0), extra=robot_status(IDLE, UNCALIBRATED, ("noneSelected", None))
    )
    cell.arm("idle")
    cell.status(IDLE)
    cell.close()


def cell_variable(name: str) -> object:
    """One variable of the VMD, as Write names it."""
    return "listOfVariable", [{"variableSpecification": ("name", vmd(name))}]
