"""MMS PDUs: worked bytes, and every PDU and service there and back."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mms_values import values

from mmsverify.formats import mms
from mmsverify.formats.codec import Choice
from mmsverify.formats.mms import Pdu, decode, encode
from mmsverify.formats.schema import Schema
from mmsverify.resources import asn1_dir
from mmsverify.samples import annex_a

SCHEMA = Schema.of_folder(asn1_dir())
ROOT = SCHEMA.type("MMSpdu")
NO_DETAIL = frozenset({"detail"})
QUICK = settings(max_examples=8, deadline=None, suppress_health_check=list(HealthCheck))
START = "A01B020105BF28058003504931BF4F0DBF280A3008800135A103810103"


def choice(name: str) -> Choice:
    kind = SCHEMA.type(name)
    assert isinstance(kind, Choice)
    return kind


def pdu(octets: str) -> Pdu:
    return decode(bytes.fromhex(octets))


def reads_back(kind: str, content: Any) -> None:
    octets = ROOT.write((kind, content), 0)
    assert encode(decode(octets)) == octets


def test_the_worked_start_of_the_contract_decodes_and_encodes() -> None:
    expected = Pdu(
        "confirmed-RequestPDU",
        5,
        "start",
        {"programInvocationName": "PI1"},
        ("controlling", {"startLocation": "5", "startCount": ("cycleCount", 3)}),
    )
    assert pdu(START) == expected
    assert encode(expected).hex().upper() == START


@pytest.mark.parametrize(
    ("number", "sender", "sent"), [(i, *one) for i, one in enumerate(annex_a.conversation(), 1)]
)
def test_every_pdu_of_annex_a_reads_back(number: int, sender: str, sent: Pdu) -> None:
    assert decode(encode(sent)) == sent, f"PDU {number} of the {sender}"


def test_annex_a_has_31_pdus() -> None:
    assert len(annex_a.conversation()) == 31


@pytest.mark.parametrize(
    ("octets", "kind", "invoke_id", "body"),
    [
        (
            "A2 0A 80 01 26 A2 05 A0 03 8B 01 00",
            "confirmed-ErrorPDU",
            0x26,
            {"serviceError": {"errorClass": ("file", 0)}},
        ),
        ("A4 06 80 01 08 81 01 01", "rejectPDU", 8, {"rejectReason": ("confirmed-request", 1)}),
        ("A4 03 85 01 01", "rejectPDU", None, {"rejectReason": ("pdu-error", 1)}),
        ("85 01 07", "cancel-RequestPDU", 7, None),
        ("86 01 07", "cancel-ResponsePDU", 7, None),
        (
            "A7 0A 80 01 07 A1 05 A0 03 8A 01 01",
            "cancel-ErrorPDU",
            7,
            {"serviceError": {"errorClass": ("cancel", 1)}},
        ),
        ("8B 00", "conclude-RequestPDU", None, None),
        ("8C 00", "conclude-ResponsePDU", None, None),
        ("AD 05 A0 03 89 01 01", "conclude-ErrorPDU", None, {"errorClass": ("conclude", 1)}),
        ("AA 05 A0 03 88 01 03", "initiate-ErrorPDU", None, {"errorClass": ("initiate", 3)}),
    ],
)
def test_pdus_without_a_service_decode_and_encode(
    octets: str, kind: str, invoke_id: int | None, body: Any
) -> None:
    expected = Pdu(kind, invoke_id, body=body)
    assert pdu(octets) == expected
    assert encode(expected) == bytes.fromhex(octets)


@pytest.mark.parametrize("service", choice("ConfirmedServiceRequest").alternatives)
@QUICK
@given(data=st.data())
def test_every_request_reads_back(service: str, data: st.DataObject) -> None:
    argument = data.draw(values(choice("ConfirmedServiceRequest").alternatives[service], skip=NO_DETAIL))
    reads_back("confirmed-RequestPDU", {"invokeID": 1, "service": (service, argument)})


@pytest.mark.parametrize("service", choice("ConfirmedServiceResponse").alternatives)
@QUICK
@given(data=st.data())
def test_every_response_reads_back(service: str, data: st.DataObject) -> None:
    result = data.draw(values(choice("ConfirmedServiceResponse").alternatives[service], skip=NO_DETAIL))
    reads_back("confirmed-ResponsePDU", {"invokeID": 1, "service": (service, result)})


@pytest.mark.parametrize("service", choice("UnconfirmedService").alternatives)
@QUICK
@given(data=st.data())
def test_every_unconfirmed_service_reads_back(service: str, data: st.DataObject) -> None:
    argument = data.draw(values(choice("UnconfirmedService").alternatives[service], skip=NO_DETAIL))
    reads_back("unconfirmed-PDU", {"service": (service, argument)})


@pytest.mark.parametrize("kind", [name for name in choice("MMSpdu").alternatives if "firmed-" not in name])
@QUICK
@given(data=st.data())
def test_every_other_pdu_reads_back(kind: str, data: st.DataObject) -> None:
    reads_back(kind, data.draw(values(choice("MMSpdu").alternatives[kind])))


@QUICK
@given(content=values(choice("MMSpdu").alternatives["confirmed-ErrorPDU"]))
def test_every_error_reads_back(content: Any) -> None:
    reads_back("confirmed-ErrorPDU", content)


@QUICK
@given(modifiers=st.lists(values(choice("Modifier")), min_size=1, max_size=3))
def test_modifiers_read_back(modifiers: list[Any]) -> None:
    sent = Pdu("confirmed-RequestPDU", 1, "identify", modifiers=tuple(modifiers))
    octets = encode(sent)
    assert len(decode(octets).modifiers) == len(modifiers)
    assert encode(decode(octets)) == octets


def test_what_decodes_is_what_was_encoded_not_only_the_same_octets() -> None:
    content = {"domainId": "D", "itemId": "I"}
    sent = Pdu("confirmed-RequestPDU", 3, "reportSemaphoreStatus", ("domain-specific", content))
    assert decode(encode(sent)) == sent


def test_a_default_is_filled_in_and_not_written() -> None:
    created = pdu("A00E 020104 BF2608 800141 A1031A0144")
    assert created.body == {"programInvocationName": "A", "listOfDomainNames": ["D"], "reusable": True}
    assert len(encode(created)) == 16


def test_a_long_form_length_is_read_though_a_short_one_would_do() -> None:
    assert pdu("A081 08 020107 80820001 00") == pdu("A006 020107 800100")


def test_a_null_in_constructed_form_is_read_with_a_remark() -> None:
    stopped = pdu("A106 020101 BF2900")
    assert (stopped.service, stopped.body) == ("stop", None)
    assert len(stopped.remarks) == 1
    assert not pdu("A106 020101 9F2900").remarks


@pytest.mark.parametrize(
    ("octets", "body"),
    [("A105 020101 B300", ("noResult", None)), ("A105 020101 A600", {})],
)
def test_an_empty_result_is_read_with_a_remark(octets: str, body: Any) -> None:
    answer = pdu(octets)
    assert answer.body == body
    assert "empty element" in answer.remarks[0]
    assert decode(encode(answer)).body == body


def test_numbers_and_bits_have_the_names_of_the_standard() -> None:
    assert mms.named("ProgramInvocationState", 3) == "running"
    assert mms.named("ProgramInvocationState", 77) == "77"
    assert mms.number("RobotVMDState", "robot-motion-paused") == 4
    assert mms.bits("RobotSpecificStatus", "010101") == {"anyPhysicalResourcePowerOn", "localControl", "5"}
    assert mms.bit_string("Transitions", ["active-to-idle"], 7) == "0001000"


def test_the_cause_of_an_error_is_told_with_the_state_of_the_program_invocation() -> None:
    answer = pdu("A20F 800105 A20A A003840102 A303810104")
    assert mms.error_class_code(answer.body) == ("service", 2, ("start", 4))
    assert mms.error_class_code(answer.body["serviceError"]).class_name == "service"


def test_a_field_is_found_in_the_octets() -> None:
    octets = bytes.fromhex(START)
    assert mms.locate(octets, ["service", "start", "programInvocationName"]) == (10, 13)
    assert mms.locate(octets, ["detail", "startCount"]) == (26, 29)
    assert mms.locate(octets, ["executionArgument"]) is None
    created = encode(annex_a.conversation()[14][1])
    begin, end = mms.locate(created, ["listOfDomainNames", "[0]"]) or (0, 0)
    assert created[begin:end] == b"Assemble_Cluster"
