"""MMS PDUs as events of the robot model: services performed with their arguments, attributes shown.

Only the meaning of fields is here. Nothing is judged, no state is kept.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.audit import words
from mmsverify.formats.mms import Pdu, error_class_code

OBSERVING = frozenset(
    {
        "status",
        "getProgramInvocationAttributes",
        "getDomainAttributes",
        "read",
        "reportSemaphoreStatus",
        "reportSemaphoreEntryStatus",
    }
)
LIMITED = frozenset({"start", "stop", "resume", "reset"})


@dataclass(frozen=True, slots=True)
class Call:
    """One event of the model: a service with its arguments, or something shown."""

    service: str
    bindings: Mapping[str, Any] = field(default_factory=dict)


def performed(pdu: Pdu, arms: frozenset[str]) -> Call | None:
    """The service that a request asks for; ``None`` for one that changes nothing in the model.

    ``arms`` are the domains that represent a robot arm.
    """
    arguments = _arguments(pdu, arms)
    return None if arguments is None else Call(str(pdu.service), {"panel": False, **arguments})


def _arguments(pdu: Pdu, arms: frozenset[str]) -> dict[str, Any] | None:
    body, detail = pdu.body, pdu.detail
    match pdu.service:
        case "createProgramInvocation":
            kind = words.word(words.CONTROL, detail if isinstance(detail, int) else 0) or "NORMAL"
            return {"pi": body["programInvocationName"], "kind": kind, "reuse": body["reusable"],
                    "binds_arm": bool(arms.intersection(body["listOfDomainNames"])),
                    "domains": frozenset(body["listOfDomainNames"])}  # fmt: skip
        case "initiateDownloadSequence" | "loadDomainContent" | "storeDomainContent" | "deleteDomain":
            return _of_domain(body)
        case "deleteProgramInvocation":
            return {"pi": body}
        case "start":
            return {"pi": body["programInvocationName"], **_start(detail)}
        case "resume":
            return {"pi": body["programInvocationName"], **_resume(detail)}
        case "stop" | "reset" | "kill":
            return {"pi": body["programInvocationName"]}
        case "select":
            listed = body.get("controlled", [])
            return {
                "controlling": body.get("controlling"),
                "controlled": frozenset(listed),
                "named_twice": len(set(listed)) < len(listed),
            }
        case "alterPI":
            return {"pi": body["programInvocation"], **_limit(body["startCount"])}
        case "vMDStop" | "vMDReset" | "write":
            return {}
        case "takeControl" | "relinquishControl":
            return _taking(body) if plain_name(body["semaphoreName"]) == words.SEMAPHORE else None
    return None


def _of_domain(body: Any) -> dict[str, Any]:
    if isinstance(body, str):
        return {"domain": body}
    return {"domain": body["domainName"], **({"shares": body["sharable"]} if "sharable" in body else {})}


def _taking(body: Mapping[str, Any]) -> dict[str, Any]:
    """How ownership of R_CTRL may end by itself; RelinquishControl says nothing of it."""
    return {
        "times_out": "controlTimeOut" in body,
        "stays": not body.get("relinquishIfConnectionLost", True),
        "preempts": "applicationToPreempt" in body,
    }


def _start(detail: Any) -> dict[str, Any]:
    if not detail or detail[0] == "normal":
        return {"location_given": False, "limit": None, "count": 0}
    return {"location_given": "startLocation" in detail[1], **_limit(detail[1]["startCount"])}


def _resume(detail: Any) -> dict[str, Any]:
    if not detail or detail[0] == "normal":
        return {"type_given": False, "limit": None, "count": 0}
    kind, count = detail[1]["modeType"]
    return {"type_given": True, **(_limit(count) if kind == "changeMode" else {"limit": None, "count": 0})}


def _limit(start_count: tuple[str, Any]) -> dict[str, Any]:
    kind, number = start_count
    return {"limit": words.LIMIT[kind], "count": number if isinstance(number, int) else 0}


def plain_name(object_name: tuple[str, Any]) -> str:
    """The name of an object that belongs to the VMD; that of another scope with its domain before it."""
    scope, name = object_name
    return f"{name['domainId']}/{name['itemId']}" if scope == "domain-specific" else str(name)


SHOWN_BITS = ("shown_interlocks", "shown_power", "shown_calibrated", "shown_local")
"""What the bits of the robot-specific status show, in their order (7.3.2.1.2)."""


def shown_by_status(body: Mapping[str, Any], detail: Mapping[str, Any] | None) -> Call | None:
    """What Status, UnsolicitedStatus and the answer to VMD Reset show."""
    logical = words.word(words.LOGICAL, body["vmdLogicalStatus"])
    physical = words.word(words.PHYSICAL, body["vmdPhysicalStatus"])
    if logical is None or physical is None:
        return None
    bindings: dict[str, Any] = {
        "shown_logical": logical,
        "shown_physical": physical,
        "detailed": False,
        **dict.fromkeys(("shown_robot", "selected_is", *SHOWN_BITS)),
    }
    if detail is None:
        return Call("status", bindings)
    bindings |= {name: _bit(detail, place) for place, name in enumerate(SHOWN_BITS)}
    state = words.word(words.ROBOT_STATE, detail["robotVMDState"])
    if state is not None:
        kind, name = detail["selectedProgramInvocation"]
        selected = name if kind == "programInvocation" else None
        bindings |= {"detailed": True, "shown_robot": state, "selected_is": selected}
    return Call("status", bindings)


def _bit(detail: Mapping[str, Any], place: int) -> bool | None:
    """One bit of the robot-specific status; ``None`` where the mask says that it means nothing.

    A bit that is missing, there or in the mask, tells nothing, either.
    """
    status, mask = detail["robotSpecificStatus"], detail.get("robotSpecificStatusMask", "1111")
    if len(status) <= place or mask[place : place + 1] != "1":
        return None
    return bool(status[place] == "1")


def shown_by_attributes(name: str, body: Mapping[str, Any], detail: Mapping[str, Any] | None) -> Call | None:
    """What GetProgramInvocationAttributes shows of ``name``."""
    state = words.word(words.STATE, body["state"])
    if state is None:
        return None
    return Call("getProgramInvocationAttributes", {
        "pi": name, "shown_state": state,
        "shown_deletable": body["mmsDeletable"], "shown_reusable": body["reusable"],
        "extended": detail is not None, **_control(detail),
    })  # fmt: skip


_NO_CONTROL: tuple[str, Any] = ("normal", None)


def _control(detail: Mapping[str, Any] | None) -> dict[str, Any]:
    kind, content = _NO_CONTROL if detail is None else detail["control"]
    shown: dict[str, Any] = {
        "shown_control": kind.upper(),
        "listed": frozenset(),
        "controller_is": None,
        "shown_mode": None,
        "shown_count": 0,
        "shown_error": 0 if detail is None else detail["errorCode"],
        "shown_location": None,
    }
    if kind == "controlling":
        mode, count = content["runningMode"]
        shown |= {
            "listed": frozenset(content["controlledPI"]),
            "shown_mode": words.MODE[mode],
            "shown_count": count or 0,
            "shown_location": bool(content["programLocation"]) if "programLocation" in content else None,
        }
    elif kind == "controlled":
        shown["controller_is"] = content[1]
    return shown


ENTRY_STATES = {1: ("ownedTokens", "shown_owned"), 2: ("hungTokens", "shown_hung")}


def shown_of_semaphore(request: Pdu, answer: Pdu) -> Iterator[Call]:
    """What ReportSemaphoreStatus and ReportSemaphoreEntryStatus show of R_CTRL; a queue shows nothing."""
    asked, body = request.body, answer.body
    if request.service == "reportSemaphoreStatus":
        if plain_name(asked) == words.SEMAPHORE:
            yield Call("ownedTokens", {"shown_owned": body["numberOfOwnedTokens"] > 0})
            yield Call("hungTokens", {"shown_hung": body["numberOfHungTokens"] > 0})
    elif plain_name(asked["semaphoreName"]) == words.SEMAPHORE and asked["state"] in ENTRY_STATES:
        service, parameter = ENTRY_STATES[asked["state"]]
        # A continuation shows the rest of a list only.
        if "entryIdToStartAfter" not in asked:
            yield Call(service, {parameter: bool(body["listOfSemaphoreEntry"])})


def read_values(request: Pdu, response: Pdu) -> Iterator[tuple[str, tuple[str, Any]]]:
    """The named variables of a Read with their values.

    Of an InformationReport, ``request`` and ``response`` are the report itself.
    """
    kind, content = request.body["variableAccessSpecification"]
    if kind != "listOfVariable":
        return
    for variable, result in zip(content, response.body["listOfAccessResult"], strict=False):
        specification, named = variable["variableSpecification"]
        if specification == "name" and "alternateAccess" not in variable and result[0] == "success":
            yield plain_name(named), result[1]


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a service failed, as far as it matters.

    ``local``: for a reason of the controller's own; ``unknown_object``: for want of the object; ``state``: in
    which state the failure left the program invocation, where the error says so.
    """

    local: bool
    unknown_object: bool
    state: str | None


def failure(pdu: Pdu) -> Failure:
    """What a confirmed-ErrorPDU says about the failure."""
    cause = error_class_code(pdu.body)
    local = cause.class_name in {
        "resource",
        "others",
        "application-reference",
        "time-resolution",
        "service-preempt",
    }
    local = local or (cause.class_name == "vmd-state" and cause.code in (0, 2, 3))
    unknown = (cause.class_name, cause.code) in {("access", 2), ("definition", 1)}
    state = None
    if cause.info and cause.info[0] in LIMITED and isinstance(cause.info[1], int):
        state = words.word(words.STATE, cause.info[1])
    return Failure(local, unknown, state)
