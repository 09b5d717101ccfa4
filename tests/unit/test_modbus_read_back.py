"""Values that are read back as others than those written: told where no message explains it, as a note."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st
from modbus_line import Line, echo, opened

from mmsverify.audit.modbus.memory import Memory
from mmsverify.formats.modbus import Adu, Function, Request

TOLD = "modbus.read-back"


def wrote(line: Line, at: int = 1, value: int = 7, name: str = "line") -> Line:
    """A register is written."""
    return line.asks(at, 0x06, 5, value, name=name).answers(at, 0x06, echo(0x06, 5, value), name)


def read(line: Line, at: int = 2, value: int = 7) -> Line:
    """A register is read."""
    return line.asks(at, 0x03, 5, 1).answers(at, 0x03, b"\x02" + value.to_bytes(2))


def test_a_register_that_is_read_back_as_another_value_is_a_note() -> None:
    [finding] = read(wrote(opened()), value=9).found
    assert (finding.rule, finding.severity) == (TOLD, "note")
    assert (finding.index, finding.related) == (4, (1, 3))
    assert (finding.expected, finding.observed) == (("register 5=7",), "register 5=9")
    assert finding.message.startswith("register 5 is read back as 9, but 7 was written last: a program may")


def test_what_was_written_may_be_read_back() -> None:
    assert read(wrote(opened())).told() == []


def test_it_is_told_once() -> None:
    assert read(read(wrote(opened()), value=9), 3, value=8).told() == [(4, TOLD)]


@pytest.mark.parametrize(
    ("function", "value", "rest", "answer", "told"),
    [
        (0x05, 0xFF00, b"", b"\x01\x00", True),
        (0x05, 0xFF00, b"", b"\x01\x01", False),
        (0x05, 0x0000, b"", b"\x01\x01", True),
        (0x0F, 3, b"\x01\x05", b"\x01\x05", False),
        (0x0F, 3, b"\x01\x05", b"\x01\x04", True),
    ],
)
def test_signals_are_compared_too(function: int, value: int, rest: bytes, answer: bytes, told: bool) -> None:
    line = opened().asks(1, function, 5, value, rest).answers(1, function, echo(function, 5, value))
    line.asks(2, 0x01, 5, 3 if function == 0x0F else 1).answers(2, 0x01, answer)
    assert [rule for _, rule in line.told()] == [TOLD] * told


def test_several_registers_are_compared_one_by_one() -> None:
    line = opened().asks(1, 0x10, 5, 2).answers(1, 0x10, echo(0x10, 5, 2))
    line.asks(2, 0x03, 4, 3).answers(2, 0x03, b"\x06\x00\x63\x00\x01\x00\x63")
    assert [(f.rule, f.observed) for f in line.found] == [(TOLD, "register 6=99")]


def test_another_write_explains_it() -> None:
    assert read(wrote(wrote(opened()), 3, value=9), 4, value=9).told() == []


def test_a_write_under_way_explains_it() -> None:
    line = wrote(opened().link("open", "other")).asks(3, 0x06, 5, 9, name="other")
    assert read(line, 4, value=9).told() == []


def test_of_two_writes_at_once_either_may_be_the_last() -> None:
    line = opened().link("open", "other").asks(1, 0x06, 5, 7).asks(1, 0x06, 5, 9, name="other")
    line.answers(1, 0x06, echo(0x06, 5, 9), "other").answers(1, 0x06, echo(0x06, 5, 7))
    assert read(line, 2, value=9).told() == []


def test_a_read_that_was_under_way_shows_the_value_before() -> None:
    line = opened().link("open", "other").asks(1, 0x03, 5, 1)
    wrote(line, name="other").answers(1, 0x03, b"\x02\x00\x63")
    assert line.told() == []


def test_what_is_missing_explains_it() -> None:
    assert read(wrote(opened()).link("gap"), value=9).told() == []
    line = opened().asks(1, 0x06, 5, 7).link("gap").answers(1, 0x06, echo(0x06, 5, 7))
    assert read(line, value=9).told() == []


def test_a_write_that_was_refused_wrote_nothing() -> None:
    line = opened().asks(1, 0x06, 5, 7).answers(1, 0x86, b"\x04")
    assert read(line, value=9).told() == []


def test_units_are_told_apart_where_that_is_safe() -> None:
    line = opened().asks(1, 0x06, 5, 7, unit=1).answers(1, 0x06, echo(0x06, 5, 7), unit=1)
    line.asks(2, 0x03, 5, 1, unit=2).answers(2, 0x03, b"\x02\x00\x63", unit=2)
    assert line.told() == []
    line = wrote(opened()).asks(3, 0x06, 5, 9, unit=255).answers(3, 0x06, echo(0x06, 5, 9), unit=255)
    assert read(line, 4, value=9).told() == []


@pytest.mark.parametrize("function", [0x16, 0x17])
def test_another_function_code_may_have_written_anything(function: int) -> None:
    asked = wrote(opened()).asks(3, function, 0, 0)
    assert read(asked.answers(3, function), 4, value=9).told() == []
    late = wrote(opened().link("open", "other").asks(1, function, 0, 0, name="other"))
    assert read(late.answers(1, function, name="other"), 4, value=9).told() == []


def test_a_write_that_was_never_answered_may_come_at_any_time() -> None:
    line = opened().link("open", "other").asks(1, 0x06, 5, 9, name="other").link("reset", "other")
    assert read(wrote(line), 4, value=9).told() == []
    line = opened().link("open", "other").asks(1, 0x06, 900, 9, name="other").link("reset", "other")
    assert [rule for _, rule in read(wrote(line), 4, value=9).told()] == [TOLD]


def test_an_answer_to_a_write_that_is_not_recorded_may_have_written_anything() -> None:
    line = wrote(opened().link("open", "other").link("gap", "other"))
    assert read(line.answers(9, 0x06, echo(0x06, 5, 9), "other"), value=9).told() == []
    line = wrote(opened()).answers(9, 0x06, echo(0x06, 5, 9))
    assert [rule for _, rule in read(line, value=9).told()] == ["modbus.unasked"]


def test_what_is_amiss_is_told_alone() -> None:
    line = wrote(opened(), 1).asks(3, 0x06, 5, 9).answers(3, 0x06, echo(0x06, 5, 9), unit=2)
    assert [rule for _, rule in read(line, 4, value=7).told()] == ["modbus.unit"]
    line = wrote(opened().link("open", "other")).link("close", "other").asks(1, 0x06, 5, 9, name="other")
    assert [rule for _, rule in read(line, 4, value=9).told()] == ["modbus.closed"]


def test_writes_to_different_addresses_are_not_in_each_others_way() -> None:
    line = opened().asks(1, 0x06, 5, 7).asks(2, 0x06, 6, 7).answers(1, 0x06, echo(0x06, 5, 7))
    assert [rule for _, rule in read(line.answers(2, 0x06, echo(0x06, 6, 7)), 3, value=9).told()] == [TOLD]


def test_many_values_of_one_answer_are_one_note() -> None:
    line = opened().asks(1, 0x10, 5, 2).answers(1, 0x10, echo(0x10, 5, 2))
    [finding] = line.asks(2, 0x03, 5, 2).answers(2, 0x03, b"\x04" + bytes(4)).found
    assert "(and 1 more with it)" in finding.message


def test_inputs_are_not_what_was_written() -> None:
    line = wrote(opened())
    line.asks(2, 0x04, 5, 1).answers(2, 0x04, b"\x02\x00\x63")
    assert line.told() == []


steps = st.lists(
    st.tuples(st.booleans(), st.integers(0, 6), st.integers(1, 4), st.lists(st.booleans(), min_size=4)),
    max_size=30,
)


def bits(values: list[bool]) -> bytes:
    return sum(value << at for at, value in enumerate(values)).to_bytes(2, "little")


def last(said: list[tuple[bool, int, int, list[bool]]], changed: bool) -> list[object]:
    """What is told of a server that keeps its values, or changes each by itself before the last read."""
    held, memory, told = [False] * 16, Memory(), list[object]()
    for number, (write, address, count, values) in enumerate([*said, (False, 0, 10, [])]):
        request = Request(Function.WRITE_MULTIPLE_COILS if write else Function.READ_COILS, address, count)
        if write:
            memory.ask(2 * number, request)
            held[address : address + count] = values[:count]
            memory.accept(2 * number, Adu(1, 1, 15, bytes(5) + bits(values[:count])), 2 * number + 1)
        else:
            shown = held[address : address + count]
            shown = [not value for value in shown] if changed and number == len(said) else shown
            told += memory.read(request, Adu(1, 1, 1, b"\x01" + bits(shown)), 2 * number)
    return told


@given(steps)
def test_a_server_that_keeps_its_values_is_never_told(said: list[tuple[bool, int, int, list[bool]]]) -> None:
    assert last(said, changed=False) == []


@given(steps)
def test_every_written_value_that_is_changed_is_told(said: list[tuple[bool, int, int, list[bool]]]) -> None:
    written = {at for write, address, count, _ in said if write for at in range(address, address + count)}
    assert len(last(said, changed=True)) == len(written)
