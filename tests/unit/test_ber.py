"""Identifiers, lengths and the contents of the built-in types, octet by octet (X.690)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.formats import ber
from mmsverify.formats.ber import Fault


def refused(read: Callable[[bytes, int, int], Any], contents: str) -> Fault:
    octets = bytes.fromhex(contents)
    with pytest.raises(Fault) as caught:
        read(octets, 0, len(octets))
    return caught.value


@pytest.mark.parametrize(
    ("octets", "expected"),
    [
        ("0500", (0x05, 2, 2)),
        ("BF2805" + "00" * 5, (0xBF28, 3, 8)),
        ("048103010203", (0x04, 3, 6)),
        ("04830000020102", (0x04, 5, 7)),
    ],
)
def test_a_header_gives_identifier_and_contents(octets: str, expected: tuple[int, int, int]) -> None:
    raw = bytes.fromhex(octets)
    assert ber.header(raw, 0, len(raw)) == expected


@pytest.mark.parametrize(
    ("octets", "cause"),
    [
        ("", "end inside"),
        ("30", "end inside"),
        ("BF", "end inside"),
        ("BFA8", "end inside"),
        ("BF8028" + "00", "more octets than it needs"),
        ("BF1E00", "more octets than it needs"),
        ("30800000", "indefinite"),
        ("30FF", "reserved"),
        ("3082", "end inside a length"),
        ("3003800101" + "00" * 0, None),
        ("3004800101", "the message ends after 3"),
    ],
)
def test_a_broken_header_is_refused_with_its_cause(octets: str, cause: str | None) -> None:
    raw = bytes.fromhex(octets)
    if cause is None:
        assert ber.header(raw, 0, len(raw)) == (0x30, 2, 5)
        return
    with pytest.raises(Fault, match=cause):
        ber.header(raw, 0, len(raw))


def test_an_element_must_end_with_its_parent() -> None:
    with pytest.raises(Fault, match="its parent ends after 1"):
        ber.header(bytes.fromhex("8002010203"), 0, 3)


@given(st.integers(0, 2**20), st.sampled_from([0x02, 0xA0, 0xBF4F]))
def test_what_is_written_as_an_element_has_that_header(size: int, head: int) -> None:
    octets = ber.element(head, bytes(size))
    found, begin, end = ber.header(octets, 0, len(octets))
    assert (found, end - begin, end) == (head, size, len(octets))


@given(st.integers(-(2**200), 2**200))
def test_an_integer_reads_back(number: int) -> None:
    octets = ber.write_integer(number)
    assert ber.read_integer(octets, 0, len(octets)) == number


@pytest.mark.parametrize(
    ("contents", "value"), [("00", 0), ("7F", 127), ("80", -128), ("0080", 128), ("FF7F", -129)]
)
def test_integers_are_twos_complement(contents: str, value: int) -> None:
    octets = bytes.fromhex(contents)
    assert (ber.read_integer(octets, 0, len(octets)), ber.write_integer(value)) == (value, octets)


@pytest.mark.parametrize("contents", ["", "0001", "FFFF", "000000"])
def test_an_integer_that_is_empty_or_too_long_is_refused(contents: str) -> None:
    assert "INTEGER" in refused(ber.read_integer, contents).cause


@given(st.text("01", max_size=40))
def test_a_bit_string_reads_back(bits: str) -> None:
    octets = ber.write_bits(bits)
    assert ber.read_bits(octets, 0, len(octets)) == bits


@pytest.mark.parametrize("contents", ["", "01", "0800", "FF00"])
def test_a_bit_string_with_wrong_unused_bits_is_refused(contents: str) -> None:
    assert "BIT STRING" in refused(ber.read_bits, contents).cause


@given(st.lists(st.integers(0, 2**100), max_size=5), st.integers(0, 39), st.integers(0, 2))
def test_an_object_identifier_reads_back(arcs: list[int], second: int, first: int) -> None:
    text = ".".join(map(str, (first, second, *arcs)))
    octets = ber.write_oid(text)
    assert ber.read_oid(octets, 0, len(octets)) == text


def test_the_object_identifier_of_mms_is_that_of_the_standard() -> None:
    assert ber.read_oid(bytes.fromhex("28CA220201"), 0, 5) == "1.0.9506.2.1"


@pytest.mark.parametrize("contents", ["", "28CA", "288001", "28" + "FF" * 30 + "01"])
def test_a_broken_object_identifier_is_refused(contents: str) -> None:
    assert "OBJECT IDENTIFIER" in refused(ber.read_oid, contents).cause


@pytest.mark.parametrize(
    ("read", "contents", "cause"),
    [
        (ber.read_boolean, "", "BOOLEAN of 0"),
        (ber.read_boolean, "0000", "BOOLEAN of 2"),
        (ber.read_null, "00", "NULL of 1"),
        (ber.read_visible, "41E4", "VisibleString"),
        (ber.read_visible, "410A", "VisibleString"),
        (ber.read_utf8, "41C3", "UTF8String"),
        (ber.read_utf8, "EDA080", "UTF8String"),
        (ber.read_graphic, "4107", "GraphicString"),
        (ber.read_time, "32303236", "GeneralizedTime"),
    ],
)
def test_contents_that_the_type_forbids_are_refused(
    read: Callable[[bytes, int, int], Any], contents: str, cause: str
) -> None:
    assert cause in refused(read, contents).cause


def test_the_fault_of_a_string_stands_at_its_first_bad_octet() -> None:
    assert refused(ber.read_utf8, "4142C3").offset == 2


def test_an_any_must_be_one_wellformed_element() -> None:
    ber.check_element(bytes.fromhex("300430020500"), 0, 6, 5)
    for octets, cause in [
        ("05000500", "after the end"),
        ("30020501", "message ends"),
        ("3003300105", "inside"),
    ]:
        raw = bytes.fromhex(octets)
        with pytest.raises(Fault, match=cause):
            ber.check_element(raw, 0, len(raw), 5)
