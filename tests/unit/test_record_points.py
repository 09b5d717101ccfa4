"""The map of what to poll: what it says, how few requests it takes, and what is told of a mistake."""

from __future__ import annotations

import struct
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.errors import InputError
from mmsverify.formats.vr import CELLS
from mmsverify.recording.points import TABLES, Point, PollMap, Read, read_map

MAP = """
controller = "press"
period = 0.05

[vr]
C_RunMD = {holding = 0}
"VR(1)" = {holding = 1, type = "int16"}
C_Cmd = {holding = 2, type = "float32", words = "little"}
CF_Home = {coil = 7}

[signals]
coil = [0, 2500]
discrete = [[0, 7], [100, 107]]
"""


def mapped(tmp_path: Path, text: str) -> PollMap:
    path = tmp_path / "map.toml"
    path.write_text(text, encoding="utf-8")
    return read_map(path)


def test_a_map_says_what_to_poll(tmp_path: Path) -> None:
    found = mapped(tmp_path, MAP)
    assert (found.controller, found.unit, found.period, found.timeout) == ("press", 1, 0.05, 1.0)
    assert [point.cell for point in found.points] == ["C_RunMD", "CS_RunSTA", "C_Cmd", "CF_Home"]
    assert found.reads() == (Read("coil", 7, 1), Read("holding", 0, 4))
    assert found.signals == (
        Read("coil", 0, 2000),
        Read("coil", 2000, 501),
        Read("discrete", 0, 8),
        Read("discrete", 100, 8),
    )


@pytest.mark.parametrize(
    ("kind", "value", "words"),
    [
        ("uint16", 65535, (0xFFFF,)),
        ("int16", -2, (0xFFFE,)),
        ("int32", -70000, struct.unpack(">HH", struct.pack(">i", -70000))),
        ("uint32", 70000, (1, 4464)),
        ("float32", 6, (0x40C0, 0)),
        ("float32", 0.5, (0x3F00, 0)),
    ],
)
def test_a_value_is_read_as_the_map_says(kind: str, value: float, words: tuple[int, ...]) -> None:
    assert Point("C_Cmd", "holding", 0, kind).value(words) == value
    assert Point("C_Cmd", "holding", 0, kind, swapped=True).value(words[::-1]) == value


def test_what_is_no_number_is_no_value() -> None:
    assert Point("C_Cmd", "holding", 0, "float32").value((0x7FC0, 0)) is None


places = st.tuples(
    st.sampled_from(["holding", "input"]), st.integers(0, 300), st.sampled_from(["uint16", "float32"])
)


@given(st.lists(places, min_size=1, max_size=len(CELLS)))
def test_every_cell_is_read_whole_in_one_request_and_nothing_else(found: list[tuple[str, int, str]]) -> None:
    points = tuple(Point(cell.name, *place) for cell, place in zip(CELLS, found, strict=False))
    reads = PollMap(points, ()).reads()
    asked = {(read.table, read.address + at) for read in reads for at in range(read.count)}
    needed = {(point.table, point.address + at) for point in points for at in range(point.size)}
    assert asked == needed
    assert all(read.count <= 125 for read in reads)
    for point in points:
        holders = [
            read
            for read in reads
            if read.table == point.table
            and read.address <= point.address
            and point.address + point.size <= read.address + read.count
        ]
        assert holders


def test_a_table_is_read_by_its_function_code() -> None:
    assert [Read(table, 0, 1).function for table in TABLES] == [1, 2, 3, 4]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("", "map.toml: nothing to poll (name cells in [vr]"),
        ("x = ", "map.toml: Invalid value"),
        ("speed = 1", "map.toml: unknown key speed (known are controller"),
        ("vr = 1", "map.toml: vr is not a table (write [vr])"),
        ("[vr]\nC_Foo = {coil = 1}", "map.toml [vr] C_Foo: no VR cell (the cells are C_RunMD"),
        ("[vr]\nC_Cmd = 1", "map.toml [vr] C_Cmd: 1 is no place of a value (write it like"),
        ("[vr]\nC_Cmd = {coil = 1, holding = 2}", "is no place of a value"),
        ("[vr]\nC_Cmd = {coil = 1, type = 'int16'}", "unknown key type"),
        ("[vr]\nC_Cmd = {holding = -1}", "-1 is not allowed (a whole number from 0 to 65535)"),
        ("[vr]\nC_Cmd = {holding = true}", "True is not allowed"),
        ("[vr]\nC_Cmd = {holding = 1, type = 'bcd'}", "no type 'bcd' (one of uint16"),
        ("[vr]\nC_Cmd = {holding = 1, words = 'mid'}", "words = 'mid' is no order"),
        ("[vr]\nC_Cmd = {holding = 65535, type = 'int32'}", "its last register would be 65536"),
        ("[vr]\nC_Cmd = {coil = 1}\n'VR(5)' = {coil = 2}", "map.toml [vr]: C_Cmd stands there twice"),
        ("[signals]\nregister = [0, 1]", "map.toml [signals] register: no such table"),
        ("[signals]\ncoil = [1]", "[1] is no range"),
        ("[signals]\ncoil = [9, 1]", "9 to 1 is empty"),
        ("[signals]\ncoil = 4", "4 is no range"),
        ("period = 0\n[signals]\ncoil = [0, 1]", "period = 0 is not allowed (seconds"),
        ("unit = 256\n[signals]\ncoil = [0, 1]", "256 is not allowed"),
        ("controller = 'a/b'\n[signals]\ncoil = [0, 1]", "is no name"),
    ],
)
def test_a_mistake_is_told_with_place_and_mend(text: str, told: str, tmp_path: Path) -> None:
    with pytest.raises(InputError) as refused:
        mapped(tmp_path, text)
    assert told in str(refused.value)


def test_a_map_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="No such file"):
        read_map(tmp_path / "none.toml")
