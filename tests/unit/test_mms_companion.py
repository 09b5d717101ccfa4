"""MMS PDUs: the robot standard's parts under [79] and [78], and the forms of both editions."""

from __future__ import annotations

from typing import Any

import pytest

from mmsverify.errors import DecodeError
from mmsverify.formats.mms import Pdu, decode, encode


def pdu(octets: str) -> Pdu:
    return decode(bytes.fromhex(octets))


def refusal(octets: str) -> DecodeError:
    with pytest.raises(DecodeError) as caught:
        pdu(octets)
    return caught.value


DETAIL = "30 09 80 01 00 81 02 04 60 84 00"
BARE = DETAIL.removeprefix("30 09 ")


@pytest.mark.parametrize(
    ("octets", "service"),
    [
        (f"A11B 020101 A006800100810100 BF4F0D A00B {DETAIL}", "status"),
        (f"A119 020101 A006800100810100 BF4F0B A009 {BARE}", "status"),
        (f"A318 A106800100810100 BF4F0D A10B {DETAIL}", "unsolicitedStatus"),
        (f"A316 A106800100810100 BF4F0B A109 {BARE}", "unsolicitedStatus"),
        (f"A11E 020101 BF4E08A106800100810100 BF4F0D A00B {DETAIL}", "vMDReset"),
    ],
)
def test_a_status_detail_is_read_in_both_forms_and_written_in_one(octets: str, service: str) -> None:
    answer = pdu(octets)
    assert answer.service == service
    assert answer.detail == {
        "robotVMDState": 0,
        "robotSpecificStatus": "0110",
        "robotSpecificStatusMask": "1111",
        "selectedProgramInvocation": ("noneSelected", None),
    }
    assert bytes.fromhex(DETAIL) in encode(answer)
    assert decode(encode(answer)) == answer


def test_a_normal_start_is_read_and_written_without_a_detail() -> None:
    plain = Pdu("confirmed-RequestPDU", 5, "start", {"programInvocationName": "PI1"})
    told = pdu("A013 020105 BF28058003504931 BF4F05 BF28020500")
    assert told.detail == ("normal", None)
    assert encode(told) == encode(plain)


@pytest.mark.parametrize(
    "octets",
    [
        "A017 020105 BF28058003504931 BF4F09 BF2A06 3004 A0028000",
        "A012 020105 BF28058003504931 BF4F04 9F260101",
        "A012 020105 BF28058003504931 BF4F04 9F280101",
        "A00D 020105 8200 BF4F05 BF28020500",
        "A008 020105 8200 BF4F00",
        "A10D 020105 9F2800 BF4F04 A0020500",
        "A30F A106 800100810100 BF4F04 A0020500",
    ],
)
def test_a_detail_that_belongs_to_another_service_or_to_none_is_refused(octets: str) -> None:
    assert ".detail" in refusal(octets).path


def test_a_misplaced_detail_is_told_with_its_place() -> None:
    error = refusal("A012 020105 BF28058003504931 BF4F04 9F260101")
    assert "createProgramInvocation" in error.cause
    assert "start" in error.cause
    assert (error.offset, error.path) == (16, "confirmed-RequestPDU.detail")


def test_an_additional_service_beyond_the_robots_is_refused() -> None:
    assert "84" in refusal("A008 020105 BF4E028400").cause


NAMES = "A0 03 80 01 45"


@pytest.mark.parametrize("condition", ["A1 03 80 01 43", "A1 05 A0 03 80 01 43"])
@pytest.mark.parametrize("failure", ["A1 07 A1 05 A0 03 84 01 02", "A1 05 A0 03 84 01 02"])
def test_a_notification_of_either_edition_has_one_shape(condition: str, failure: str) -> None:
    action = bytes.fromhex(f"80 01 41 {failure}")
    body = bytes.fromhex(f"{NAMES} {condition} 82 01 40 A4 02 82 00 A8") + bytes([len(action)]) + action
    octets = bytes([0xA3, len(body) + 2, 0xA2, len(body)]) + body
    told = decode(octets).body
    assert told["eventConditionName"] == ("vmd-specific", "C")
    assert told["actionResult"]["eventActionResult"] == (
        "failure",
        {"serviceError": {"errorClass": ("service", 2)}},
    )
    assert decode(encode(decode(octets))) == decode(octets)


def test_an_undefined_event_condition_of_1990_keeps_its_form() -> None:
    octets = bytes.fromhex(f"A312 A210 {NAMES} A1 02 81 00 82 01 40 A4 02 82 00")
    assert decode(octets).body["eventConditionName"] == ("undefined", None)
    assert encode(decode(octets)) == octets


ATTRIBUTES = "80 01 02 A1 00 82 01 FF 83 01 FF 84 01 FF"


@pytest.mark.parametrize(
    ("argument", "members"),
    [
        ("85 01 61", {"executionArgument": ("simpleString", "a")}),
        (
            "28 05 81 03 01 02 03",
            {"executionArgument": ("encodedString", {"encoding": ("octet-aligned", b"\1\2\3")})},
        ),
        ("85 01 61 81 01 62", {"startArgument": "a", "executionArgument": ("simpleString", "b")}),
    ],
)
def test_attributes_of_either_edition_are_read(argument: str, members: dict[str, Any]) -> None:
    result = bytes.fromhex(f"{ATTRIBUTES} {argument}")
    octets = bytes([0xA1, len(result) + 6, 2, 1, 9, 0xBF, 0x2D, len(result)]) + result
    body = decode(octets).body
    assert {name: body[name] for name in body if "rgument" in name} == members
    assert encode(decode(octets)) == octets


def test_a_name_in_utf8_is_read_and_written() -> None:
    sent = Pdu("confirmed-RequestPDU", 1, "getProgramInvocationAttributes", "机器人")
    assert decode(encode(sent)) == sent


def test_a_notification_carries_the_robots_detail_beside_the_response() -> None:
    result = "A006 800100810100 BF4F0D A00B 3009 800102 81020460 8400"
    told = pdu(f"A332 A230 A003800145 A103800143 820140 A4028200 A81D 800141 A018 {result}")
    outcome, success = told.body["actionResult"]["eventActionResult"]
    assert (outcome, success["response"][0], success["detail"]["robotVMDState"]) == ("success", "status", 2)
    assert decode(encode(told)) == told


def test_a_detail_inside_a_notification_must_be_that_of_its_response() -> None:
    result = "9F2800 BF4F0D A00B 3009 800102 81020460 8400"
    error = refusal(f"A32D A22B A003800145 A103800143 820140 A4028200 A818 800141 A013 {result}")
    assert "a detail of status in a PDU of start" in error.cause
