"""MMS PDUs: what a broken or hostile sender may try, and values that cannot be written."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mmsverify.errors import DecodeError
from mmsverify.formats.mms import EncodeError, Pdu, decode, encode
from mmsverify.samples import annex_a

START = "A01B020105BF28058003504931BF4F0DBF280A3008800135A103810103"
SEEDS = [encode(pdu) for _, pdu in annex_a.conversation()] + [bytes.fromhex(START)]


def pdu(octets: str) -> Pdu:
    return decode(bytes.fromhex(octets))


@pytest.mark.parametrize(
    ("octets", "offset", "cause"),
    [
        ("", 0, "empty"),
        ("FF", 0, "end inside"),
        ("30 00", 0, "no PDU"),
        ("A0 80 00 00", 1, "indefinite"),
        ("8B 00 00", 2, "after the end"),
        ("8B 01 00", 2, "NULL of 1"),
        ("A0 03 80 01 00", 2, "invokeID"),
        ("A0 03 02 01 01", 5, "service"),
        ("A0 06 02 01 FF 80 01 00", 4, "outside the bounds"),
        ("A0 07 02 02 00 01 80 01 00", 4, "more octets"),
        ("A0 07 02 01 01 80 02 00 00", 7, "BOOLEAN of 2"),
        ("A3 08 A1 06 80 01 00 85 01 00", 7, "vmdPhysicalStatus"),
        ("A3 08 A1 06 81 01 00 80 01 00", 4, "vmdLogicalStatus"),
        ("A3 0B A1 09 80 01 00 81 01 00 81 01 00", 10, "twice"),
        ("A3 0B A1 09 80 01 00 81 01 00 87 01 00", 10, "belongs to no member"),
        ("A3 08 A1 06 80 01 00 81 09 FF", 7, "the message ends"),
        ("A0 07 02 01 05 9F 27 02 41", 5, "the message ends"),
        ("A0 08 02 01 05 9F 27 02 41 07", 8, "VisibleString"),
        ("A0 08 02 01 05 9F 27 02 41 FF", 9, "UTF-8"),
    ],
)
def test_octets_that_are_no_pdu_are_refused_with_their_place(octets: str, offset: int, cause: str) -> None:
    with pytest.raises(DecodeError, match=cause) as caught:
        pdu(octets)
    assert caught.value.offset == offset


def test_a_refusal_names_the_field() -> None:
    with pytest.raises(DecodeError) as caught:
        pdu("A00D 020105 A108 A003 800109 A10180")
    assert caught.value.path == "confirmed-RequestPDU.service.getNameList.objectScope"
    assert str(caught.value).startswith("octet 14, confirmed-RequestPDU.service.getNameList.objectScope: ")


def nested(levels: int) -> bytes:
    data = bytes.fromhex("850100")
    for _ in range(levels):
        size = len(data)
        data = (bytes([0xA2, size]) if size < 128 else bytes([0xA2, 0x82, *size.to_bytes(2)])) + data
    accesses = bytes([0xA1, 0x82, *len(data).to_bytes(2)]) + data
    body = bytes.fromhex("020101") + bytes([0xA4, 0x82, *len(accesses).to_bytes(2)]) + accesses
    return bytes([0xA1, 0x82, *len(body).to_bytes(2)]) + body


def test_structures_are_read_to_a_depth_and_refused_beyond_it() -> None:
    assert decode(nested(40)).service == "read"
    for levels in (70, 900, 8000):
        with pytest.raises(DecodeError, match="nested too deeply"):
            decode(nested(levels))


def test_what_is_nested_too_deeply_is_not_written_either() -> None:
    data: Any = ("integer", 1)
    for _ in range(5000):
        data = ("structure", [data])
    with pytest.raises(EncodeError, match="nested too deeply"):
        encode(Pdu("confirmed-ResponsePDU", 1, "read", {"listOfAccessResult": [("success", data)]}))


@pytest.mark.parametrize(
    ("sent", "place"),
    [
        (Pdu("no such PDU"), ""),
        (Pdu("confirmed-RequestPDU", 1), ""),
        (Pdu("confirmed-RequestPDU", None, "identify"), "confirmed-RequestPDU"),
        (Pdu("confirmed-RequestPDU", True, "identify"), "confirmed-RequestPDU.invokeID"),
        (Pdu("confirmed-RequestPDU", 2**31, "identify"), "confirmed-RequestPDU.invokeID"),
        (Pdu("confirmed-RequestPDU", 1, "identify", 5), "confirmed-RequestPDU.service.identify"),
        (Pdu("confirmed-RequestPDU", 1, "dance"), "confirmed-RequestPDU.service"),
        (Pdu("confirmed-RequestPDU", 1, "stop", {}), "confirmed-RequestPDU.service.stop"),
        (Pdu("confirmed-RequestPDU", 1, "stop", {"name": "x"}), "confirmed-RequestPDU.service.stop"),
        (Pdu("confirmed-RequestPDU", 1, "identify", None, 4), "confirmed-RequestPDU.detail"),
        (Pdu("unconfirmed-PDU", None, "eventNotification", []), "unconfirmed-PDU.service.eventNotification"),
    ],
)
def test_a_value_that_does_not_fit_is_refused_with_its_field(sent: Pdu, place: str) -> None:
    with pytest.raises(EncodeError) as caught:
        encode(sent)
    assert caught.value.place == place


def survives(octets: bytes) -> None:
    """Either an error, or a PDU whose encoding means the same."""
    try:
        read = decode(octets)
    except DecodeError as refused:
        place = refused.offset
    else:
        place, again = 0, decode(encode(read))
        assert (again.kind, again.invoke_id, again.service) == (read.kind, read.invoke_id, read.service)
        assert again.body == read.body
    assert 0 <= place <= len(octets)


@settings(max_examples=300, deadline=None)
@given(octets=st.binary(max_size=80))
def test_random_octets_decode_or_are_refused(octets: bytes) -> None:
    survives(octets)


@settings(max_examples=600, deadline=None)
@given(seed=st.sampled_from(SEEDS), data=st.data())
def test_mutated_pdus_decode_or_are_refused(seed: bytes, data: st.DataObject) -> None:
    octets = bytearray(seed)
    for _ in range(data.draw(st.integers(1, 4))):
        at = data.draw(st.integers(0, len(octets)))
        until = data.draw(st.integers(at, min(at + 4, len(octets))))
        octets[at:until] = data.draw(st.binary(max_size=4))
    survives(bytes(octets))


@pytest.mark.parametrize("seed", SEEDS, ids=lambda seed: seed.hex()[:16])
def test_every_truncation_is_refused(seed: bytes) -> None:
    for size in range(len(seed)):
        with pytest.raises(DecodeError):
            decode(seed[:size])
        with pytest.raises(DecodeError):
            decode(seed + seed[: size + 1])
