"""The robot standard's own example of a conversation (GB/T 16720.3, Annex A, A5.1 to A5.4) as 31 PDUs.

A unit controller is the client, the robot the server. Members at their default are given, as a decoder does.
"""

from __future__ import annotations

from typing import Any

from mmsverify.formats.mms import Pdu, bit_string, number

CLUSTER, ARM = "Assemble_Cluster", "R_ARM"
TRANSITIONS = bit_string("Transitions", ["active-to-idle"], 7)


def request(invoke_id: int, service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-RequestPDU", invoke_id, service, body, detail)


def response(invoke_id: int, service: str, body: Any = None, detail: Any = None) -> Pdu:
    return Pdu("confirmed-ResponsePDU", invoke_id, service, body, detail)


def vmd(name: str) -> tuple[str, str]:
    return "vmd-specific", name


def status(logical: int, physical: int) -> dict[str, int]:
    return {"vmdLogicalStatus": logical, "vmdPhysicalStatus": physical}


def robot_status(state: str, flags: list[str], selected: tuple[str, str | None]) -> dict[str, Any]:
    return {
        "robotVMDState": number("RobotVMDState", state),
        "robotSpecificStatus": bit_string("RobotSpecificStatus", flags, 4),
        "robotSpecificStatusMask": "1111",
        "selectedProgramInvocation": selected,
    }


def initiation(sort: str, detail: dict[str, Any]) -> Pdu:
    """An Initiate of one service in flight each way; ``sort`` is Request or Response."""
    words = {"Request": "proposed", "Response": "negotiated"}[sort]
    body = {
        f"{words}MaxServOutstandingCalling": 1,
        f"{words}MaxServOutstandingCalled": 1,
        f"init{sort}Detail": {
            f"{words}VersionNumber": 1,
            f"{words}ParameterCBB": bit_string("ParameterSupportOptions", ["str1", "vnam"], 11),
            **detail,
        },
    }
    return Pdu(f"initiate-{sort}PDU", body=body)


def services(*names: str) -> str:
    return bit_string("ServiceSupportOptions", names, 85)


def additional(*names: str) -> str:
    return bit_string("AdditionalSupportOptions", names, 4)


ROBOT_SERVICES = services(
    "identify",
    "status",
    "read",
    "write",
    "conclude",
    "defineEventEnrollment",
    "start",
    "stop",
    "resume",
    "reset",
)
CALLING = {
    "servicesSupportedCalling": services("identify", "eventNotification"),
    "additionalSupportedCalling": additional(),
}
CALLED = {
    "servicesSupportedCalled": ROBOT_SERVICES,
    "additionalSupportedCalled": additional("vMDStop", "vMDReset", "select"),
}
ENROLLMENT = {
    "eventEnrollmentName": vmd(CLUSTER),
    "eventConditionName": vmd(ARM),
    "eventConditionTransitions": TRANSITIONS,
    "alarmAcknowledgmentRule": 0,
    "eventActionName": vmd(ARM),
}
CREATION = {
    "programInvocationName": CLUSTER,
    "listOfDomainNames": [CLUSTER],
    "reusable": True,
    "monitorType": True,
}
FREE_START = ("controlling", {"startCount": ("noLimit", None)})
EXECUTING = robot_status(
    "robot-executing",
    ["anyPhysicalResourcePowerOn", "allPhysicalResourcesCalibrated"],
    ("programInvocation", CLUSTER),
)
PAUSED = robot_status(
    "robot-motion-paused",
    [
        "safetyInterlocksViolated",
        "anyPhysicalResourcePowerOn",
        "allPhysicalResourcesCalibrated",
        "localControl",
    ],
    ("noneSelected", None),
)
READING = {
    "specificationWithResult": False,
    "variableAccessSpecification": (
        "listOfVariable",
        [{"variableSpecification": ("name", vmd("Part_Count"))}],
    ),
}
ATTRIBUTES = {
    "state": 4,
    "listOfDomainNames": [ARM],
    "mmsDeletable": True,
    "reusable": True,
    "monitor": True,
    "executionArgument": ("simpleString", " "),
}
CONTROL = {
    "errorCode": 0,
    "control": ("controlling", {"controlledPI": [ARM], "runningMode": ("freeRunning", None)}),
}
NOTIFICATION = {
    "eventEnrollmentName": vmd(CLUSTER),
    "eventConditionName": vmd(ARM),
    "severity": 64,
    "transitionTime": ("undefined", None),
    "notificationLost": False,
    "actionResult": {
        "eventActionName": vmd(ARM),
        "eventActionResult": (
            "success",
            {"response": ("getProgramInvocationAttributes", ATTRIBUTES), "detail": CONTROL},
        ),
    },
}

CLIENT, SERVER = "client", "server"


def preparation() -> list[tuple[str, Pdu]]:
    """A5.1: association, enrollment, calibration, download, creation, selection."""
    return [
        (CLIENT, initiation("Request", CALLING)),
        (SERVER, initiation("Response", CALLED)),
        (CLIENT, request(1, "defineEventEnrollment", ENROLLMENT)),
        (SERVER, response(1, "defineEventEnrollment")),
        (CLIENT, request(2, "start", {"programInvocationName": "R_CAL"})),
        (SERVER, response(2, "start")),
        *download(),
        (CLIENT, request(4, "createProgramInvocation", CREATION, 1)),
        (SERVER, response(4, "createProgramInvocation")),
        (CLIENT, request(5, "select", {"controlling": CLUSTER, "controlled": [ARM]})),
        (SERVER, response(5, "select")),
    ]


def download() -> list[tuple[str, Pdu]]:
    """A5.1: the robot asks for the segments; it spells the domain in two ways, as the standard prints it."""
    begin = {"domainName": CLUSTER, "listOfCapabilities": [], "sharable": False}
    return [
        (CLIENT, request(3, "initiateDownloadSequence", begin)),
        (SERVER, response(3, "initiateDownloadSequence")),
        (SERVER, request(1, "downloadSegment", CLUSTER)),
        (CLIENT, response(1, "downloadSegment", {"loadData": ("non-coded", b"BEGIN"), "moreFollows": True})),
        (SERVER, request(2, "downloadSegment", CLUSTER)),
        (CLIENT, response(2, "downloadSegment", {"loadData": ("non-coded", b"END"), "moreFollows": False})),
        (SERVER, request(3, "terminateDownloadSequence", {"domainName": "Assemble_cluster"})),
        (CLIENT, response(3, "terminateDownloadSequence")),
    ]


def operation() -> list[tuple[str, Pdu]]:
    """A5.2: start, status, a variable, the notification of a standstill, status, VMD Stop."""
    return [
        (CLIENT, request(6, "start", {"programInvocationName": CLUSTER}, FREE_START)),
        (SERVER, response(6, "start")),
        (CLIENT, request(7, "status", False)),
        (SERVER, response(7, "status", status(0, 0), EXECUTING)),
        (CLIENT, request(8, "read", READING)),
        (SERVER, response(8, "read", {"listOfAccessResult": [("success", ("integer", 25))]})),
        (SERVER, Pdu("unconfirmed-PDU", None, "eventNotification", NOTIFICATION)),
        (CLIENT, request(9, "status", False)),
        (SERVER, response(9, "status", status(1, 3), PAUSED)),
        (CLIENT, request(10, "vMDStop")),
        (SERVER, response(10, "vMDStop")),
    ]


def conversation() -> list[tuple[str, Pdu]]:
    """All 31 PDUs in order, each with its sender."""
    end = [(CLIENT, Pdu("conclude-RequestPDU")), (SERVER, Pdu("conclude-ResponsePDU"))]
    return [*preparation(), *operation(), *end]
