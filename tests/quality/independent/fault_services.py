"""Faults: a service is accepted that must be refused, or refused though nothing stands against it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from independent import views
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
    writing,
)
from independent.fault import add, fault
from independent.objects import ARM, CALIBRATION, CONFLICT, DENIED, EXISTS, STATUS_CONFLICT, UNKNOWN
from independent.server import positive
from mmsverify.samples import pdus

Ask = tuple[str, Any, Any]
SEVERAL = {"several": True}
CTRL = {"semaphoreName": pdus.vmd("R_CTRL")}
NONE: tuple[Any, Any] = (None, None)


def normal(state: str) -> Callable[[Desk], None]:
    """A NORMAL program COUNT in a state."""

    def come(d: Desk) -> None:
        d.create("COUNT", 0)
        d.attributes("COUNT")
        if state in ("running", "stopped"):
            d.run("start", "COUNT")
        if state == "stopped":
            d.run("stop", "COUNT")
        if state == "unrunnable":
            d.run("kill", "COUNT")
        d.status()
        d.attributes("COUNT")

    return come


def wrongly(come: Callable[[Desk], None], service: str, body: Any, detail: Any = None, why: str = "") -> Any:
    def run(d: Desk) -> None:
        come(d)
        gives = views.status(d.robot)[0] if service == "vMDReset" else None
        d.accepts(service, body, detail, why=why, gives=gives)

    return run


def refusing(
    come: Callable[[Desk], None], cause: tuple[str, str], service: str, body: Any, detail: Any = None
) -> Any:
    def run(d: Desk) -> None:
        come(d)
        d.refuses(service, body, detail, cause=cause)

    return run


# Services in the wrong state of the program: part 1's machine.
ADMITTED = {
    "start": {"idle"}, "stop": {"running"}, "resume": {"stopped"}, "reset": {"stopped"},
    "deleteProgramInvocation": {"idle", "stopped", "unrunnable"},
}  # fmt: skip
STEPS = {
    "start": "R-7.3.3.3.3-*", "stop": "R-7.3.3.4.1-*", "resume": "R-7.3.3.5.3-*", "reset": "R-7.3.3.6.1-*",
    "deleteProgramInvocation": "R-7.3.3.8.1-*",
}  # fmt: skip
for _service, _states in ADMITTED.items():
    _body = "COUNT" if _service == "deleteProgramInvocation" else named("COUNT")
    for _state in ("idle", "running", "stopped", "unrunnable"):
        if _state == "running" and _service in ("start", "deleteProgramInvocation", "stop"):
            continue  # it may just have ended by itself
        if _state not in _states:
            add(f"{_service}_{_state}", wrongly(normal(_state), _service, _body), "B-*", STEPS[_service])
        else:
            run = refusing(normal(_state), CONFLICT, _service, _body)
            add(f"refused_{_service}_{_state}", run, "*", level="any")
    _missing = "NONE" if _service == "deleteProgramInvocation" else named("NONE")
    add(
        f"{_service}_unknown",
        wrongly(lambda d: d.absent("NONE"), _service, _missing, why="unknown"),
        "B-*",
        "RP-14",
        STEPS[_service],
    )
add(
    "kill_unknown",
    wrongly(lambda d: d.absent("NONE"), "kill", named("NONE")),
    "B-*",
    "RP-14",
    "R-7.3.3.7.1-*",
)
add("kill_refused", refusing(normal("running"), CONFLICT, "kill", named("COUNT")), "*", level="any")
add(
    "attributes_refused",
    refusing(normal("idle"), UNKNOWN, "getProgramInvocationAttributes", "COUNT"),
    "*",
    level="any",
)

# Without R_CTRL.
GUARDED: dict[str, tuple[Ask, str]] = {
    "start": (("start", named("PAINT"), starting()), "R-7.3.3.3.3-b"),
    "stop": (("stop", named("COUNT"), None), "R-7.3.3.4.1-b"),
    "resume": (("resume", named("HOLD"), None), "R-7.3.3.5.3-b"),
    "reset": (("reset", named("HOLD"), None), "R-7.3.3.6.1-b"),
    "kill": (("kill", named("COUNT"), None), "R-7.3.3.7.1-b"),
    "delete": (("deleteProgramInvocation", "HOLD", None), "R-7.3.3.8.1-b"),
    "select": (("select", {}, None), "R-7.4.4.2-a"),
    "alter": (("alterPI", altering("PAINT", "cycleCount", 2), None), "R-7.4.5.2-a"),
    "vmd_stop": (("vMDStop", None, None), "R-7.4.2.2-1"),
    "vmd_reset": (("vMDReset", False, None), "R-7.4.3.2-a"),
}


def shop(d: Desk) -> None:
    """Programs in every state; whoever set it up holds R_CTRL."""
    if d.robot.several:
        d.does("takeControl", control())
    for name in ("COUNT", "HOLD"):
        d.create(name, 0)
        d.run("start", name)
    d.run("stop", "HOLD")
    d.ready("PAINT")


def elsewhere(d: Desk) -> None:
    """The same, and R_CTRL was given back."""
    shop(d)
    d.does("relinquishControl", CTRL)
    d.look()


def of_another(d: Desk) -> None:
    """The same, and another client has taken R_CTRL."""
    elsewhere(d)
    other = Desk(d.tape, d.robot, "other").open()
    other.does("takeControl", control())
    other.look()


for _name, (_ask, _clause) in GUARDED.items():
    for _where, _come in (("free", elsewhere), ("taken", of_another)):
        add(
            f"without_control_{_name}_{_where}", wrongly(_come, *_ask, why="control"), _clause, "R-5.1.3-2",
            "R-5.3.1.2-1", "R-8.6.1*", robot=SEVERAL,
        )  # fmt: skip

# Local control (3.2.1, RP-10), intervention (5.3.1.3.3.13, Table 8), logical status.
CHANGES: dict[str, Ask] = {
    **{name: ask for name, (ask, _) in GUARDED.items()},
    "create": ("createProgramInvocation", creation("NEW"), None),
    "write": ("write", writing("Part_Count", ("integer", 3)), None),
    "download": ("initiateDownloadSequence", download("EXTRA"), None),
    "load": ("loadDomainContent", loading("EXTRA"), None),
    "delete_domain": ("deleteDomain", "NEW", None),
}


def local(d: Desk) -> None:
    d.download("NEW")
    shop(d)
    d.panel(local=True)
    d.status()


def stopped(d: Desk) -> None:
    d.download("NEW")
    shop(d)
    d.does("vMDStop")
    d.status()
    d.look()


for _name, _ask in CHANGES.items():
    _gives = {"write": [("success", None)]}.get(_name)

    def _while_local(d: Desk, ask: Ask = _ask, gives: Any = _gives) -> None:
        local(d)
        body = views.status(d.robot)[0] if ask[0] == "vMDReset" else gives
        d.accepts(*ask, gives=body)

    add(
        f"local_{_name}",
        _while_local,
        "R-3.2.1-1",
        "R-T1-1",
        "R-6.2.1-6",
        "R-5.3.1.4*",
        "B-*",
        "RP-10",
        "RP-11",
    )

    def _while_stopped(d: Desk, ask: Ask = _ask, gives: Any = _gives) -> None:
        stopped(d)
        if ask[0] != "vMDStop":
            body = views.status(d.robot)[0] if ask[0] == "vMDReset" else gives
            d.accepts(*ask, gives=body)

    if _name != "vmd_stop":
        add(
            f"intervention_{_name}", _while_stopped, "R-5.3.1.3.3.13*", "R-5.3.1.3.2.6*", "R-T1*", "R-T8*",
            "R-7.4.2.2-5", "R-6.3.4.7*", "B-*", "RP-09", "RP-11", STEPS.get(_ask[0], "RP-09"),
        )  # fmt: skip


def limited(d: Desk) -> None:
    """Local control with LIMITED-SERVICES-PERMITTED."""
    shop(d)
    d.robot.local, d.robot.logical = True, 2
    d.unasked()


@fault("B-*", "RP-11", "R-T1*", level="any")
def limited_attributes(d: Desk) -> None:
    limited(d)
    asked = d.request("getProgramInvocationAttributes", "R_CAL")
    body, detail = views.program(d.robot, "R_CAL")
    d.say("server", positive(asked, body, detail))
    d.tape.wrong()


# Program invocations of the robot standard.
def two(d: Desk) -> None:
    """PAINT selected with the arm, WELD beside it."""
    d.create("WELD")
    d.create("TOOL", 2)
    d.ready("PAINT")
    d.absent("NEW", "NONE")


def running(d: Desk) -> None:
    d.create("WELD")
    d.create("TOOL", 2)
    d.executing("PAINT")


def calibrating(d: Desk) -> None:
    two(d)
    d.run("start", CALIBRATION)
    d.attributes(CALIBRATION)


def dead_arm(d: Desk) -> None:
    two(d)
    d.run("kill", ARM)
    d.look()


def exhausted(d: Desk) -> None:
    """PAINT has made its steps; the arm stands."""
    d.executing("PAINT", "stepCount", 1)
    d.robot.tick()
    d.look()
    d.robot.rest()
    d.look()


def coasting(d: Desk) -> None:
    """PAINT was stopped, the arm moves on."""
    running(d)
    d.run("stop", "PAINT")
    d.look()


def fresh(d: Desk) -> None:
    """A domain without a program."""
    d.absent("NEW")
    d.download("NEW")
    d.refused("getProgramInvocationAttributes", "NEW")
    d.status()


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
