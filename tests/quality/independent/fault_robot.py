"""Faults: a service of the robot standard is accepted or refused against its procedure."""

from __future__ import annotations

from collections.abc import Callable

from independent.desk import (
    Desk,
    altering,
    control,
    creation,
    download,
    loading,
    named,
    resuming,
    selection,
    starting,
)
from independent.fault import add, fault
from independent.objects import ARM, CALIBRATION, CONFLICT, DENIED, EXISTS, STATUS_CONFLICT
from independent.situations import calibrating, coasting, dead_arm, exhausted, fresh, normal, running, two
from independent.wrongly import CTRL, SEVERAL, Ask, refusing, wrongly

NOT_SELECTED = ("R-7.3.3.3.3-d0", "R-5.3.1.3.3.7-2", "R-6.3.5.6-1", "R-6.1.1-2")
ACCEPTED: tuple[tuple[str, Callable[[Desk], None], Ask, tuple[str, ...]], ...] = (
    ("start_not_selected", two, ("start", named("WELD"), starting()), NOT_SELECTED),
    ("start_none_selected", Desk.loaded, ("start", named("PAINT"), starting()), NOT_SELECTED),
    ("start_with_mode", normal("idle"), ("start", named("COUNT"), starting()), ("R-7.3.3.3.3-c1", "R-7.3.3.3.1*", "R-7.3.3.3.4.1-1")),
    ("resume_with_type", normal("stopped"), ("resume", named("COUNT"), resuming()), ("R-7.3.3.5.3-c1", "R-7.3.3.5.1*", "R-7.3.3.5.4.1-1")),
    ("start_zero", two, ("start", named("PAINT"), starting("cycleCount", 0)), ("R-7.3.3.3.1.4-*", "RP-14")),
    ("start_minus_steps", two, ("start", named("PAINT"), starting("stepCount", -2)), ("R-7.3.3.3.1.5-*", "RP-14")),
    ("alter_zero", two, ("alterPI", altering("PAINT", "cycleCount", 0), None), ("R-7.4.5*", "RP-14")),
    ("start_arm_dead", dead_arm, ("start", named("PAINT"), starting()), ("R-7.3.3.3.3-d*", "RP-15", "B-*")),
    ("start_calibrating", calibrating, ("start", named("PAINT"), starting()), ("RP-17", "R-6.3.6*")),
    ("calibrate_executing", running, ("start", named(CALIBRATION), None), ("RP-17", "R-6.3.6*")),
    ("start_arm_direct", two, ("start", named(ARM), None), ("RP-19",)),
    ("resume_count_zero", exhausted, ("resume", named("PAINT"), resuming()), ("R-7.3.3.5.3-e1",)),
    ("resume_zero_cycles", exhausted, ("resume", named("PAINT"), resuming("cycleCount", 0)), ("R-7.3.3.5.1.5-*", "RP-14")),
    ("reset_moving", coasting, ("reset", named("PAINT"), None), ("RP-07", "R-6.3.5.8-1", "R-5.3.1.3.3.8-1")),
    ("delete_moving", coasting, ("deleteProgramInvocation", "PAINT", None), ("RP-04", "R-6.1.3.2.6*", "R-6.3.4*")),
    ("delete_arm", two, ("deleteProgramInvocation", ARM, None), ("R-8.3.1-3", "B-*", "R-7.3.3.8.1-a")),
    ("delete_calibration", two, ("deleteProgramInvocation", CALIBRATION, None), ("R-8.3.2-2", "B-*", "R-7.3.3.8.1-a")),
    ("create_twice", two, ("createProgramInvocation", creation("PAINT"), 1), ("B-*", "R-7.3.3.2.3-*")),
    ("create_no_domain", two, ("createProgramInvocation", creation("NEW"), 1), ("B-*", "R-7.3.3.2.3-*")),
    ("create_used_domain", two, ("createProgramInvocation", creation("NEW", "PAINT"), 1), ("B-*", "R-7.3.3.2.3-*")),
    ("select_normal", two, ("select", selection(CALIBRATION), None), ("R-7.4.4.2-b", "R-6.1.3.2.6-2", "R-6.3.5.4-2", "R-7.4.4.1.1.1-1")),
    ("select_controlled", two, ("select", selection(ARM), None), ("R-7.4.4.2-b", "R-6.1.3.2.6-2", "R-6.3.5.4-2", "R-7.4.4.1.1.1-1")),
    ("select_unknown", two, ("select", selection("NONE"), None), ("R-7.4.4*", "RP-14", "B-*", "R-6.3.5.4*")),
    ("select_unknown_member", two, ("select", selection("PAINT", "NONE"), None), ("R-7.4.4*", "RP-14", "B-*")),
    ("select_twice", two, ("select", selection("PAINT", ARM, ARM), None), ("RP-14", "R-7.4.4*")),
    ("select_member_normal", two, ("select", selection("PAINT", CALIBRATION), None), ("R-7.4.4.2-d", "R-6.3.2.3-2")),
    ("select_member_controlling", two, ("select", selection("PAINT", "WELD"), None), ("R-7.4.4.2-d", "R-6.3.2.3-2")),
    ("select_running_itself", running, ("select", selection("PAINT", ARM), None), ("R-7.4.4.2-c", "R-7.4.4.2-e")),
    ("select_while_running", running, ("select", selection("WELD"), None), ("R-7.4.4.2-e",)),
    ("deselect_running", running, ("select", {}, None), ("R-7.4.4.2-e", "R-6.3.5.5*", "R-5.3.1.3.3.5-1")),
    ("select_dead_arm", dead_arm, ("select", selection("WELD", ARM), None), ("RP-15", "R-7.4.4*")),
    ("alter_normal", two, ("alterPI", altering(CALIBRATION), None), ("R-7.4.5.2-b", "R-7.4.5.1.1.1-1")),
    ("alter_controlled", two, ("alterPI", altering(ARM), None), ("R-7.4.5.2-b", "R-7.4.5.1.1.1-1")),
    ("alter_unknown", two, ("alterPI", altering("NONE"), None), ("R-7.4.5*", "RP-14", "B-*")),
    ("vmd_reset_executing", running, ("vMDReset", False, None), ("R-7.4.3.2-b",)),
    ("download_there", two, ("initiateDownloadSequence", download("PAINT"), None), ("B-*", "R-A5*", "R-9.2.2.2*")),
    ("load_there", two, ("loadDomainContent", loading("PAINT"), None), ("B-*", "R-9.2.2.2*")),
    ("delete_domain_used", two, ("deleteDomain", "PAINT", None), ("B-*", "R-9.2.2.2*", "R-6.3.5.3*")),
    ("delete_domain_arm", two, ("deleteDomain", ARM, None), ("B-*", "R-8.2.1-3", "R-9.2.2.2*")),
    ("delete_domain_unknown", two, ("deleteDomain", "NONE", None), ("B-*", "R-9.2.2.2*")),
)  # fmt: skip
IN_REQUEST = {
    "start_with_mode", "resume_with_type", "start_zero", "start_minus_steps", "alter_zero", "resume_zero_cycles",
}  # fmt: skip
SEEN_NEXT = {
    "calibrate_executing", "reset_moving", "delete_moving", "select_running_itself", "select_while_running",
    "deselect_running", "vmd_reset_executing",
}  # fmt: skip
FOR_A_READING = {
    "start_calibrating", "calibrate_executing", "start_arm_direct", "reset_moving", "delete_moving", "select_twice",
    "select_dead_arm", "alter_zero", "select_unknown", "select_unknown_member", "alter_unknown",
}  # fmt: skip
for _name, _come, _ask, _clauses in ACCEPTED:
    seen_next = ("*",) * (_name in SEEN_NEXT)
    add(
        _name, wrongly(_come, *_ask), *_clauses, *seen_next, back=int(_name in IN_REQUEST),
        ahead=2 * (_name in SEEN_NEXT),
        level="any" if _name in FOR_A_READING else "error",
    )  # fmt: skip


@fault("R-7.3.3.3.1.5-3", "R-7.3.3.3.4.2-2", "R-T15-1", "RP-14", robot={"steps": False}, back=1)
def start_steps_unsupported(d: Desk) -> None:
    d.ready("PAINT")
    d.accepts("start", named("PAINT"), starting("stepCount", 2), why="steps")


# Refused though nothing stands against it.
REFUSED: tuple[tuple[str, Callable[[Desk], None], Ask, tuple[str, str]], ...] = (
    ("select", Desk.loaded, ("select", selection("PAINT", ARM), None), CONFLICT),
    ("deselect", two, ("select", {}, None), CONFLICT),
    ("start_selected", two, ("start", named("PAINT"), starting()), CONFLICT),
    ("stop_arm", running, ("stop", named(ARM), None), CONFLICT),
    ("resume_selected", Desk.standing, ("resume", named("PAINT"), resuming()), CONFLICT),
    ("resume_waiting", Desk.paused, ("resume", named("PAINT"), resuming()), CONFLICT),
    ("reset_selected", Desk.standing, ("reset", named("PAINT"), None), CONFLICT),
    ("alter", two, ("alterPI", altering("PAINT"), None), CONFLICT),
    ("vmd_stop", running, ("vMDStop", None, None), CONFLICT),
    ("create", fresh, ("createProgramInvocation", creation("NEW"), 1), EXISTS),
    ("for_logical_status", two, ("select", {}, None), STATUS_CONFLICT),
    ("for_access", two, ("deleteProgramInvocation", "WELD", None), DENIED),
)  # fmt: skip
for _name, _come, _ask, _cause in REFUSED:
    add(f"refused_{_name}", refusing(_come, _cause, *_ask), "*", level="any")


# The semaphore.
@fault("*", robot=SEVERAL)
def take_taken(d: Desk) -> None:
    d.does("takeControl", control())
    d.look()
    other = Desk(d.tape, d.robot, "other").open()
    other.accepts("takeControl", control(), gives=("noResult", None))


@fault("*", robot=SEVERAL)
def relinquish_foreign(d: Desk) -> None:
    d.does("takeControl", control())
    d.look()
    Desk(d.tape, d.robot, "other").open().accepts("relinquishControl", CTRL)


@fault("*", robot=SEVERAL)
def relinquish_free(d: Desk) -> None:
    d.accepts("relinquishControl", CTRL)


@fault("*", robot=SEVERAL, level="any")
def take_refused(d: Desk) -> None:
    d.refuses("takeControl", control(), cause=DENIED)


@fault("*", robot=SEVERAL, level="any")
def relinquish_refused(d: Desk) -> None:
    d.does("takeControl", control())
    d.look()
    d.refuses("relinquishControl", CTRL, cause=DENIED)
