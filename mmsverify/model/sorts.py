"""The sorts of the language: what a variable may hold and what a quantifier ranges over.

Only descriptions live here, no values of a run and no solver objects.
"""

from __future__ import annotations

import enum
from dataclasses import dataclass


class Enumeration(enum.Enum):
    """A finite set of named values; the value of a member is the word that the standard prints.

    >>> class Control(Enumeration):
    ...     NORMAL = "NORMAL"
    ...     CONTROLLING = "CONTROLLING"
    """

    def __str__(self) -> str:
        return str(self.value)


@dataclass(frozen=True, slots=True)
class Sort:
    """A set of values, named for error messages."""

    name: str

    def __str__(self) -> str:
        return self.name


@dataclass(frozen=True, slots=True)
class BoolSort(Sort):
    """The truth values."""


@dataclass(frozen=True, slots=True)
class IntSort(Sort):
    """Integers, with optional inclusive bounds; one without needs them only where states are enumerated."""

    low: int | None = None
    high: int | None = None


@dataclass(frozen=True, slots=True)
class EnumSort(Sort):
    """The members of an :class:`Enumeration`."""

    members: tuple[Enumeration, ...] = ()


@dataclass(frozen=True, slots=True)
class ElementSort(Sort):
    """Names of things of one kind, any number of them (``Each``); which exist is for a variable to say."""

    short: str = ""


BOOL = BoolSort("Boolean")


def integer(low: int | None = None, high: int | None = None) -> IntSort:
    """The integers from ``low`` to ``high`` inclusive; a missing bound is no bound."""
    if low is None and high is None:
        return IntSort("integer")
    left = "" if low is None else low
    right = "" if high is None else high
    return IntSort(f"integer {left}..{right}", low, high)


def enumeration(members: type[Enumeration]) -> EnumSort:
    """The sort of an :class:`Enumeration` class."""
    return EnumSort(members.__name__, tuple(members))


def same_kind(left: Sort, right: Sort) -> bool:
    """Whether values of the two sorts can be compared: integers of any bounds can."""
    if isinstance(left, IntSort):
        return isinstance(right, IntSort)
    return left == right
