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
    assert (finding.expected, finding.observed) == (("5=7",), "5=9")
    assert finding.message.startswith("register 5 is read back as 9, but 7 was written last")


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
    assert [(f.rule, f.observed) for f in line.found] == [(TOLD, "6=99")]


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


def test_units_are_devices_of_their_own() -> None:
    line = opened().asks(1, 0x06, 5, 7, unit=1).answers(1, 0x06, echo(0x06, 5, 7), unit=1)
    line.asks(2, 0x03, 5, 1, unit=2).answers(2, 0x03, b"\x02\x00\x63", unit=2)
    assert line.told() == []


def test_inputs_are_not_what_was_written() -> None:
    line = wrote(opened())
    line.asks(2, 0x04, 5, 1).answers(2, 0x04, b"\x02\x00\x63")
    assert line.told() == []


steps = st.lists(
    st.tuples(st.booleans(), st.integers(0, 6), st.integers(1, 4), st.lists(st.booleans(), min_size=4)),
    max_size=30,
)


def bits(values: list[bool]) -> bytes:
    return sum(value << at for at, value in enumerate(values)).to_bytes(1)


@given(steps)
def test_a_server_that_keeps_its_values_is_never_told(said: list[tuple[bool, int, int, list[bool]]]) -> None:
    held, memory = [False] * 16, Memory()
    for number, (write, address, count, values) in enumerate(said):
        if write:
            request = Request(Function.WRITE_MULTIPLE_COILS, address, count)
            memory.ask(request)
            held[address : address + count] = values[:count]
            memory.accept(request, bytes(5) + bits(values[:count]), 2 * number, 2 * number + 1)
        else:
            request = Request(Function.READ_COILS, address, count)
            answer = Adu(1, 1, 1, b"\x01" + bits(held[address : address + count]))
            assert list(memory.read(request, answer, 2 * number)) == []
