"""Values that may be left out: any octets would do for them, and who looks at a hidden one is told off."""

from __future__ import annotations

import copy
import pickle
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.audit.learning.classes import Classes, Template
from mmsverify.audit.learning.leaves import (
    BITS,
    INTEGER,
    OCTETS,
    LeafInt,
    Opaque,
    TouchedError,
    fields,
    leaves,
    read,
    real,
)
from mmsverify.formats import mms
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mms import Pdu, encode
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.resources import traces_dir

CHANNEL = Channel.mms("cell", "a1", "server")
VALUES = [("success", ("floating-point", b"\x08\x40\x49\x0f\xdb")), ("success", ("integer", 70_000))]
ANSWER = encode(Pdu("confirmed-ResponsePDU", 300, "read", {"listOfAccessResult": VALUES}))
MESSAGE = TraceMessage(7, 0, CHANNEL, ANSWER)
SAID = sorted(
    {
        m.data
        for path in traces_dir().glob("*.mcap")
        for m in read_trace(path)
        if m.message_encoding == "mms-ber"
    }
)

LOOKS: dict[str, Callable[[Any], object]] = {
    "equal": lambda x: x == 1, "unequal": lambda x: x != 1, "less": lambda x: x < 1,
    "truth": bool, "int": int, "str": str, "repr": repr, "format": lambda x: f"{x}", "bytes": bytes,
    "length": len, "hash": hash, "isinstance": lambda x: isinstance(x, int), "member": lambda x: x in {1, 2},
    "member of a list": lambda x: x in [1, 2], "contains": lambda x: 1 in x, "add": lambda x: x + 1,
    "added": lambda x: 1 + x, "item": lambda x: x[0], "each": list, "attribute": lambda x: x.real,
    "call": lambda x: x(), "index": lambda x: [1, 2][x], "negative": lambda x: -x, "bits": lambda x: x & 1,
    "copy": copy.copy, "deepcopy": copy.deepcopy, "pickle": pickle.dumps, "key": lambda x: {x: 1},
    "sorted": lambda x: sorted([x, x]), "from_bytes": int.from_bytes, "sum": lambda x: sum([x]),
    "percent": lambda x: f"{x!s}", "mapping": dict, "slice": lambda x: b"abc"[x:],
}  # fmt: skip


def matched(value: Any) -> object:
    match value:
        case int():
            return 1
        case {"a": 1}:
            return 2
    return None


@pytest.mark.parametrize("look", [*LOOKS.values(), matched], ids=[*LOOKS, "match"])
def test_who_looks_at_a_hidden_value_is_told_off(look: Callable[[Any], object]) -> None:
    with pytest.raises(TouchedError) as told:
        look(Opaque(MESSAGE, (3, 4), INTEGER))
    assert (told.value.message, told.value.span) == (MESSAGE, (3, 4))


def test_a_hidden_value_can_be_passed_on() -> None:
    hidden = Opaque(MESSAGE, (3, 4), INTEGER)
    passed = {"a": [hidden], "b": (hidden, None)}
    assert passed["a"][0] is hidden
    assert hidden is not None


def test_the_values_of_a_message_are_found_with_their_kinds() -> None:
    found = leaves(ANSWER)
    assert sorted(found.values()) == sorted([OCTETS, INTEGER])
    assert {ANSWER[begin:end] for begin, end in found} == {b"\x08\x40\x49\x0f\xdb", (70_000).to_bytes(3)}


def test_an_invoke_id_and_text_are_no_values_to_be_left_out() -> None:
    asked = encode(Pdu("confirmed-RequestPDU", 300, "kill", {"programInvocationName": "Weld"}))
    assert leaves(asked) == {}
    assert leaves(b"\xa0\x03\x02") == {}


@pytest.mark.parametrize("octets", SAID, ids=lambda octets: octets[:12].hex())
def test_a_message_means_the_same_with_values_that_know_where_they_stand(octets: bytes) -> None:
    message = TraceMessage(0, 0, CHANNEL, octets)
    assert read(message, leaves(octets), real) == mms.decode(octets)


def test_a_value_knows_where_it_stands() -> None:
    span = next(span for span, kind in leaves(ANSWER).items() if kind == INTEGER)
    value = real(MESSAGE, span, INTEGER)
    assert isinstance(value, LeafInt)
    assert (value, value.message, value.span) == (70_000, MESSAGE, span)


@given(st.data())
def test_any_octets_will_do_for_a_value(data: st.DataObject) -> None:
    octets = data.draw(st.sampled_from(SAID))
    made = bytearray(octets)
    found = leaves(octets)
    for (begin, end), kind in found.items():
        first = begin + (kind == BITS)
        made[first:end] = data.draw(st.binary(min_size=end - first, max_size=end - first))
    template = Template(found, len(octets))
    assert template.rest(bytes(made)) == template.rest(octets)
    if template.fits(bytes(made)):
        assert leaves(bytes(made)) == found
        assert fields(bytes(made)) == fields(octets)


@pytest.mark.parametrize(
    ("contents", "fits"), [("0001", False), ("0080", True), ("ff80", False), ("ff7f", True), ("7fff", True)]
)
def test_an_integer_that_is_longer_than_it_need_be_is_of_no_class(contents: str, fits: bool) -> None:
    assert Template({(0, 2): INTEGER}, 2).fits(bytes.fromhex(contents)) is fits


def test_a_class_is_found_by_what_is_left() -> None:
    classes = Classes()
    octets = b"head" + b"\x01\x02" + b"tail"
    template = classes.template(octets, {(4, 6): OCTETS})
    assert template is not None
    template.numbers[template.rest(octets)] = 9
    assert classes.find(b"head" + b"\xff\xff" + b"tail") == 9
    assert classes.find(b"head" + b"\xff\xff" + b"tail2") is None
    assert b"head\xff\xfftail" in classes  # known as a whole now
    classes.forget(9)
    assert b"head\xff\xfftail" not in classes
