"""Faults: the robot shows what is not so, of itself, its programs, domains and variables, or of R_CTRL."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from independent.desk import Desk, control, name_of
from independent.fault import (
    add,
    bodied,
    both,
    chosen,
    detailed,
    flipped,
    program_state,
    robot_state,
    value,
)
from independent.objects import ARM, CALIBRATION
from independent.situations import coasting, dead_arm, exhausted, normal, running, two
from independent.views import floating
from mmsverify.formats.mms import Pdu
from mmsverify.samples import pdus

Change = Callable[[Pdu], Pdu]
Come = Callable[[Desk], None]


def lying(come: Come, change: Change, service: str, body: Any) -> Come:
    def run(d: Desk) -> None:
        come(d)
        d.lies(change, service, body)

    return run


def untold(come: Come, change: Change) -> Come:
    """The same in a status that nobody asked for."""

    def run(d: Desk) -> None:
        come(d)
        at = d.request("status", False)
        outcome = d.perform(at)
        d.say("server", outcome.pdu)
        lie = change(outcome.pdu)
        d.tell("unsolicitedStatus", lie.body, lie.detail)
        d.tape.wrong()

    return run


def intervention(d: Desk) -> None:
    running(d)
    d.does("vMDStop")
    d.status()


def local(d: Desk) -> None:
    two(d)
    d.panel(local=True)
    d.status()


SHOWN = ("R-7.3.2.1.1.1-1", "R-6.1.3.1-2")
STATUS: tuple[tuple[str, Come, Change, tuple[str, ...]], ...] = (
    ("idle_but_loaded", Desk.loaded, robot_state("robot-idle"), (*SHOWN, "R-6.3.4.2*", "R-5.3.1.3.2.1-1")),
    ("loaded_but_empty", Desk.status, robot_state("robot-loaded"), (*SHOWN, "R-6.3.4.3-1", "R-5.3.1.3.2.2-1")),
    ("ready_but_loaded", Desk.loaded, robot_state("robot-ready"), (*SHOWN, "R-6.3.4.4-1", "R-6.1.3.2.6*", "R-7.3.2.1.1.4-1")),
    ("executing_but_loaded", Desk.loaded, robot_state("robot-executing"), (*SHOWN, "R-6.3.4.5-2", "R-6.1.3.2.6*", "R-7.3.2.1.1.4-1")),
    ("paused_but_loaded", Desk.loaded, robot_state("robot-motion-paused"), (*SHOWN, "R-6.3.4.6-2", "R-6.1.3.2.6*", "R-7.3.2.1.1.4-1")),
    ("executing_but_ready", two, robot_state("robot-executing"), (*SHOWN, "R-6.3.4.5*", "R-6.3.5.6-1")),
    ("paused_but_ready", two, robot_state("robot-motion-paused"), (*SHOWN, "R-6.3.4.6*")),
    ("loaded_but_ready", two, robot_state("robot-loaded"), (*SHOWN, "R-6.3.4.3-1", "R-6.1.3.2.6*", "R-7.3.2.1.1.4-1")),
    ("idle_but_ready", two, robot_state("robot-idle"), (*SHOWN, "R-6.3.4.2*", "R-6.1.3.2.6*", "R-7.3.2.1.1.4-1")),
    ("ready_but_executing", running, robot_state("robot-ready"), (*SHOWN, "R-6.3.4.4-1")),
    ("executing_but_paused", Desk.standing, robot_state("robot-executing"), (*SHOWN, "R-6.3.4.5*")),
    ("ready_but_paused", Desk.standing, robot_state("robot-ready"), (*SHOWN, "R-6.3.4.4-1")),
    ("intervention_operational", two, both(robot_state("manualInterventionRequired"), bodied(vmdLogicalStatus=1)), ("R-6.3.4.7-3",)),
    ("intervention_all_allowed", two, both(robot_state("manualInterventionRequired"), bodied(vmdPhysicalStatus=3)), ("R-T1-2", "R-6.3.4.7-2")),
    ("local_all_allowed", two, flipped(3), ("R-T1-1",)),
    ("stopped_operational", intervention, bodied(vmdPhysicalStatus=0), ("R-6.3.4.7-3", "R-T8-4")),
    ("stopped_all_allowed", intervention, bodied(vmdLogicalStatus=0), ("R-T1-2", "R-6.3.4.7-2", "R-T8-3", "R-7.4.2.2-5")),
    ("still_all_allowed", local, bodied(vmdLogicalStatus=0), ("R-T1-1",)),
    ("another_selected", two, chosen("WELD"), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.4.4-1")),
    ("arm_selected", two, chosen(ARM), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.5.4-2", "R-6.3.4.4-1")),
    ("unknown_selected", two, chosen("NONE"), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.5.4-2", "R-6.3.4.4-1")),
    ("none_selected", two, chosen(None), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.4.4-1")),
    ("none_selected_executing", running, chosen(None), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.4.5*")),
    ("selected_in_loaded", Desk.loaded, chosen("PAINT"), ("R-7.3.2.1.1.4-1", "R-6.1.3.2.6*", "R-6.3.4.3-1", "R-6.3.5.4*")),
    ("no_such_state", two, detailed(robotVMDState=9), ("R-7.3.2.1.2-3", *SHOWN)),
    ("no_logical_status", two, bodied(vmdLogicalStatus=7), ("*",)),
)  # fmt: skip
for _name, _come, _change, _clauses in STATUS:
    add(f"status_{_name}", lying(_come, _change, "status", False), *_clauses)
    if _name in (
        "idle_but_loaded",
        "none_selected_executing",
        "executing_but_ready",
        "local_all_allowed",
        "stopped_operational",
    ):
        add(f"unasked_{_name}", untold(_come, _change), *_clauses)


def empty_after_select(d: Desk) -> None:
    two(d)


MODE = (
    "R-7.3.3.9*",
    "R-6.3.2.5*",
    "R-6.3.2.6-1",
    "R-6.3.2.7-1",
    "R-7.3.3.3.3-e*",
    "R-6.3.8.3-1",
    "R-7.3.3.3*",
    "R-7.4.5*",
)


def controlling(listed: list[str], mode: tuple[str, Any] = ("freeRunning", None)) -> Change:
    return detailed(control=("controlling", {"controlledPI": listed, "runningMode": mode}))


def cycles(d: Desk) -> None:
    d.executing("PAINT", "cycleCount", 2)


PART = ("R-7.3.3.9*", "R-6.3.8.3-1", "B-*")
ATTRIBUTES: tuple[tuple[str, Come, str, Change, tuple[str, ...]], ...] = (
    ("running_unstarted", two, "PAINT", program_state("running"), ("*",)),
    ("stopped_unstarted", two, "PAINT", program_state("stopped"), ("*",)),
    ("unrunnable_selected", two, "PAINT", program_state("unrunnable"), ("*",)),
    ("unrunnable_idle", normal("idle"), "COUNT", program_state("unrunnable"), ("*",)),
    ("dead_arm_idle", dead_arm, ARM, program_state("idle"), ("*",)),
    ("coasting_arm_idle", coasting, ARM, program_state("idle"), ("*",)),
    ("paused_arm_running", Desk.paused, ARM, program_state("running"), ("*",)),
    ("stopped_running", Desk.standing, "PAINT", program_state("running"), ("*",)),
    ("transient_state", normal("idle"), "COUNT", program_state("resetting"), ("*",)),
    ("other_domains", two, "PAINT", bodied(listOfDomainNames=["WELD"]), (*PART, "R-7.3.3.2.3-0")),
    ("arm_other_domains", two, ARM, bodied(listOfDomainNames=["R_SAFE"]), (*PART, "R-8.3.1-*")),
    ("arm_deletable", two, ARM, bodied(mmsDeletable=True), ("R-8.3.1-3",)),
    ("arm_not_reusable", two, ARM, bodied(reusable=False), ("R-8.3.1-4",)),
    ("calibration_deletable", two, CALIBRATION, bodied(mmsDeletable=True), ("R-8.3.2-2",)),
    ("calibration_not_reusable", two, CALIBRATION, bodied(reusable=False), ("R-8.3.2-2",)),
    ("calibration_other_domains", two, CALIBRATION, bodied(listOfDomainNames=[ARM]), ("R-8.3.2-2", *PART)),
    ("not_reusable", two, "PAINT", bodied(reusable=False), (*PART, "R-7.3.3.2.3-0")),
    ("not_deletable", two, "PAINT", bodied(mmsDeletable=False), (*PART, "R-7.3.3.2.3-0")),
    ("error_after_creation", Desk.loaded, "PAINT", detailed(errorCode=5), (*PART, "R-7.3.3.2.3-0", "R-6.3.2.1-1")),
    ("arm_controlling", two, ARM, controlling([]), ("R-8.3.1-6", *PART)),
    ("arm_normal", two, ARM, detailed(control=("normal", None)), ("R-8.3.1-6", *PART)),
    ("calibration_controlling", two, CALIBRATION, controlling([]), ("R-8.3.2-3", "R-6.3.6-7", *PART)),
    ("selected_normal", two, "PAINT", detailed(control=("normal", None)), (*PART, "R-6.1.3.2.6-2", "R-7.3.3.2.*")),
    ("count_controlling", normal("idle"), "COUNT", controlling([]), (*PART, "R-7.3.3.2.*")),
    ("list_empty", two, "PAINT", controlling([]), (*PART, "R-7.4.4.2-*", "R-6.3.2.3-2", "R-6.3.2.8*")),
    ("list_more", two, "PAINT", controlling([ARM, "TOOL"]), (*PART, "R-7.4.4.2-*", "R-6.3.2.3-2", "R-6.3.2.8*")),
    ("list_of_unselected", two, "WELD", controlling([ARM]), (*PART, "R-7.4.4.2-*", "R-6.3.2.3-2", "R-6.3.1-3", "R-7.3.3.1-4", "R-7.3.3.2.3-a")),
    ("arm_elsewhere", two, ARM, detailed(control=("controlled", ("controllingPI", "WELD"))), (*PART, "R-7.4.4.2-*", "R-6.3.2.8*", "R-6.3.4.4-1", "R-6.3.1-3", "R-6.3.2.3-2")),
    ("arm_uncontrolled", two, ARM, detailed(control=("controlled", ("none", None))), (*PART, "R-7.4.4.2-*", "R-6.3.2.8*", "R-6.3.4.4-1", "R-6.3.2.3-2")),
    ("arm_controlled_in_loaded", Desk.loaded, ARM, detailed(control=("controlled", ("controllingPI", "PAINT"))), (*PART, "R-6.3.4.3-1", "R-6.3.2.8*")),
    ("tool_controlled", two, "TOOL", detailed(control=("controlled", ("controllingPI", "PAINT"))), (*PART, "R-6.3.2.8*", "R-7.4.4.2-*", "R-7.3.3.2.3-b")),
    ("mode_after_creation", Desk.loaded, "PAINT", controlling([], ("cycleLimited", 4)), (*MODE, "R-7.3.3.2.3-a")),
    ("mode_after_start", running, "PAINT", controlling([ARM], ("stepLimited", 4)), MODE),
    ("cycles_more", cycles, "PAINT", controlling([ARM], ("cycleLimited", 5)), MODE),
    ("cycles_free", cycles, "PAINT", controlling([ARM]), MODE),
    ("steps_left", exhausted, "PAINT", controlling([ARM], ("stepLimited", 1)), MODE),
    ("cycles_negative", cycles, "PAINT", controlling([ARM], ("cycleLimited", -1)), MODE),
)  # fmt: skip
for _name, _come, _item, _change, _clauses in ATTRIBUTES:
    # The arm's program may end by itself, until the robot is seen EXECUTING again.
    add(
        f"attributes_{_name}", lying(_come, _change, "getProgramInvocationAttributes", _item), *_clauses,
        ahead=2 * (_name == "coasting_arm_idle"),
    )  # fmt: skip

DOMAIN = ("R-9.2.2.2*", "B-*")
DOMAINS: tuple[tuple[str, Come, str, Change, tuple[str, ...]], ...] = (
    ("arm_deletable", two, ARM, bodied(mmsDeletable=True), ("R-8.2.1-3",)),
    ("arm_not_sharable", two, ARM, bodied(sharable=False), ("R-8.2.1-3",)),
    ("arm_users", two, ARM, bodied(listOfProgramInvocations=[ARM, "PAINT"]), ("R-8.2.1-4", "B-DOMAIN")),
    ("calibration_sharable", two, CALIBRATION, bodied(sharable=True), ("R-8.2.2-2",)),
    ("calibration_deletable", two, CALIBRATION, bodied(mmsDeletable=True), ("R-8.2.2-2",)),
    ("calibration_users", two, CALIBRATION, bodied(listOfProgramInvocations=[]), ("R-8.2.2-2", "B-DOMAIN")),
    ("safety_deletable", two, "R_SAFE", bodied(mmsDeletable=True), ("R-8.2.3-2",)),
    ("safety_sharable", two, "R_SAFE", bodied(sharable=True), ("R-8.2.3-2",)),
    ("used_ready", two, "PAINT", bodied(state=2, listOfProgramInvocations=[]), DOMAIN),
    ("loading", two, "PAINT", bodied(state=1, listOfProgramInvocations=[]), DOMAIN),
    ("users", two, "PAINT", bodied(listOfProgramInvocations=["WELD"]), DOMAIN),
)  # fmt: skip
for _name, _come, _item, _change, _clauses in DOMAINS:
    add(f"domain_{_name}", lying(_come, _change, "getDomainAttributes", _item), *_clauses)

NUMBERS = [("integer", 0)] * 6
VARIABLES: tuple[tuple[str, str, Change, tuple[str, ...]], ...] = (
    ("vpwr_type", "R_VPWR", value("integer", 1), ("R-8.5.3.1-1",)),
    ("vcal_type", "R_VCAL", value("visible-string", "yes"), ("R-8.5.3.2-1",)),
    ("vlocal_type", "R_VLOCAL", value("visible-string", "no"), ("R-8.5.3.3-1",)),
    ("vsafev_type", "R_VSAFEV", value("integer", 0), ("R-8.5.3.4-1",)),
    ("dpwr_type", "R_ARM.R_DPWR", value("integer", 1), ("R-8.5.4.1-1",)),
    ("dcal_value", "R_ARM.R_DCAL", value("integer", 3), ("R-8.5.4.2-1",)),
    ("dcal_type", "R_ARM.R_DCAL", value("boolean", True), ("R-8.5.4.2-1",)),
    ("dlocal_type", "R_ARM.R_DLOCAL", value("integer", 0), ("R-8.5.4.3-1",)),
    ("nj_type", "R_ARM.R_NJ", value("boolean", True), ("R-8.5.5.1-1",)),
    ("nj_range", "R_ARM.R_NJ", value("integer", 300), ("R-8.5.5.1-1",)),
    ("jt_value", "R_ARM.R_JT", value("array", [("integer", 2), *NUMBERS[1:]]), ("R-8.5.5.2-1",)),
    ("jt_length", "R_ARM.R_JT", value("array", NUMBERS[1:]), ("R-8.5.5.2-1", "R-8.5.5.1-1")),
    ("jt_scalar", "R_ARM.R_JT", value("integer", 1), ("R-8.5.5.2-1",)),
    ("jcal_numbers", "R_ARM.R_JCAL", value("array", NUMBERS), ("R-8.5.5.3-1",)),
    ("jbk_value", "R_ARM.R_JBK", value("array", [("integer", 3), *NUMBERS[1:]]), ("R-8.5.5.4-1",)),
    ("jbd_flat", "R_ARM.R_JBD", value("array", [floating(1.0)] * 6), ("R-8.5.5.5-1",)),
    ("jbd_reversed", "R_ARM.R_JBD", value("array", [("structure", [floating(-1.0), floating(1.0)])] * 6), ("R-6.2.2.8.2.4-1", "R-8.5.5.5-1")),
    ("ajv_integers", "R_ARM.R_AJV", value("array", NUMBERS), ("R-8.5.5.6-1",)),
    ("ajv_length", "R_ARM.R_AJV", value("array", [floating(1.0)] * 5), ("R-8.5.5.6*", "R-8.5.5.1-1")),
    ("tub_flat", "R_ARM.R_TUB", value("array", [floating(1.0)] * 7), ("R-8.5.5.7-1", "R-8.4*")),
    ("ttm_short", "R_ARM.R_TTM", value("structure", [("array", [floating(1.0)] * 2), ("array", [floating(1.0)] * 4)]), ("R-8.5.5.8-1", "R-8.4*")),
    ("sf_integer", "R_ARM.R_SF", value("integer", 1), ("R-8.5.5.13-1",)),
)  # fmt: skip
for _name, _item, _change, _clauses in VARIABLES:

    def _wrong(d: Desk, item: str = _item, change: Change = _change) -> None:
        two(d)
        d.read("R_ARM.R_NJ")
        d.lies(change, "read", pdus.reading(name_of(item)))

    add(f"variable_{_name}", _wrong, *_clauses)


def semaphore(**fields: Any) -> Come:
    def run(d: Desk) -> None:
        d.does("takeControl", control())
        d.lies(bodied(**fields), "reportSemaphoreStatus", pdus.vmd("R_CTRL"))

    return run


for _name, _fields, _clauses in (
    ("deletable", {"mmsDeletable": True}, ("R-8.6.1-1",)),
    ("pool", {"class": 1}, ("R-8.6.1-1",)),
    ("two_tokens", {"numberOfTokens": 2}, ("R-8.6.1-2",)),
    ("none_owned", {"numberOfOwnedTokens": 0}, ("R-8.6.1-3", "B-*", "R-9.2.2.1*")),
    ("two_owned", {"numberOfOwnedTokens": 2}, ("R-8.6.1*", "B-*")),
):
    add(f"semaphore_{_name}", semaphore(**_fields), *_clauses, robot={"several": True})
