"""VR samples out of tables that oscilloscopes and operator panels export: one row, one sample.

What does not look like a sample is refused with its line: a value that is guessed would be blamed on the
machine later.
"""

from __future__ import annotations

import csv
import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path
from typing import Literal

from mmsverify.errors import InputError
from mmsverify.formats.csv_layout import LOOKED_AT, Asked, Layout, is_comment, layout_of
from mmsverify.formats.csv_text import LONGEST, opened
from mmsverify.formats.csv_values import is_time_of_day, nanoseconds, number
from mmsverify.formats.vr import Number

SUFFIXES = (".csv", ".tsv", ".txt")

_LATEST = (1 << 64) - 1  # ns, what a trace can hold
_DATE_CURE = "write dates as 2026-01-31 or 31.01.2026"
_GAP_CURE = "write a number, or nothing where nothing was measured"


@dataclass(frozen=True, slots=True)
class Tables:
    """How VR samples stand in tables, and whose they are: ``controller``, else the file's name."""

    asked: Asked = field(default_factory=Asked)
    controller: str = ""
    sampling: Literal["scan", "polled"] = "polled"


@dataclass(frozen=True, slots=True)
class CsvSample:
    """One row: its line in the file, the time in ns, the cells that it has a value for."""

    line: int
    time: int
    cells: dict[str, Number]


def is_csv(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a table by its name."""
    return Path(path).suffix.lower() in SUFFIXES


class CsvSamples:
    """The samples of one table, in order of time. Only the line at hand is held.

    Times below zero, as an oscilloscope has before its trigger, are moved so that the first is zero. Raises
    ``InputError`` with file and line for what cannot be read. ``remarks`` tell how the columns are read, once
    the iteration has begun.
    """

    def __init__(self, path: str | os.PathLike[str], asked: Asked) -> None:
        self.path = os.fspath(path)
        self.asked = asked
        self.remarks: tuple[str, ...] = ()

    def __iter__(self) -> Iterator[CsvSample]:
        with opened(self.path) as lines:
            begin = list(_begin(lines))
        if not any(line.strip() for line in begin):
            raise InputError("is empty", place=self.path)
        layout = layout_of(begin, self.asked, self.path)
        self.remarks = tuple(layout.remarks())
        with opened(self.path) as lines:
            skipped = layout.first_line - 1
            yield from self._samples(layout, islice(lines, skipped, None), skipped)

    def _samples(self, layout: Layout, lines: Iterator[str], skipped: int) -> Iterator[CsvSample]:
        shift, last = 0, None
        for line, row in self._rows(layout, lines, skipped):
            time = self._time(layout, row, line)
            if last is None:  # the first row
                shift = max(-time, 0)
            elif time < last:
                cure = "sort the rows by time"
                raise self._error(line, f"{layout.column(layout.time)}: the time goes backwards", cure)
            last = time
            if time + shift > _LATEST:
                raise self._error(
                    line, f"{layout.column(layout.time)}: the time is out of range", "mend --unit"
                )
            yield CsvSample(line, time + shift, self._cells(layout, row, line))
        if last is None:
            raise InputError(
                "has no rows below its header", place=self.path, cure="export the recording again"
            )

    def _rows(self, layout: Layout, lines: Iterator[str], skipped: int) -> Iterator[tuple[int, list[str]]]:
        """The rows with the line on which each begins; a quoted text may go on over several."""
        reader = csv.reader(lines, delimiter=layout.delimiter, strict=True)
        line = skipped + 1
        try:
            for row in reader:
                if not is_comment(row):
                    yield line, row
                line = skipped + reader.line_num + 1
        except csv.Error as error:
            raise self._error(
                line, f"cannot be split into cells: {error}", "mend its quotation marks"
            ) from None

    def _time(self, layout: Layout, row: Sequence[str], line: int) -> int:
        if len(row) > len(layout.header) > 0 and any(text.strip() for text in row[len(layout.header) :]):
            cure = "decimal commas need another delimiter, such as a semicolon"
            raise self._error(line, f"{len(row)} cells under {len(layout.header)} headers", cure)
        if 0 < len(row) <= layout.last:
            cure = "it was cut off: complete or delete it"
            raise self._error(line, f"{len(row)} cells, and {layout.column(layout.last)} is missing", cure)
        text = _at(row, layout.time)
        within: int | None = 0
        if is_time_of_day(text):
            text = f"{_at(row, layout.date)} {text}".strip()
            within = nanoseconds(_at(row, layout.milliseconds) or "0", "ms")
        time = nanoseconds(text, layout.unit)
        if time is None or within is None:
            cause = f"{layout.column(layout.time)}: {_told(text)} is no time"
            raise self._error(line, cause, _DATE_CURE if ":" in text else "mend or delete the line")
        return time + within

    def _cells(self, layout: Layout, row: Sequence[str], line: int) -> dict[str, Number]:
        cells: dict[str, Number] = {}
        for at, name in layout.cells:
            if at >= len(row) or not row[at].strip():
                continue
            value = number(row[at])
            if value is None:
                raise self._error(line, f"{layout.column(at)}: {_told(row[at])} is no number", _GAP_CURE)
            cells[name] = value
        return cells

    def _error(self, line: int, cause: str, cure: str) -> InputError:
        return InputError(cause, place=f"{self.path}:{line}", cure=cure)


def _begin(lines: Iterator[str]) -> Iterator[str]:
    """The lines that are looked at for the layout: so many, and so many characters."""
    taken = 0
    for line in islice(lines, LOOKED_AT):
        yield line
        taken += len(line)
        if taken > LONGEST:
            return


def _at(row: Sequence[str], column: int | None) -> str:
    return row[column].strip() if column is not None and column < len(row) else ""


def _told(text: str) -> str:
    return repr(text if len(text) <= 40 else f"{text[:40]}...") if text.strip() else "an empty cell"
