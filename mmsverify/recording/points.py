"""What to poll: a map of VR cells and signals to the addresses of a Modbus server, in TOML.

Addresses are those of the PDU, from 0.
"""

from __future__ import annotations

import math
import struct
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mmsverify.errors import InputError
from mmsverify.formats.modbus import MOST, Function
from mmsverify.formats.vr import CELLS, Number, cell, plain

TABLES = {
    "coil": Function.READ_COILS,
    "discrete": Function.READ_DISCRETE_INPUTS,
    "holding": Function.READ_HOLDING_REGISTERS,
    "input": Function.READ_INPUT_REGISTERS,
}
"""The four tables of a server, and how each is read."""
TYPES = {"uint16": "H", "int16": "h", "uint32": "I", "int32": "i", "float32": "f"}
"""What registers may hold, as ``struct`` writes it; 32 bits stand in two registers."""
_KEYS = {"controller", "unit", "period", "timeout", "vr", "signals"}
_POINT = 'write it like {holding = 0, type = "int16"} or {coil = 7}'
_LARGEST = 1 << 16


@dataclass(frozen=True, slots=True)
class Read:
    """One request: so many points or registers of a table, from an address."""

    table: str
    address: int
    count: int

    @property
    def function(self) -> Function:
        """The function code that asks for them."""
        return TABLES[self.table]

    def __str__(self) -> str:
        last = self.address + self.count - 1
        return f"{self.table} {self.address}" + (f"-{last}" if self.count > 1 else "")


@dataclass(frozen=True, slots=True)
class Point:
    """Where the value of one VR cell stands, and how it is written there."""

    cell: str
    table: str
    address: int
    type: str = "uint16"
    swapped: bool = False  # of two registers the low word comes first

    @property
    def size(self) -> int:
        """How many points or registers it takes."""
        bits = self.table in ("coil", "discrete")
        return 1 if bits else struct.calcsize(f">{TYPES[self.type]}") // 2

    def value(self, words: tuple[int, ...]) -> Number | None:
        """The number that its registers, or its bit, hold; nothing for what is no finite number."""
        if self.table in ("coil", "discrete"):
            return words[0]
        octets = struct.pack(f">{len(words)}H", *(reversed(words) if self.swapped else words))
        value: Number = struct.unpack(f">{TYPES[self.type]}", octets)[0]
        return plain(value) if math.isfinite(value) else None


@dataclass(frozen=True, slots=True)
class PollMap:
    """What to poll, whose it is, and how often: ``period`` and ``timeout`` in seconds."""

    points: tuple[Point, ...]
    signals: tuple[Read, ...]
    controller: str = ""
    unit: int = 1
    period: float = 0.1
    timeout: float = 1.0

    def reads(self) -> tuple[Read, ...]:
        """The fewest requests that bring all VR cells; no address is read that no cell needs."""
        return tuple(read for table in TABLES for read in _merged(table, self.points))


def read_map(path: str | Path) -> PollMap:
    """A map in TOML. Raises ``InputError`` with the place, the cause and the cure.

    ``[vr]`` names cells (``C_RunMD``, ``VR(0)``), each with its place; ``[signals]`` lists for each table the
    first and the last address to read.
    """
    try:
        given = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:  # TOML and UTF-8 errors are ValueErrors
        raise InputError(getattr(error, "strerror", None) or str(error), place=str(path)) from None
    try:
        return _poll_map(given)
    except InputError as error:
        raise InputError(error.cause, place=f"{path} {error.place}".strip(), cure=error.cure) from None


def _poll_map(given: Mapping[str, Any]) -> PollMap:
    for key in given:
        if key not in _KEYS:
            raise InputError(f"unknown key {key}", cure=f"known are {', '.join(sorted(_KEYS))}")
    points = tuple(_point(*pair) for pair in _table(given, "vr").items())
    cells = [point.cell for point in points]
    if twice := next((name for name in cells if cells.count(name) > 1), ""):
        raise InputError(f"{twice} stands there twice", place="[vr]", cure="leave out one")
    signals = tuple(read for pair in _table(given, "signals").items() for read in _ranges(*pair))
    if not points and not signals:
        raise InputError("nothing to poll", cure="name cells in [vr], or addresses in [signals]")
    controller = given.get("controller", "")
    if not isinstance(controller, str) or "/" in controller:
        raise InputError(f"controller = {controller!r} is no name", cure="give a text without /")
    unit = _whole(given.get("unit", 1), "unit", 255)
    return PollMap(
        points, signals, controller, unit, _seconds(given, "period", 0.1), _seconds(given, "timeout", 1.0)
    )


def _table(given: Mapping[str, Any], name: str) -> Mapping[str, Any]:
    table = given.get(name, {})
    if not isinstance(table, Mapping):
        raise InputError(f"{name} is not a table", cure=f"write [{name}]")
    return table


def _point(name: str, place: Any) -> Point:
    where = f"[vr] {name}"
    found = cell(name)
    if found is None:
        cure = f"the cells are {', '.join(each.name for each in CELLS)}"
        raise InputError("no VR cell", place=where, cure=cure)
    if not isinstance(place, Mapping) or sum(table in place for table in TABLES) != 1:
        raise InputError(f"{place!r} is no place of a value", place=where, cure=_POINT)
    table = next(table for table in TABLES if table in place)
    bits = table in ("coil", "discrete")
    if odd := next((key for key in place if key not in {table, *(() if bits else ("type", "words"))}), ""):
        raise InputError(f"unknown key {odd}", place=where, cure=_POINT)
    kind, words = place.get("type", "uint16"), place.get("words", "big")
    if not isinstance(kind, str) or kind not in TYPES:
        raise InputError(f"no type {kind!r}", place=where, cure=f"one of {', '.join(TYPES)}")
    if words not in ("big", "little"):
        raise InputError(f"words = {words!r} is no order", place=where, cure='"big" or "little"')
    point = Point(found.name, table, _whole(place[table], where, _LARGEST - 1), kind, words == "little")
    if point.address + point.size > _LARGEST:
        raise InputError("its last register would be 65536", place=where, cure="give a lower address")
    return point


def _ranges(table: str, given: Any) -> Iterator[Read]:
    where = f"[signals] {table}"
    if table not in TABLES:
        raise InputError("no such table", place=where, cure=f"one of {', '.join(TABLES)}")
    pairs = given if isinstance(given, list) and given and isinstance(given[0], list) else [given]
    for pair in pairs:
        if not isinstance(pair, list) or len(pair) != 2:
            raise InputError(f"{pair!r} is no range", place=where, cure="give [first, last], one or more")
        first, last = (_whole(bound, where, _LARGEST - 1) for bound in pair)
        if last < first:
            raise InputError(f"{first} to {last} is empty", place=where, cure="give the lower address first")
        yield from _split(table, first, last - first + 1)


def _split(table: str, address: int, count: int) -> Iterator[Read]:
    most = MOST[TABLES[table]]
    for begin in range(address, address + count, most):
        yield Read(table, begin, min(most, address + count - begin))


def _merged(table: str, points: Iterable[Point]) -> Iterator[Read]:
    most = MOST[TABLES[table]]
    begin, end = 0, 0
    for point in sorted((p for p in points if p.table == table), key=lambda p: (p.address, p.size)):
        joined = max(end, point.address + point.size)
        if end and point.address <= end and joined - begin <= most:
            end = joined
            continue
        if end:
            yield Read(table, begin, end - begin)
        begin, end = point.address, point.address + point.size
    if end:
        yield Read(table, begin, end - begin)


def _whole(value: Any, where: str, most: int) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or not 0 <= value <= most:
        raise InputError(f"{value!r} is not allowed", place=where, cure=f"a whole number from 0 to {most}")
    return value


def _seconds(given: Mapping[str, Any], name: str, usual: float) -> float:
    value = given.get(name, usual)
    if isinstance(value, bool) or not isinstance(value, int | float) or not 0.001 <= value <= 3600:
        raise InputError(f"{name} = {value!r} is not allowed", cure="seconds, from 0.001 to 3600")
    return float(value)
