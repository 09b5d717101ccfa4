"""What a key of a profile is: its default, what it allows, the statements that leave it to the implementer."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

Entries = Mapping[str, "Key"]


@dataclass(frozen=True, slots=True)
class Key:
    """One key of a table. ``says`` is its meaning in one sentence, ``clauses`` the statements it rests on.

    ``entries``: the value is a list of tables with these keys; ``table``: it is one table with them. ``known``
    are the words to choose from, where there are such.
    """

    default: Any
    allows: str
    fits: Callable[[Any], bool]
    says: str = ""
    clauses: tuple[str, ...] = ()
    entries: Entries = field(default_factory=dict)
    table: bool = False
    known: tuple[str, ...] = ()


def choice(*words: str, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """One of some words, the first where nothing is said."""
    allows = "one of " + ", ".join(f'"{w}"' for w in words)
    return Key(words[0], allows, lambda v: isinstance(v, str) and v in words, says, clauses, known=words)


def choices(
    default: list[str],
    words: tuple[str, ...],
    *,
    allows: str = "",
    says: str,
    clauses: tuple[str, ...] = (),
) -> Key:
    """A list of some words; ``allows`` says which where they are too many to tell."""
    allows = allows or "a list of " + ", ".join(f'"{w}"' for w in words)
    return Key(default, allows, lambda v: is_names(v) and set(v) <= set(words), says, clauses, known=words)


def flag(default: bool, *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """True or false."""
    return Key(default, "true or false", lambda v: isinstance(v, bool), says, clauses)


def text(default: str, *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """Any string."""
    return Key(default, "a string", lambda v: isinstance(v, str), says, clauses)


def name(*, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """A name, which cannot be left out."""
    return Key(None, "a name", lambda v: isinstance(v, str) and v != "", says, clauses)


def names(default: list[str], *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """A list of names."""
    return Key(default, "a list of names", is_names, says, clauses)


def number(default: int, least: int, *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """An integer that is not less than ``least``."""
    return Key(default, f"an integer from {least}", lambda v: is_int(v) and v >= least, says, clauses)


def integer(default: int, *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """Any integer."""
    return Key(default, "an integer", is_int, says, clauses)


def span(low: int, high: int, most: int, *, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """The first and the last of a range of ``most`` numbers or fewer."""
    allows = f"two integers [first, last], of {most} numbers at most"
    return Key([low, high], allows, lambda v: _is_span(v) and v[1] - v[0] < most, says, clauses)


def numbers(*, says: str = "", clauses: tuple[str, ...] = ()) -> Key:
    """A list of integers."""
    return Key([], "a list of signal numbers", is_numbers, says, clauses)


def tables(
    default: list[dict[str, Any]], entries: Entries, *, says: str, clauses: tuple[str, ...] = ()
) -> Key:
    """A list of tables."""
    allows = f"a list of tables {{{', '.join(entries)}}}"
    return Key(default, allows, lambda v: isinstance(v, list), says, clauses, entries)


def table(entries: Entries, *, says: str, clauses: tuple[str, ...] = ()) -> Key:
    """One table inside the table."""
    allows = f"a table {{{', '.join(entries)}}}"
    default = {key: entry.default for key, entry in entries.items()}
    return Key(default, allows, lambda v: isinstance(v, Mapping), says, clauses, entries, table=True)


def is_int(value: Any) -> bool:
    """Whether it is an integer; ``true`` is none."""
    return isinstance(value, int) and not isinstance(value, bool)


def is_numbers(value: Any) -> bool:
    """Whether it is a list of integers."""
    return isinstance(value, list) and all(map(is_int, value))


def is_names(value: Any) -> bool:
    """Whether it is a list of strings that are not empty."""
    return isinstance(value, list) and all(isinstance(v, str) and v for v in value)


def _is_span(value: Any) -> bool:
    return is_numbers(value) and len(value) == 2 and bool(value[0] <= value[1])
