"""Functions that are written from the ASN.1 types read what the types themselves read, or give up."""

from __future__ import annotations

import json
from contextlib import suppress
from functools import cache
from random import Random

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from mms_values import values
from two_ways import GAVE_UP, agree, root, short_way

from mmsverify.formats import compiled, mms
from mmsverify.formats.ber import element
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.schema import TABLE, Schema
from mmsverify.resources import asn1_dir, traces_dir

SLOW_TO_DRAW = settings(deadline=None, suppress_health_check=[HealthCheck.too_slow], max_examples=200)
NESTS = 70


@cache
def sampled() -> tuple[bytes, ...]:
    """Every PDU of the shipped samples, once."""
    messages = (one for path in sorted(traces_dir().glob("*.mcap")) for one in read_trace(path))
    return tuple(dict.fromkeys(one.data for one in messages if one.message_encoding == "mms-ber"))


def array(depth: int) -> bytes:
    """An InformationReport of a Boolean in so many arrays, one in another."""
    data = b"\x83\x01\xff"
    for _ in range(depth):
        data = element(0xA1, data)
    named = element(0xA0, element(0x30, element(0xA0, b"\x80\x01x")))
    return element(0xA3, element(0xA0, named + element(0xA0, data)))


def test_all_that_the_samples_say_is_read_the_short_way() -> None:
    assert all(map(agree, sampled()))


def test_a_function_can_be_made_of_every_type() -> None:
    schema, modules = Schema.of_folder(asn1_dir()), json.loads((asn1_dir() / TABLE).read_text("utf-8"))
    names = {name for module in modules["modules"].values() for name in module["types"]}
    for name in sorted(names):
        for read in [*compiled.root_table(schema.type(name), often=1).values()]:
            with suppress(*compiled.GIVES_UP):
                read(b"", 0, 0, 1)
    assert len(names) > 250


@SLOW_TO_DRAW
@given(st.data())
def test_any_value_is_read_alike(data: st.DataObject) -> None:
    name = data.draw(st.sampled_from(sorted(root().alternatives)))
    agree(root().write((name, data.draw(values(root().alternatives[name], 6))), 0))


@pytest.mark.parametrize("seed", range(5))
def test_what_the_functions_read_the_types_read_too(seed: int) -> None:
    chance = Random(seed)
    for _ in range(2000):
        octets = bytearray(chance.choice(sampled()))
        for _ in range(chance.choice((1, 1, 2))):
            place = chance.randrange(len(octets))
            octets[place] = chance.choice((0, 1, 2, 0x30, 0x7F, 0x80, 0x81, 0xA0, 0xFF, octets[place] ^ 1))
        agree(bytes(octets))


def test_deep_nesting_is_left_to_the_types() -> None:
    read = [agree(array(depth)) for depth in range(NESTS)]
    assert read[5]
    assert not read[-1]
    assert sorted(read, reverse=True) == read


def test_a_null_that_is_written_as_constructed_is_left_to_the_types() -> None:
    assert agree(bytes.fromhex("8b00"))
    assert not agree(bytes.fromhex("ab00"))


def test_a_length_that_is_a_lie_takes_no_memory() -> None:
    lie = bytes.fromhex("a111 020101 a00c 800100 810100 82847fffffff")
    assert short_way(lie) == GAVE_UP


def test_an_integer_in_more_octets_than_it_needs_is_left_to_the_types() -> None:
    assert agree(bytes.fromhex("85017f"))
    assert agree(bytes.fromhex("85020080"))
    assert [agree(bytes.fromhex(octets)) for octets in ("8502007f", "8503007fff", "8500")] == [False] * 3


def test_a_function_is_made_when_it_is_asked_for_often() -> None:
    table = compiled.root_table(root(), often=3)
    first = table[0x85]
    for _ in range(2):
        with pytest.raises(compiled.Irregular):
            table[0x85](b"\x85\x01\x05", 2, 3, 1)
    assert table[0x85](b"\x85\x01\x05", 2, 3, 1) == ("cancel-RequestPDU", 5)
    assert table[0x85] is not first


def test_the_decoder_says_the_same_before_and_after() -> None:
    octets = next(one for one in sampled() if one[0] == 0xA0)
    first = mms.decode(octets)
    assert {mms.decode(octets) == first for _ in range(3 * compiled.OFTEN)} == {True}
    assert isinstance(first, mms.Pdu)
