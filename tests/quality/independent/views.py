"""What the robot shows: Status, attributes, named variables; each from its state at that instant."""

from __future__ import annotations

import struct
from typing import Any

from independent.controller import Controller
from independent.domains import known
from independent.domains import state as domain_state
from independent.objects import ARM, CALIBRATION, CONTROLLED, CONTROLLING, JOINTS, Answer
from mmsverify.formats.mms import number

Data = tuple[str, Any]


def status(robot: Controller, mask: str = "1111") -> Answer:
    """7.3.2.1.1; bits that the mask takes out say nothing, and are told wrong on purpose."""
    truth = [robot.violated, robot.power, robot.calibrated(), robot.local]
    bits = "".join("01"[bit if m == "1" else not bit] for bit, m in zip(truth, mask, strict=True))
    selected = ("programInvocation", robot.selected) if robot.selected else ("noneSelected", None)
    detail = {
        "robotVMDState": number("RobotVMDState", robot.state()),
        "robotSpecificStatus": bits,
        "robotSpecificStatusMask": mask,
        "selectedProgramInvocation": selected,
    }
    return {"vmdLogicalStatus": robot.logical, "vmdPhysicalStatus": robot.physical}, detail


def program(robot: Controller, name: str) -> Answer:
    """GetProgramInvocationAttributes, 7.3.3.9.2."""
    p = robot.program(name)
    body = {
        "state": number("ProgramInvocationState", p.state),
        "listOfDomainNames": list(p.domains),
        "mmsDeletable": p.deletable,
        "reusable": p.reusable,
        "monitor": False,
        "executionArgument": ("simpleString", ""),
    }
    control: Data = ("normal", None)
    if p.control == CONTROLLING:
        control = ("controlling", {"controlledPI": list(p.controlled), "runningMode": p.mode})
    elif p.control == CONTROLLED:
        control = ("controlled", ("controllingPI", p.controller) if p.controller else ("none", None))
    return body, {"errorCode": p.error, "control": control}


def domain(robot: Controller, name: str) -> Answer:
    """GetDomainAttributes."""
    d = known(robot, name)
    return {
        "listOfCapabilities": [],
        "state": number("DomainState", domain_state(robot, d)),
        "mmsDeletable": d.deletable,
        "sharable": d.sharable,
        "listOfProgramInvocations": robot.users(name),
        "uploadInProgress": d.uploads,
    }, None


def semaphore(robot: Controller) -> Answer:
    """ReportSemaphoreStatus of R_CTRL, 8.6.1."""
    owned = robot.owner is not None
    return {
        "mmsDeletable": False, "class": 0, "numberOfTokens": 1, "numberOfOwnedTokens": int(owned),
        "numberOfHungTokens": 0,
    }, None  # fmt: skip


def floating(value: float) -> Data:
    return "floating-point", b"\x08" + struct.pack(">f", value)


def pose() -> Data:
    position = ("array", [floating(v) for v in (1.0, -0.5, 0.25)])
    orientation = ("array", [floating(v) for v in (1.0, 0.0, 0.0, 0.0)])
    return "structure", [position, orientation]


def variable(robot: Controller, name: tuple[str, Any]) -> Data | None:
    """The value of a named variable, None for one that does not exist."""
    if name[0] == "vmd-specific":
        return _of_vmd(robot, name[1])
    return _of_domain(robot, name[1]["domainId"], name[1]["itemId"])


def _of_vmd(robot: Controller, item: str) -> Data | None:
    flags = {
        "R_VPWR": robot.power, "R_VCAL": robot.calibrated(), "R_VLOCAL": robot.local,
        "R_VSAFEV": robot.violated,
    }  # fmt: skip
    if item in flags:
        return "boolean", flags[item]
    return ("integer", robot.variables[item]) if item in robot.variables else None


def _of_domain(robot: Controller, domain: str, item: str) -> Data | None:
    if domain == CALIBRATION:
        return ("boolean", robot.local) if item == "R_DLOCAL" else None
    if domain != ARM:
        return None
    joints = range(JOINTS)
    calibration = 2 if robot.calibrating() else 0 if all(robot.joints) else 1
    values: dict[str, Data] = {
        "R_DPWR": ("boolean", robot.power),
        "R_DCAL": ("integer", calibration),
        "R_DLOCAL": ("boolean", robot.local),
        "R_NJ": ("integer", JOINTS),
        "R_JT": ("array", [("integer", i % 2) for i in joints]),
        "R_JCAL": ("array", [("boolean", on) for on in robot.joints]),
        "R_JBK": ("array", [("integer", i % 3) for i in joints]),
        "R_JBD": ("array", [("structure", [floating(1.5 + i), floating(-1.5 - i)]) for i in joints]),
        "R_AJV": ("array", [floating(0.1 * i) for i in joints]),
        "R_SF": floating(1.0),
        **{name: pose() for name in ("R_TUB", "R_TTM", "R_TBW", "R_ATUP", "R_CTUP", "R_AMBP")},
    }
    return values.get(item)
