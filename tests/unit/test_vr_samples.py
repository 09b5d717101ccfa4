"""VR samples: the table of cells against the framework's text, and what a message may and may not say."""

from __future__ import annotations

import pytest

from mmsverify.errors import DecodeError
from mmsverify.formats.vr import CELLS, BadCell, cell, cell_name, decode, encode

# VR(0) to VR(15) as the framework's table of global interface variables lists them, with their statements.
TABLE = """
 0 C_RunMD          V-VR-00
 1 CS_RunSTA        V-VR-01
 2 -                V-VR-02
 3 CS_RunStepCount  V-VR-03
 4 C_SubMD          V-VR-04
 5 C_Cmd            V-VR-05
 6 -                V-VR-02
 7 -                V-VR-02
 8 CS_WarnId        V-VR-08
 9 CS_ErrId         V-VR-09
10 CF_Home          V-VR-10
11 CF_Stop          V-VR-11
12 CF_Pause         V-VR-12
13 CF_Step          V-VR-13
14 CF_Err           V-VR-14
15 CF_AutoOrg       V-VR-15
"""

ROWS = [line.split() for line in TABLE.splitlines() if line]


@pytest.mark.exercises("V-VR-*")
@pytest.mark.parametrize(("number", "name", "clause"), ROWS)
def test_a_number_bears_the_name_of_the_table(number: str, name: str, clause: str) -> None:
    found = CELLS[int(number)]
    assert found.number == int(number)
    assert (found.name, found.reserved) == ((f"VR({number})", True) if name == "-" else (name, False))
    assert clause in found.cites
    assert decode(f'{{"VR({number})": 1}}'.encode()).cells == {found.name: 1}


@pytest.mark.parametrize(
    "text", ["VR(5)", "VR5", "VR[5]", "vr( 5 )", "VR_5", "VR(05)", "C_Cmd", "VR(C_Cmd)", "c_cmd", " C_Cmd "]
)
def test_a_cell_has_many_spellings(text: str) -> None:
    assert cell(text) is CELLS[5]


@pytest.mark.parametrize(
    "text", ["", "5", "VR", "VR(16)", "VR16", "VR(5", "VR5)", "VR(-1)", "VR5.0", "Temperature", "VR(x)"]
)
def test_other_texts_name_no_cell_and_stay_as_they_are(text: str) -> None:
    assert cell(text) is None
    assert cell_name(text) == text


def test_a_sample_tells_its_cells_by_macro_name() -> None:
    said = decode(b'{"C_RunMD": 1, "VR1": 1, "VR(10)": 0, "Temperature": 21.5}')
    assert said.cells == {"C_RunMD": 1, "CS_RunSTA": 1, "CF_Home": 0, "Temperature": 21.5}
    assert said.bad == ()


def test_numbers_as_the_controller_stores_them_become_integers() -> None:
    cells = decode(b'{"C_RunMD": 6.0, "CS_ErrId": -0.0, "C_Cmd": 1.01e2, "x": 6.5}').cells
    assert [(value, type(value)) for value in cells.values()] == [
        (6, int),
        (0, int),
        (101, int),
        (6.5, float),
    ]


@pytest.mark.parametrize(
    ("value", "found"),
    [
        ('"6"', '"6"'),
        ("true", "true"),
        ("null", "null"),
        ("NaN", "NaN"),
        ("-Infinity", "-Infinity"),
        ("1e999", "Infinity"),
        ("9" * 5000, "Infinity"),
        ("[6]", "a list"),
        ('{"a": 6}', "an object"),
        (f'"{"a" * 50}"', f'"{"a" * 40}"...'),
    ],
)
def test_a_cell_without_a_number_is_told_and_the_others_are_kept(value: str, found: str) -> None:
    said = decode(f'{{"CS_RunSTA": 6, "VR0": {value}, "C_Cmd": 0}}'.encode())
    assert said.cells == {"CS_RunSTA": 6, "C_Cmd": 0}
    assert said.bad == (BadCell("C_RunMD", found),)


def test_every_cell_without_a_number_is_told() -> None:
    said = decode(b'{"C_RunMD": "a", "C_Cmd": null, "other": false}')
    assert [bad.name for bad in said.bad] == ["C_RunMD", "C_Cmd", "other"]


def test_a_cell_that_is_said_twice_must_agree() -> None:
    assert decode(b'{"VR0": 6, "C_RunMD": 6.0}').cells == {"C_RunMD": 6}
    said = decode(b'{"VR0": 6, "C_Cmd": 1, "C_RunMD": 7}')
    assert (said.cells, said.bad) == ({"C_Cmd": 1}, (BadCell("C_RunMD", "both 6 and 7"),))


@pytest.mark.parametrize(
    ("data", "told"),
    [
        (b"", "octet 0: this is no JSON: Expecting value"),
        (b'{"C_RunMD": 6', "octet 13: this is no JSON: Expecting ',' delimiter"),
        ('{"é": x}'.encode(), "octet 7: this is no JSON: Expecting value"),
        (b'{"C_RunMD": 6} 7', "octet 15: this is no JSON: Extra data"),
        (b"\x00\x01\x02\x03\x04", "octet 0: this is no JSON"),
        ('{"C_RunMD": 6}'.encode("utf-16-be"), "octet 0: this is no JSON"),
        (b'{"\xff": 1}', "octet 2: this is no JSON: it is not UTF-8"),
        (b"[1, 2]", "octet 0: a VR sample is a JSON object, not a list"),
        (b"6", "octet 0: a VR sample is a JSON object, not 6"),
        (b"null", "octet 0: a VR sample is a JSON object, not null"),
        (b"[" * 100_000, "octet 0: a VR sample is a JSON object of numbers, not so deep a thing"),
    ],
)
def test_what_is_no_json_object_is_refused_with_its_place(data: bytes, told: str) -> None:
    with pytest.raises(DecodeError) as raised:
        decode(data)
    assert str(raised.value).startswith(told)


def test_an_object_without_cells_says_nothing() -> None:
    assert decode(b"{}").cells == {}


def test_a_written_sample_reads_back() -> None:
    cells = {"C_RunMD": 6, "CS_RunSTA": 10, "Temperature": 21.5}
    assert encode(cells) == b'{"C_RunMD":6,"CS_RunSTA":10,"Temperature":21.5}'
    assert decode(encode(cells)).cells == cells
