"""Small words for MMS PDUs, so that a conversation reads as one.

Members at their default are given, as a decoder does.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from mmsverify.formats.mms import Pdu, bit_string, number

ALL_WELL = ("anyPhysicalResourcePowerOn", "allPhysicalResourcesCalibrated")
SERVICES_BITS, ADDITIONAL_BITS = 85, 4


def request(invoke_id: int, service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-RequestPDU", invoke_id, service, body, detail)


def response(invoke_id: int, service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-ResponsePDU", invoke_id, service, body, detail)


def failure(invoke_id: int, cause: tuple[str, str], info: tuple[str, str] | None = None) -> Pdu:
    """A confirmed-ErrorPDU: class and code by name; ``info`` is a service and the state that it left."""
    kinds = {
        "resource": "ResourceError",
        "vmd-state": "VmdStateError",
        "definition": "DefinitionError",
        "service": "ServiceProblem",
    }
    error: dict[str, Any] = {"errorClass": (cause[0], number(kinds.get(cause[0], "AccessError"), cause[1]))}
    if info is not None:
        error["serviceSpecificInformation"] = (info[0], number("ProgramInvocationState", info[1]))
    return Pdu("confirmed-ErrorPDU", invoke_id, body={"serviceError": error})


def vmd(name: str) -> tuple[str, str]:
    """The name of an object of the VMD."""
    return "vmd-specific", name


def of_domain(domain: str, item: str) -> tuple[str, dict[str, str]]:
    """The name of an object of a domain."""
    return "domain-specific", {"domainId": domain, "itemId": item}


def variables(*names: tuple[str, Any]) -> tuple[str, Any]:
    """A list of named variables."""
    return "listOfVariable", [{"variableSpecification": ("name", name)} for name in names]


def reading(*names: tuple[str, Any]) -> dict[str, Any]:
    """The body of a Read request."""
    return {"specificationWithResult": False, "variableAccessSpecification": variables(*names)}


def status(logical: int, physical: int) -> dict[str, int]:
    """Logical and physical status by their numbers."""
    return {"vmdLogicalStatus": logical, "vmdPhysicalStatus": physical}


def robot_status(state: str, flags: Sequence[str], selected: tuple[str, str | None]) -> dict[str, Any]:
    """The robot's part of Status (7.3.2.1.2)."""
    return {
        "robotVMDState": number("RobotVMDState", state),
        "robotSpecificStatus": bit_string("RobotSpecificStatus", flags, 4),
        "robotSpecificStatusMask": "1111",
        "selectedProgramInvocation": selected,
    }


def attributes(
    state: str,
    domains: list[str],
    *,
    deletable: bool = True,
    reusable: bool = True,
    monitor: bool = False,
    argument: str = "",
) -> dict[str, Any]:
    """What GetProgramInvocationAttributes answers; the robot's part stands beside it."""
    return {
        "state": number("ProgramInvocationState", state),
        "listOfDomainNames": domains,
        "mmsDeletable": deletable,
        "reusable": reusable,
        "monitor": monitor,
        "executionArgument": ("simpleString", argument),
    }


def controlling(listed: list[str], mode: tuple[str, Any] = ("freeRunning", None)) -> dict[str, Any]:
    """The robot's part of the attributes of a CONTROLLING program invocation (7.3.3.9.2)."""
    return {"errorCode": 0, "control": ("controlling", {"controlledPI": listed, "runningMode": mode})}


def controlled(by: str | None) -> dict[str, Any]:
    """The same of a CONTROLLED one."""
    return {"errorCode": 0, "control": ("controlled", ("controllingPI", by) if by else ("none", None))}


NORMAL = {"errorCode": 0, "control": ("normal", None)}


def enrollment(name: str, condition: str, action: str) -> dict[str, Any]:
    """The body of DefineEventEnrollment: tell when ``condition`` becomes idle, and do ``action``."""
    return {
        "eventEnrollmentName": vmd(name),
        "eventConditionName": vmd(condition),
        "eventConditionTransitions": bit_string("Transitions", ["active-to-idle"], 7),
        "alarmAcknowledgmentRule": 0,
        "eventActionName": vmd(action),
    }


def notification(
    name: str, condition: str, action: str, answer: tuple[str, Any], detail: Any
) -> dict[str, Any]:
    """The body of EventNotification: what was enrolled under ``name`` has happened; the action's answer."""
    return {
        "eventEnrollmentName": vmd(name),
        "eventConditionName": vmd(condition),
        "severity": 64,
        "transitionTime": ("undefined", None),
        "notificationLost": False,
        "actionResult": {
            "eventActionName": vmd(action),
            "eventActionResult": ("success", {"response": answer, "detail": detail}),
        },
    }


def initiation(sort: str, services: Sequence[str], additional: Sequence[str], outstanding: int = 1) -> Pdu:
    """An Initiate; ``sort`` is Request or Response; the services are those that its sender performs."""
    word, side = {"Request": ("proposed", "Calling"), "Response": ("negotiated", "Called")}[sort]
    body = {
        f"{word}MaxServOutstandingCalling": outstanding,
        f"{word}MaxServOutstandingCalled": outstanding,
        f"init{sort}Detail": {
            f"{word}VersionNumber": 1,
            f"{word}ParameterCBB": bit_string("ParameterSupportOptions", ["str1", "vnam"], 11),
            f"servicesSupported{side}": bit_string("ServiceSupportOptions", services, SERVICES_BITS),
            f"additionalSupported{side}": bit_string("AdditionalSupportOptions", additional, ADDITIONAL_BITS),
        },
    }
    return Pdu(f"initiate-{sort}PDU", body=body)
