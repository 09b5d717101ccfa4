"""Modbus/TCP octets: what is an ADU, what a request asks for, which answers belong to it."""

from __future__ import annotations

import struct

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.errors import DecodeError
from mmsverify.formats.modbus import HEADER, MBAP, Adu, Function, Request, decode, request, size, unlike

WORD = st.integers(0, 0xFFFF)
OCTET = st.integers(0, 0xFF)
READS = {0x01: 2000, 0x02: 2000, 0x03: 125, 0x04: 125}
WRITES = {0x0F: 1968, 0x10: 123}


def adu(pdu: bytes, transaction: int = 7, protocol: int = 0, unit: int = 1, more: int = 0) -> bytes:
    """An ADU; ``more`` is added to the length that it tells."""
    head = transaction.to_bytes(2) + protocol.to_bytes(2) + (len(pdu) + 1 + more).to_bytes(2)
    return head + unit.to_bytes(1) + pdu


def asked(function: int, *words: int, rest: bytes = b"") -> Request:
    found = request(Adu(1, 1, function, b"".join(w.to_bytes(2) for w in words) + rest))
    assert found is not None
    return found


def octets_of(function: int, quantity: int) -> int:
    return -(-quantity // 8) if function in (0x01, 0x02, 0x0F) else 2 * quantity


@given(WORD, OCTET, st.binary(min_size=1, max_size=253))
@pytest.mark.exercises("M-2.2-2", "M-2.2-3", "M-2.2-4", "M-2.2-5", "M-2.2-6")
def test_the_octets_of_an_adu_give_its_fields_back(transaction: int, unit: int, pdu: bytes) -> None:
    assert decode(adu(pdu, transaction, unit=unit)) == Adu(transaction, unit, pdu[0], pdu[1:])


@pytest.mark.exercises("M-2.2-2", "M-2.2-4", "M-2.2-5")
def test_the_header_has_seven_octets_in_four_fields_and_no_address() -> None:
    assert HEADER.size == 7
    assert [(field.name, struct.calcsize(field.code)) for field in MBAP] == [
        ("transaction identifier", 2),
        ("protocol identifier", 2),
        ("length", 2),
        ("unit identifier", 1),
    ]


@pytest.mark.parametrize("length", range(8))
@pytest.mark.exercises("M-2.2-2")
def test_a_header_alone_or_less_is_no_adu(length: int) -> None:
    with pytest.raises(DecodeError, match="too short"):
        decode(adu(b"\x01\x00\x01\x00\x01")[:length])


@given(st.integers(1, 0xFFFF))
@pytest.mark.exercises("M-2.2-5")
def test_a_protocol_identifier_other_than_nought_is_an_error(protocol: int) -> None:
    with pytest.raises(DecodeError, match="protocol identifier"):
        decode(adu(b"\x01\x00\x01\x00\x01", protocol=protocol))


@pytest.mark.parametrize("more", [-6, -1, 1, 250])
@pytest.mark.exercises("M-2.2-5")
def test_a_length_that_is_not_that_of_the_octets_is_an_error(more: int) -> None:
    with pytest.raises(DecodeError, match="the length says"):
        decode(adu(b"\x01\x00\x01\x00\x01", more=more))


@pytest.mark.exercises("M-2.2-6")
def test_a_checksum_after_the_pdu_is_an_error() -> None:
    with pytest.raises(DecodeError, match="6 octets, and 8 follow"):
        decode(adu(b"\x01\x00\x01\x00\x01") + b"\xac\x0a")


@pytest.mark.exercises("M-2.2-2")
def test_a_pdu_of_254_octets_is_too_long() -> None:
    assert len(decode(adu(bytes([0x10] * 253))).data) == 252
    with pytest.raises(DecodeError, match="a PDU of 254 octets"):
        decode(adu(bytes([0x10] * 254)))


@pytest.mark.parametrize(("function", "refuses"), [(0x01, False), (0x7F, False), (0x80, True), (0x81, True)])
@pytest.mark.exercises("M-2.2-3")
def test_a_function_code_from_0x80_on_is_an_exception(function: int, refuses: bool) -> None:
    assert Adu(1, 1, function, b"\x02").exception is refuses


@given(OCTET, st.binary(max_size=252))
def test_no_data_of_any_function_code_are_beyond_reading(function: int, data: bytes) -> None:
    found = request(Adu(1, 1, function, data))
    assert (found is None) == (function not in set(Function))


@given(st.sampled_from(sorted(READS)), WORD, WORD)
@pytest.mark.exercises("M-2.2-3")
def test_a_read_asks_for_an_address_and_a_quantity(function: int, address: int, quantity: int) -> None:
    found = asked(function, address, quantity)
    assert (found.function, found.address, found.quantity) == (function, address, quantity)
    assert (found.amiss == "") == (1 <= quantity <= READS[function])


@given(st.sampled_from(sorted(WRITES)), WORD, st.integers(1, 1968))
@pytest.mark.exercises("M-2.2-3")
def test_a_write_of_many_asks_for_as_many_octets_as_its_quantity_takes(
    function: int, address: int, quantity: int
) -> None:
    octets = octets_of(function, quantity)
    found = asked(function, address, quantity, rest=bytes([octets & 0xFF]) + bytes(octets))
    assert (found.address, found.quantity) == (address, quantity)
    assert (found.amiss == "") == (quantity <= WRITES[function])


@pytest.mark.parametrize("function", [0x0F, 0x10])
@pytest.mark.parametrize(("count", "octets"), [(1, 2), (2, 1), (2, 3), (0, 0), (3, 3)])
def test_a_write_of_many_with_another_byte_count_is_amiss(function: int, count: int, octets: int) -> None:
    quantity = 16 if function == 0x0F else 1
    assert asked(function, 0, quantity, rest=bytes([count]) + bytes(octets)).amiss != ""


@pytest.mark.parametrize("function", [0x0F, 0x10])
def test_a_write_of_many_without_a_byte_count_is_amiss(function: int) -> None:
    assert asked(function, 0, 1).amiss == "0 octets follow the quantity"


@given(WORD, WORD)
def test_a_single_coil_is_set_on_or_off_and_nothing_between(address: int, value: int) -> None:
    found = asked(0x05, address, value)
    assert (found.address, found.quantity, found.value) == (address, 1, value)
    assert (found.amiss == "") == (value in (0xFF00, 0x0000))


@given(WORD, WORD)
def test_a_single_register_takes_any_word(address: int, value: int) -> None:
    assert asked(0x06, address, value) == Request(Function.WRITE_SINGLE_REGISTER, address, 1, value)


@pytest.mark.parametrize("function", [0x01, 0x02, 0x03, 0x04, 0x05, 0x06])
def test_octets_after_an_address_and_a_word_are_amiss(function: int) -> None:
    assert asked(function, 0, 0, rest=b"\x00").amiss != ""
    assert asked(function, 0, 1, rest=b"\x00").amiss != ""


@pytest.mark.parametrize("function", sorted(Function))
def test_data_of_three_octets_are_amiss(function: int) -> None:
    assert asked(function, rest=bytes(3)).amiss == "its data are too short"


@given(st.sampled_from(sorted(READS)), st.data())
def test_a_read_is_answered_by_as_many_octets_as_it_asks_for(function: int, data: st.DataObject) -> None:
    quantity = data.draw(st.integers(1, READS[function]))
    read, octets = asked(function, 0, quantity), octets_of(function, quantity)
    assert size(Function(function), quantity) == octets
    wrong = (octets + 1, octets + 1), (octets - 1, octets), (octets, octets - 1)
    for count, given_octets in ((octets, octets), *wrong):
        answer = Adu(1, 1, function, bytes([count & 0xFF]) + bytes(given_octets))
        assert (unlike(read, answer) == "") == (count == given_octets == octets)


def test_a_read_is_not_answered_by_nothing() -> None:
    assert "byte count missing, not 1" in unlike(asked(0x01, 0, 8), Adu(1, 1, 0x01, b""))


@pytest.mark.parametrize(
    ("function", "words", "rest"),
    [
        (0x05, (17, 0xFF00), b""),
        (0x06, (17, 3), b""),
        (0x0F, (17, 3), b"\x01\x05"),
        (0x10, (17, 1), b"\x02\x00\x05"),
    ],
)
def test_a_write_is_answered_by_its_own_address_and_word(
    function: int, words: tuple[int, int], rest: bytes
) -> None:
    write = asked(function, *words, rest=rest)
    assert write.amiss == ""

    def told(address: int, word: int, more: bytes = b"") -> str:
        return unlike(write, Adu(1, 1, function, struct.pack(">HH", address, word) + more))

    address, word = words
    assert told(address, word) == ""
    assert told(address + 1, word) == "address 18, not 17"
    assert told(address, word ^ 0x0101).endswith(f"not {word}")
    assert told(address, word, b"\x00") == "5 octets of data, not 4"
