"""How an exported table is laid out: its delimiter, its header, its first row, which column is what.

Oscilloscopes write lines about themselves before the header, operator panels may write no header at all.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from mmsverify.errors import InputError
from mmsverify.formats.csv_values import nanoseconds, number, unit_word
from mmsverify.formats.vr import BY_NAME, cell

LOOKED_AT = 500
"""Lines at the begin of a file in which its header, or without one its first row, must stand."""

_DELIMITERS = (",", ";", "\t")
_TIME_NAMES = {
    "time", "times", "timestamp", "time stamp", "time_stamp", "datetime", "date time", "date_time",
    "date/time", "date and time", "t", "second", "seconds", "zeit", "时间", "时间戳", "日期时间",
}  # fmt: skip
_DATE_NAMES = {"date", "datum", "日期"}
_MILLISECOND_NAMES = {"millisecond", "milliseconds", "msec", "毫秒"}
# No white space is matched before a mark or inside brackets: what matches from anywhere takes ever longer.
_WITH_UNIT = re.compile(r"(.*?)(?:[(\[]([^()\[\]]*)[)\]]|(?:[/,]\s*|_|\s)(\w+))", re.DOTALL)
_LONGEST_HEADER = 100  # characters; what is longer names no time and no unit
_COMMENT = re.compile(r"\s*(?:#|%|//)+\s*")

Row = Sequence[str]


@dataclass(frozen=True, slots=True)
class Asked:
    """What the user says of the columns: ``cells`` maps a header or a number from 1 to a cell's macro name.

    ``time`` is the column of the time, by header or number; empty where it is to be found. ``unit`` likewise.
    """

    cells: Mapping[str, str] = field(default_factory=dict)
    time: str = ""
    unit: str = ""


@dataclass(frozen=True, slots=True)
class Layout:
    """How to read the rows: columns count from 0, lines from 1; ``header`` is empty where there is none.

    ``date`` and ``milliseconds`` are columns of their own that operator panels write beside a time of day.
    """

    delimiter: str
    first_line: int
    header: tuple[str, ...]
    time: int
    unit: str
    cells: tuple[tuple[int, str], ...]
    date: int | None = None
    milliseconds: int | None = None

    @property
    def last(self) -> int:
        """The last column that is read: no row may be shorter, in a table whose columns have names."""
        return max(self.time, *(at for at, _ in self.cells)) if self.header else -1

    def remarks(self) -> Iterator[str]:
        """Which column is which cell, and which are not read."""
        yield ", ".join(f"{self.column(at)} is {name}" for at, name in self.cells)
        read = {self.time, self.date, self.milliseconds, *(at for at, _ in self.cells)}
        unread = [self.column(at) for at, name in enumerate(self.header) if at not in read and name]
        if unread:
            yield f"not read: {', '.join(unread)}"

    def column(self, number: int) -> str:
        """A column as a sentence calls it."""
        known = number < len(self.header) and self.header[number]
        return f"column {number + 1} ({self.header[number]})" if known else f"column {number + 1}"


def split(line: str, delimiter: str) -> list[str]:
    """The cells of one line; a line with broken quotes as it stands."""
    try:
        return next(csv.reader([line], delimiter=delimiter), [])
    except csv.Error:
        return line.split(delimiter)


def is_comment(row: Row) -> bool:
    """A line that holds nothing, or only a remark."""
    return not any(text.strip() for text in row) or bool(_COMMENT.match(row[0]))


def layout_of(lines: Sequence[str], asked: Asked, place: str) -> Layout:
    """The layout of a table that begins with ``lines``. Raises ``InputError`` where there is none."""
    rows_by = {mark: [split(line, mark) for line in lines] for mark in _DELIMITERS}
    best = max(_DELIMITERS, key=lambda mark: _quality(rows_by[mark], asked))
    rows = rows_by[best]
    at, header = _header(rows, asked) or _headerless(rows, asked, place)
    width = max(len(row) for row in rows[at:]) if at < len(rows) else 0
    return _Columns(header, max(width, len(header)), asked, place).layout(best, rows, at)


def _headerless(rows: Sequence[Row], asked: Asked, place: str) -> tuple[int, tuple[str, ...]]:
    """Where the rows begin in a table whose columns bear names that say nothing, or none."""
    first = _first_row(rows, asked)
    if first is None:
        cure = "name the columns: --time 1 --map 2=C_RunMD,3=CS_RunSTA"
        raise InputError("has no rows of numbers and no header that names a VR cell", place=place, cure=cure)
    return first, _above(rows[first - 1], rows[first]) if first else ()


def _quality(rows: Sequence[Row], asked: Asked) -> tuple[int, int]:
    """How well a delimiter explains the lines: by the names of the header, then by the rows of numbers."""
    header = max((_score(row, asked) for row in rows), default=0)
    return header, sum(_is_data(row, asked) * len(row) for row in rows)


def _header(rows: Sequence[Row], asked: Asked) -> tuple[int, tuple[str, ...]] | None:
    """Where the rows begin, and the line before, which names the columns.

    It is the one that names most; of several such the first that stands before a number.
    """
    scored = [(_score(row, asked), _leads(rows, at), -at) for at, row in enumerate(rows)]
    score, _, at = max(scored, default=(0, False, 0))
    return (1 - at, _names(rows[-at])) if score else None


def _leads(rows: Sequence[Row], at: int) -> bool:
    """Whether numbers follow a line, after a line of units or at once."""
    below = rows[at + 1 : at + 3]
    if below and any(unit_word(text) for text in below[0]):
        below = below[1:]
    return bool(below) and any(number(text) is not None for text in below[0])


def _score(row: Row, asked: Asked) -> int:
    """How many columns a line names, the time counting less: a remark may begin with that word too."""
    names = _names(row)
    if len(names) < 2:
        return 0
    wanted = {text.casefold() for text in (*asked.cells, asked.time) if text and not text.isdecimal()}
    cells = sum(1 for name in names if cell(name) or name.casefold() in wanted)
    return 2 * cells + any(_time_name(name) for name in names)


def _is_data(row: Row, asked: Asked) -> bool:
    """Whether a line holds two values or more; where the time's column is not known, nothing else."""
    values = [number(text) is not None or nanoseconds(text, "s") is not None for text in row]
    if asked.time.isdecimal():
        return sum(values) > 1 and values[int(asked.time) - 1 : int(asked.time)] == [True]
    return sum(values) > 1 and sum(values) == sum(bool(text.strip()) for text in row)


def _first_row(rows: Sequence[Row], asked: Asked) -> int | None:
    return next((at for at, row in enumerate(rows) if _is_data(row, asked)), None)


def _above(row: Row, first: Row) -> tuple[str, ...]:
    """The line above the first row, if it names columns that nobody knows."""
    names = _names(row)
    return names if len(names) >= len([t for t in first if t.strip()]) else ()


def _names(row: Row) -> tuple[str, ...]:
    names = [text.strip() for text in row]
    if names:
        remark = _COMMENT.match(names[0])
        names[0] = names[0][remark.end() :] if remark else names[0]
    return tuple(names)


def _time_name(text: str) -> bool:
    """Whether a header is that of a time, with or without its unit."""
    parted = _parted(text)
    bare = parted[1] if parted and unit_word(parted[2] or parted[3] or "") else text
    return bare.strip().casefold() in _TIME_NAMES


def _unit_of(header: str) -> str:
    """The unit that a header names, such as ``Time (ms)`` or ``t_us``."""
    parted = _parted(header)
    return unit_word(parted[2] or parted[3] or "") if parted else unit_word(header)


def _parted(header: str) -> re.Match[str] | None:
    return _WITH_UNIT.fullmatch(header) if len(header) <= _LONGEST_HEADER else None


@dataclass(frozen=True, slots=True)
class _Columns:
    """Which column is what: what the user says first, then what the header says."""

    header: tuple[str, ...]
    width: int
    asked: Asked
    place: str

    def layout(self, delimiter: str, rows: Sequence[Row], first: int) -> Layout:
        below = rows[first] if self.header and first < len(rows) else ()
        time = self._time(below)
        named = _unit_of(self.header[time]) if time < len(self.header) else ""
        if time < len(below) and unit_word(below[time]):
            named, first = unit_word(below[time]), first + 1
        cells = self._cells(time)
        date, milliseconds = self._beside(time, _DATE_NAMES), self._beside(time, _MILLISECOND_NAMES)
        unit = self.asked.unit or named or "s"
        return Layout(delimiter, first + 1, self.header, time, unit, cells, date, milliseconds)

    def _beside(self, time: int, names: set[str]) -> int | None:
        """A column that tells another part of the time."""
        return next((at for at, n in enumerate(self.header) if at != time and n.casefold() in names), None)

    def _time(self, below: Row) -> int:
        """The column of the time; it may be the line of units ``below`` the header that shows it."""
        if self.asked.time:
            return self._at(self.asked.time, "--time")
        times = [at for at, name in enumerate(self.header) if _time_name(name)]
        times = times or [at for at, text in enumerate(below) if unit_word(text)]
        if not times:
            self._refuse("no column is that of the time", f"say which with --time; {self._listed()}")
        return times[0]

    def _cells(self, time: int) -> tuple[tuple[int, str], ...]:
        chosen: dict[int, str] = {}
        for column, name in self.asked.cells.items():
            at = self._at(column, "--map")
            if at in chosen:
                self._refuse(f"column {at + 1} is {chosen[at]} and {name}", "leave one out of --map")
            chosen[at] = name
        if time in chosen:
            self._refuse(
                f"column {time + 1} is that of the time and of {chosen[time]}", "mend --time or --map"
            )
        for at, name in self._named(time):
            if at in chosen or name in self.asked.cells.values():
                continue
            if name in chosen.values():
                self._refuse(f"more than one column is {name}", f"say which with --map {at + 1}={name}")
            chosen[at] = name
        if not chosen:
            cure = f"say which do with --map 2=C_RunMD,3=CS_RunSTA; {self._listed()}"
            self._refuse("no column names a VR cell", cure)
        return tuple(sorted(chosen.items()))

    def _named(self, time: int) -> Iterator[tuple[int, str]]:
        """The columns whose header names a cell."""
        for at, name in enumerate(self.header):
            if at != time and (found := cell(name)):
                yield at, found.name

    def _at(self, column: str, option: str) -> int:
        """Where a column is: by its header, by another spelling of the cell that it names, by number."""
        for same in (_exactly, _loosely, _same_cell):
            found = [at for at, name in enumerate(self.header) if same(column, name)]
            if len(found) > 1:
                cure = f"say its number with {option}: " + " or ".join(str(at + 1) for at in found)
                self._refuse(f"has {len(found)} columns {column!r}", cure)
            if found:
                return found[0]
        if column.isdecimal() and 0 < int(column) <= self.width:
            return int(column) - 1
        return self._refuse(f"has no column {column!r}", f"mend {option}; {self._listed()}")

    def _listed(self) -> str:
        names = ", ".join(name or "-" for name in self.header[:20])
        return f"its columns: {names}" if names else f"its columns are 1 to {self.width}, without a header"

    def _refuse(self, cause: str, cure: str) -> int:
        raise InputError(cause, place=self.place, cure=cure)


def _exactly(column: str, name: str) -> bool:
    return column == name


def _loosely(column: str, name: str) -> bool:
    return column.strip().casefold() == name.casefold()


def _same_cell(column: str, name: str) -> bool:
    return bool(cell(column)) and cell(column) is cell(name)


def cell_names() -> list[str]:
    """The names that a column may be given."""
    return [known.name for known in BY_NAME.values() if not known.reserved]
