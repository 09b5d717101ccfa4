"""A robot's PDU reads back as it was, octets near one decode or are refused, values come through whole."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mms_values import values
from worked_additions import ADDITION_PDUS
from worked_pdus import ask, asked, e, tell, told
from worked_programs import PROGRAM_PDUS

from mmsverify.errors import DecodeError
from mmsverify.formats.codec import Choice
from mmsverify.formats.mms import Pdu, decode, encode
from mmsverify.formats.schema import Schema
from mmsverify.resources import asn1_dir

SCHEMA = Schema.of_folder(asn1_dir())
QUICK = settings(max_examples=30, deadline=None, suppress_health_check=list(HealthCheck))
DETAILS = {
    ("confirmed-RequestPDU", "createProgramInvocation"): "CS-CreateProgramInvocation-Request",
    ("confirmed-RequestPDU", "start"): "CS-Start-Request",
    ("confirmed-RequestPDU", "resume"): "CS-Resume-Request",
    ("confirmed-ResponsePDU", "status"): "RobotStatusDetail",
    ("confirmed-ResponsePDU", "vMDReset"): "RobotStatusDetail",
    ("confirmed-ResponsePDU", "getProgramInvocationAttributes"): "CS-GetProgramInvocationAttributes-Response",
    ("unconfirmed-PDU", "unsolicitedStatus"): "RobotStatusDetail",
}
TABLES = {
    "confirmed-RequestPDU": ("ConfirmedServiceRequest", "AdditionalService-Request"),
    "confirmed-ResponsePDU": ("ConfirmedServiceResponse", "AdditionalService-Response"),
    "unconfirmed-PDU": ("UnconfirmedService",),
}
ROBOTS = [
    *DETAILS,
    *((kind, name) for kind in list(TABLES)[:2] for name in ("vMDStop", "vMDReset", "select", "alterPI")),
]


def service(kind: str, name: str) -> Any:
    """The type of a service's argument or result."""
    for table in map(SCHEMA.type, TABLES[kind]):
        assert isinstance(table, Choice)
        if name in table.alternatives:
            return table.alternatives[name]
    raise AssertionError(name)


def detail(kind: str, name: str) -> st.SearchStrategy[Any]:
    """The robot's part, or nothing; ``normal`` is written as nothing."""
    robots = DETAILS.get((kind, name))
    some = values(SCHEMA.type(robots)) if robots else st.none()
    return st.none() | some.filter(lambda value: value != ("normal", None))


@pytest.mark.parametrize(("kind", "name"), ROBOTS)
@QUICK
@given(data=st.data())
def test_a_robots_pdu_is_what_was_encoded(kind: str, name: str, data: st.DataObject) -> None:
    invoke = None if kind == "unconfirmed-PDU" else data.draw(st.integers(0, 2**31 - 1))
    body = data.draw(values(service(kind, name)))
    sent = Pdu(kind, invoke, name, body, data.draw(detail(kind, name)))
    assert decode(encode(sent)) == sent


SEEDS = [bytes.fromhex(one.octets) for one in (*PROGRAM_PDUS, *ADDITION_PDUS)]


@settings(max_examples=800, deadline=None)
@given(seed=st.sampled_from(SEEDS), data=st.data())
def test_octets_near_a_robots_pdu_decode_or_are_refused(seed: bytes, data: st.DataObject) -> None:
    octets = bytearray(seed)
    for _ in range(data.draw(st.integers(1, 3))):
        octets[data.draw(st.integers(0, len(octets) - 1))] ^= 1 << data.draw(st.integers(0, 7))
    try:
        read = decode(bytes(octets))
    except DecodeError as error:
        refused = error.offset
    else:
        refused, again = 0, decode(encode(read))
        assert (again.kind, again.service, again.body) == (read.kind, read.service, read.body)
    assert 0 <= refused <= len(octets)


# What clause 8.4 and 8.5 say of values: single precision, arrays, structures, object identifiers, strings.

SINGLE = {"0.0": "00000000", "4.0": "40800000", "-1.5": "BFC00000"}
FLOATS = [e("87", "08" + octets) for octets in SINGLE.values()]
VALUES = [bytes.fromhex("08" + octets) for octets in SINGLE.values()]
REALS = [("floating-point", value) for value in VALUES]
POSITION, ORIENTATION = e("A1", *FLOATS), e("A1", *FLOATS, FLOATS[0])
POSE = ("structure", [("array", REALS), ("array", [*REALS, REALS[0]])])
NAMED = [
    (("R-8.4.1-1",), POSITION, ("array", REALS)),
    (("R-8.4.2-1",), ORIENTATION, ("array", [*REALS, REALS[0]])),
    (("R-8.4.3-1",), e("A2", POSITION, ORIENTATION), POSE),
    (
        ("R-8.4.4-1",),
        e("A2", e("8F", "28CA220301"), e("8A", "47"), e("A2", POSITION, ORIENTATION), e("8A")),
        ("structure", [("objId", "1.0.9506.3.1"), ("visible-string", "G"), POSE, ("visible-string", "")]),
    ),
    (("R-8.5.4.2-1",), "850102", ("integer", 2)),
    (
        ("R-8.5.5.2-1", "R-8.5.5.4-1"),
        e("A1", "850100", "850101"),
        ("array", [("integer", 0), ("integer", 1)]),
    ),
    (("R-8.5.5.3-1",), e("A1", "8301FF", "830100"), ("array", [("boolean", True), ("boolean", False)])),
    (
        ("R-8.5.5.5-1",),
        e("A1", e("A2", FLOATS[1], FLOATS[2])),
        ("array", [("structure", [REALS[1], REALS[2]])]),
    ),
    ((), e("87", "0B" + "4010000000000000"), ("floating-point", bytes.fromhex("0B4010000000000000"))),
]


@pytest.mark.parametrize(
    ("octets", "value"), [pytest.param(*one, marks=pytest.mark.exercises(*ids)) for ids, *one in NAMED]
)
def test_a_value_comes_through_whole(octets: str, value: tuple[str, Any]) -> None:
    answer = told("read", {"listOfAccessResult": [("success", value)]})
    read = bytes.fromhex(tell(e("A4", e("A1", octets))))
    assert decode(read) == answer
    assert encode(answer) == read


def floats(count: int) -> tuple[str, tuple[str, Any]]:
    """The type of an array of floating-point numbers with 32 bits, 8 of them exponent."""
    single = ("floating-point", {"format-width": 32, "exponent-width": 8})
    octets = e("A1", f"8101{count:02X}", e("A2", e("A7", "020120 020108")))
    return octets, ("array", {"packed": False, "numberOfElements": count, "elementType": single})


def test_the_types_of_pose_and_tool_come_through_whole() -> None:
    position, orientation = floats(3), floats(4)
    named = e("30", e("A1", e("A0", e("80", "525F505345"))))
    parts = [
        (e("30", e("A1", "8F00")), ("objId", None)),
        (e("30", e("A1", "8A0150")), ("visible-string", 80)),
        (named, ("typeName", ("vmd-specific", "R_PSE"))),
        (e("30", e("A1", position[0])), position[1]),
        (e("30", e("A1", orientation[0])), orientation[1]),
        (e("30", e("A1", "8A020200")), ("visible-string", 512)),
    ]
    members = [{"componentType": kind} for _, kind in parts]
    structure = ("structure", {"packed": False, "components": members})
    sent = told("getNamedTypeAttributes", {"mmsDeletable": False, "typeSpecification": structure})
    octets = bytes.fromhex(tell(e("AF", "800100", e("A2", e("A1", *(one for one, _ in parts))))))
    assert decode(octets) == sent
    assert encode(sent) == octets
    request = ask(e("AF", e("80", "525F505345")))
    assert decode(bytes.fromhex(request)) == asked("getNamedTypeAttributes", ("vmd-specific", "R_PSE"))


# 9.2.2.2 and 9.2.2.4: what a robot of the base class, and one with events and domains, must understand.
CONFIRMED = [
    "status", "getNameList", "identify", "read", "write", "getVariableAccessAttributes",
    "defineNamedType", "getNamedTypeAttributes", "deleteNamedType", "takeControl", "relinquishControl",
    "reportSemaphoreStatus", "reportPoolSemaphoreStatus", "reportSemaphoreEntryStatus",
    "initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence", "initiateUploadSequence",
    "uploadSegment", "terminateUploadSequence", "requestDomainDownload", "requestDomainUpload",
    "loadDomainContent", "storeDomainContent", "deleteDomain", "getDomainAttributes",
    "createProgramInvocation", "deleteProgramInvocation", "start", "stop", "resume", "reset", "kill",
    "getProgramInvocationAttributes", "defineEventCondition", "deleteEventCondition",
    "getEventConditionAttributes", "reportEventConditionStatus", "alterEventConditionMonitoring",
    "defineEventAction", "deleteEventAction", "getEventActionAttributes", "reportEventActionStatus",
    "defineEventEnrollment", "deleteEventEnrollment", "getEventEnrollmentAttributes",
    "reportEventEnrollmentStatus", "alterEventEnrollment", "acknowledgeEventNotification", "vMDStop",
    "vMDReset", "select", "alterPI",
]  # fmt: skip


@pytest.mark.parametrize("name", CONFIRMED)
@settings(max_examples=5, deadline=None, suppress_health_check=list(HealthCheck))
@given(data=st.data())
def test_a_service_is_understood_as_request_response_and_error(name: str, data: st.DataObject) -> None:
    for kind in ("confirmed-RequestPDU", "confirmed-ResponsePDU"):
        skipped = frozenset({"detail"})
        sent = Pdu(kind, 7, name, data.draw(values(service(kind, name), skip=skipped)))
        assert encode(decode(encode(sent))) == encode(sent)
        assert decode(encode(sent)).service == name
    error = data.draw(values(SCHEMA.type("ServiceError")))
    failed = Pdu("confirmed-ErrorPDU", 7, body={"serviceError": error})
    assert decode(encode(failed)) == failed
