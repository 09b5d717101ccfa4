"""How values read: numbers, instants, names and states as one line of text. No format's layout lives here."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from datetime import UTC, datetime
from enum import Enum
from typing import Any

ONE_OF = "oneOf"


def printable(text: str) -> str:
    """``text`` on one line; control, bidirectional and unpaired surrogate characters are escaped.

    Topics, file names and messages come from recordings; they must not move a terminal's cursor, feign a line
    of the report or break an XML file.
    """
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() else c.encode("unicode_escape").decode("ascii") for c in text)


def instant(time: int) -> str:
    """A capture time in ns since 1970 as UTC in ISO 8601, to the nanosecond."""
    seconds, nanoseconds = divmod(time, 1_000_000_000)
    return f"{datetime.fromtimestamp(seconds, UTC):%Y-%m-%dT%H:%M:%S}.{nanoseconds:09d}Z"


def counted(number: int, noun: str) -> str:
    """``1 error``, ``2 errors``."""
    return f"{number} {noun}" if number == 1 else f"{number} {noun}s"


def seconds(value: float) -> float:
    """A duration as it is reported: to a tenth of a millisecond."""
    return round(value, 4)


def plain(value: Any) -> Any:
    """``value`` in JSON's types, in an order that hashing cannot change; ``oneOf`` values are sorted."""
    if isinstance(value, Enum):
        return value.name
    if isinstance(value, Mapping):
        return {str(key): _alternatives(key, value[key]) for key in sorted(value, key=str)}
    if isinstance(value, set | frozenset):
        return sorted((plain(item) for item in value), key=_rank)
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if value is None or isinstance(value, str | bool | int):
        return value
    return value if isinstance(value, float) and abs(value) < float("inf") else str(value)


def _alternatives(key: Any, value: Any) -> Any:
    return sorted((plain(item) for item in value), key=_rank) if key == ONE_OF else plain(value)


def _rank(item: Any) -> tuple[bool, float, str]:
    """Numbers first, by size; the rest by spelling."""
    if isinstance(item, int | float) and not isinstance(item, bool):
        return False, item, ""
    return True, 0, str(item)


def spoken(value: Any) -> str:
    """``value`` as a reader says it: alternatives joined by ``or``, ``none`` for nothing."""
    value = plain(value)
    if isinstance(value, dict) and set(value) == {ONE_OF}:
        return " or ".join(spoken(item) for item in value[ONE_OF])
    if isinstance(value, dict):
        return "{" + ", ".join(f"{printable(key)}: {spoken(item)}" for key, item in value.items()) + "}"
    if isinstance(value, list):
        return "{" + ", ".join(spoken(item) for item in value) + "}"
    if value is None or value == "":
        return "none"
    return str(value).lower() if isinstance(value, bool) else printable(str(value))


def cells(state: Mapping[str, Any]) -> dict[str, str]:
    """A state as cell to spoken value, sorted; an attribute of several elements is ``attribute[element]``."""
    return dict(sorted(_flat(state)))


def _flat(state: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    for name, value in state.items():
        if isinstance(value, Mapping) and set(value) != {ONE_OF}:
            yield from (
                (f"{printable(name)}[{printable(str(key))}]", spoken(item)) for key, item in value.items()
            )
        else:
            yield printable(name), spoken(value)


def assignments(state: Mapping[str, Any]) -> list[str]:
    """``cell = value`` for each cell of the state, sorted."""
    return [f"{cell} = {value}" for cell, value in cells(state).items()]


def folded(items: Iterable[str], width: int) -> list[str]:
    """``items`` joined by commas into lines of at most ``width`` characters; an item is never broken."""
    lines: list[str] = []
    for item in items:
        if lines and len(lines[-1]) + len(item) + 3 <= width:
            lines[-1] += f", {item}"
        else:
            lines.append(item)
    return [line + "," for line in lines[:-1]] + lines[-1:]


def columns(rows: Sequence[Sequence[str]], *, gap: str = "  ") -> list[str]:
    """``rows`` as lines with aligned columns."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return [
        gap.join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in rows
    ]
