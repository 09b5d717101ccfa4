"""The VR cells of the template framework: which number bears which macro name, and samples of them in JSON.

The numbers are one table with the statements that give them their names. What a value means belongs to the
model; here a value only has to be a number.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any, NoReturn

from mmsverify.errors import DecodeError


@dataclass(frozen=True, slots=True)
class Cell:
    """One of the cells that the system keeps for itself.

    ``name`` is its macro name, or for a reserved one its number as the framework writes it.
    """

    number: int
    name: str
    cites: tuple[str, ...]
    reserved: bool = False


CELLS: tuple[Cell, ...] = (
    Cell(0, "C_RunMD", ("V-VR-00", "V-VR-N")),
    Cell(1, "CS_RunSTA", ("V-VR-01", "V-VR-N")),
    Cell(2, "VR(2)", ("V-VR-02", "V-VR-N"), reserved=True),
    Cell(3, "CS_RunStepCount", ("V-VR-03", "V-VR-N")),
    Cell(4, "C_SubMD", ("V-VR-04", "V-VR-N")),
    Cell(5, "C_Cmd", ("V-VR-05", "V-VR-N")),
    Cell(6, "VR(6)", ("V-VR-02", "V-VR-N"), reserved=True),
    Cell(7, "VR(7)", ("V-VR-02", "V-VR-N"), reserved=True),
    Cell(8, "CS_WarnId", ("V-VR-08", "V-VR-N")),
    Cell(9, "CS_ErrId", ("V-VR-09", "V-VR-N")),
    Cell(10, "CF_Home", ("V-VR-10", "V-VR-N")),
    Cell(11, "CF_Stop", ("V-VR-11", "V-VR-N")),
    Cell(12, "CF_Pause", ("V-VR-12", "V-VR-N")),
    Cell(13, "CF_Step", ("V-VR-13", "V-VR-N")),
    Cell(14, "CF_Err", ("V-VR-14", "V-VR-N")),
    Cell(15, "CF_AutoOrg", ("V-VR-15", "V-VR-N")),
)
"""VR(0) to VR(15), by number."""

BY_NAME: Mapping[str, Cell] = {cell.name: cell for cell in CELLS}

_FOLDED = {cell.name.casefold(): cell for cell in CELLS}
_NUMBERED = re.compile(
    r"VR\s*(?:\(\s*(\d{1,6})\s*\)|\[\s*(\d{1,6})\s*\]|_?(\d{1,6}))", re.IGNORECASE | re.ASCII
)
_AROUND = re.compile(r"VR\s*[(\[]\s*(\w+)\s*[)\]]", re.IGNORECASE)

Number = int | float

LONGEST_NAME = 200
"""Characters of a name that is looked at: what is longer names no cell, and is not kept in mind."""


@dataclass(frozen=True, slots=True)
class BadCell:
    """A cell whose value is no number: its name, and what stands there instead."""

    name: str
    found: str


@dataclass(frozen=True, slots=True)
class Sample:
    """What one message says: the cells with a number, by name, and those that have none."""

    cells: Mapping[str, Number]
    bad: tuple[BadCell, ...] = ()


def cell(text: str) -> Cell | None:
    """The cell that a text names: ``C_RunMD``, ``VR(0)``, ``VR[0]``, ``VR0``, ``VR_0`` or ``VR(C_RunMD)``.

    BASIC knows no capitals, so neither do names here. Nothing for what is no name of VR(0) to VR(15).
    """
    return _cell(text) if len(text) <= LONGEST_NAME else None


@lru_cache(maxsize=1024)
def _cell(text: str) -> Cell | None:
    text = text.strip()
    if around := _AROUND.fullmatch(text):
        text = around[1] if not around[1].isdigit() else text
    if numbered := _NUMBERED.fullmatch(text):
        number = int(numbered[1] or numbered[2] or numbered[3])
        return CELLS[number] if number < len(CELLS) else None
    return _FOLDED.get(text.casefold())


def cell_name(text: str) -> str:
    """The macro name of the cell that a text names; a text that names none of the sixteen stays as it is."""
    found = cell(text)
    return found.name if found else text


def plain(value: float) -> Number:
    """A number as people write it: controllers store 6 as 6.0."""
    return int(value) if isinstance(value, float) and value.is_integer() else value


def decode(data: bytes) -> Sample:
    """One ``vr.Sample`` message. Raises ``DecodeError`` for what is no JSON object.

    Cells may be named by number; names that are none of the sixteen are kept. A cell that has no
    number, or two that differ, is told in ``bad`` and is not among the ``cells``.
    """
    said = _parsed(data)
    if not isinstance(said, _Object):
        raise DecodeError(f"a VR sample is a JSON object, not {_shown(said)}", offset=0)
    cells: dict[str, Number] = {}
    bad: dict[str, BadCell] = {}
    for text, value in said:
        name = cell_name(text)
        fault = _fault(value)
        if not fault and name in cells and cells[name] != value:
            fault = f"both {cells[name]} and {plain(value)}"
        if fault:
            bad.setdefault(name, BadCell(name, fault))
        else:
            cells[name] = plain(value)
    return Sample({name: value for name, value in cells.items() if name not in bad}, (*bad.values(),))


def encode(cells: Mapping[str, Number]) -> bytes:
    """A ``vr.Sample`` message of these cells, in their order."""
    return _WRITTEN(cells).encode()


_WRITTEN = json.JSONEncoder(separators=(",", ":"), allow_nan=False).encode


class _Object(list[tuple[str, Any]]):
    """The pairs of a JSON object, as they stand: a name may stand there twice."""


def _parsed(data: bytes) -> Any:
    try:
        return json.loads(data.decode("utf-8-sig"), object_pairs_hook=_Object, parse_int=_integer)
    except json.JSONDecodeError as error:
        _refuse(f"this is no JSON: {error.msg}", len(error.doc[: error.pos].encode("utf-8", "replace")))
    except UnicodeDecodeError as error:
        _refuse("this is no JSON: it is not UTF-8", error.start)
    except RecursionError:
        _refuse("a VR sample is a JSON object of numbers, not so deep a thing", 0)


def _refuse(cause: str, offset: int) -> NoReturn:
    raise DecodeError(cause, offset=offset) from None


def _integer(digits: str) -> Number:
    """An integer; one too long for any cell becomes a float, infinite beyond 308 digits."""
    return int(digits) if len(digits) < 300 else float(digits)


def _fault(value: Any) -> str:
    """What a value is, if it is no number."""
    if isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value):
        return ""
    return _shown(value)


def _shown(value: Any) -> str:
    if isinstance(value, _Object):
        return "an object"
    if isinstance(value, list):
        return "a list"
    if isinstance(value, str) and len(value) > 40:
        return f"{json.dumps(value[:40])}..."
    return json.dumps(value)
