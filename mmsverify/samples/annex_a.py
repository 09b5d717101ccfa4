"""The robot standard's own example of a conversation (GB/T 16720.3, Annex A, A5.1 to A5.4) as 31 PDUs.

A unit controller is the client, the robot the server. Every value is as printed, faults included.
"""

from __future__ import annotations

from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import Sender
from mmsverify.samples.pdus import (
    ALL_WELL,
    attributes,
    controlling,
    enrollment,
    initiation,
    notification,
    reading,
    request,
    response,
    robot_status,
    status,
    vmd,
)

CLUSTER, ARM = "Assemble_Cluster", "R_ARM"
CLIENT: Sender = "client"
SERVER: Sender = "server"

CLIENT_SERVICES = ("identify", "eventNotification")
ROBOT_SERVICES = (
    "identify", "status", "read", "write", "conclude", "defineEventEnrollment", "start", "stop", "resume",
    "reset",
)  # fmt: skip
ROBOT_ADDITIONAL = ("vMDStop", "vMDReset", "select")
CREATION = {
    "programInvocationName": CLUSTER,
    "listOfDomainNames": [CLUSTER],
    "reusable": True,
    "monitorType": True,
}
FREE_START = ("controlling", {"startCount": ("noLimit", None)})
EXECUTING = robot_status("robot-executing", ALL_WELL, ("programInvocation", CLUSTER))
PAUSED = robot_status(
    "robot-motion-paused", ["safetyInterlocksViolated", *ALL_WELL, "localControl"], ("noneSelected", None)
)
STANDSTILL = attributes("stopped", [ARM], monitor=True, argument=" ")
NOTIFICATION = notification(
    CLUSTER, ARM, ARM, ("getProgramInvocationAttributes", STANDSTILL), controlling([ARM])
)


def preparation() -> list[tuple[Sender, Pdu]]:
    """A5.1: association, enrollment, calibration, download, creation, selection."""
    return [
        (CLIENT, initiation("Request", CLIENT_SERVICES, ())),
        (SERVER, initiation("Response", ROBOT_SERVICES, ROBOT_ADDITIONAL)),
        (CLIENT, request(1, "defineEventEnrollment", enrollment(CLUSTER, ARM, ARM))),
        (SERVER, response(1, "defineEventEnrollment")),
        (CLIENT, request(2, "start", {"programInvocationName": "R_CAL"})),
        (SERVER, response(2, "start")),
        *download(),
        (CLIENT, request(4, "createProgramInvocation", CREATION, 1)),
        (SERVER, response(4, "createProgramInvocation")),
        (CLIENT, request(5, "select", {"controlling": CLUSTER, "controlled": [ARM]})),
        (SERVER, response(5, "select")),
    ]


def download() -> list[tuple[Sender, Pdu]]:
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


def operation() -> list[tuple[Sender, Pdu]]:
    """A5.2: start, status, a variable, the notification of a standstill, status, VMD Stop."""
    return [
        (CLIENT, request(6, "start", {"programInvocationName": CLUSTER}, FREE_START)),
        (SERVER, response(6, "start")),
        (CLIENT, request(7, "status", False)),
        (SERVER, response(7, "status", status(0, 0), EXECUTING)),
        (CLIENT, request(8, "read", reading(vmd("Part_Count")))),
        (SERVER, response(8, "read", {"listOfAccessResult": [("success", ("integer", 25))]})),
        (SERVER, Pdu("unconfirmed-PDU", None, "eventNotification", NOTIFICATION)),
        (CLIENT, request(9, "status", False)),
        (SERVER, response(9, "status", status(1, 3), PAUSED)),
        (CLIENT, request(10, "vMDStop")),
        (SERVER, response(10, "vMDStop")),
    ]


def conversation() -> list[tuple[Sender, Pdu]]:
    """All 31 PDUs in order, each with its sender."""
    end: list[tuple[Sender, Pdu]] = [
        (CLIENT, Pdu("conclude-RequestPDU")),
        (SERVER, Pdu("conclude-ResponsePDU")),
    ]
    return [*preparation(), *operation(), *end]
