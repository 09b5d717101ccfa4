"""What is known of one value: a set of truth values or of enumeration members, or an interval of integers.

A set is a mask with a bit for each value, in the order of its sort: FALSE before TRUE, members as they are
declared. So the hot path is made of operations on machine words. Every operation errs to the larger set: what
is not known stays possible.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from typing import Any

from mmsverify.model.sorts import BoolSort, Enumeration, EnumSort, IntSort, Sort

NO, YES, EITHER = 1, 2, 3

Interval = tuple[int | None, int | None]
Known = int | Interval
"""A mask, or an interval whose open ends are ``None``."""


class Absent:
    """The value of an optional parameter that is not given: there is one, also where a state is put back."""

    def __reduce__(self) -> str:
        return "ABSENT"


ABSENT = Absent()
Env = Mapping[str, Any]
"""The values of parameters by name.

A value is the name of an element, what is known of it, a set of names (``None``: any set), or ``ABSENT``.
"""


def everything(sort: Sort) -> Known:
    """All values of a sort."""
    match sort:
        case BoolSort():
            return EITHER
        case EnumSort(members=members):
            return sum(map(_bit, members))
        case IntSort(low=low, high=high):
            return (low, high)
    raise TypeError(f"{sort} has no values of its own")


def exactly(value: Any) -> Known:
    """The one value."""
    if isinstance(value, bool):
        return YES if value else NO
    # A number is kept as such, and not as what a message knows of it besides.
    return (int(value), int(value)) if isinstance(value, int) else _bit(value)


@cache
def _bit(member: Enumeration) -> int:
    return 1 << list(type(member)).index(member)


def meet(left: Known, right: Known) -> Known | None:
    """What both allow; ``None`` if nothing."""
    if isinstance(left, int) and isinstance(right, int):
        return left & right or None
    (a, b), (c, d) = interval(left), interval(right)
    low = c if a is None else a if c is None or c < a else c
    high = d if b is None else b if d is None or d > b else d
    return None if low is not None and high is not None and low > high else (low, high)


def join(left: Known, right: Known) -> Known:
    """What either allows (of intervals: the smallest interval around both)."""
    if isinstance(left, int) and isinstance(right, int):
        return left | right
    (a, b), (c, d) = interval(left), interval(right)
    low = None if a is None or c is None else min(a, c)
    high = None if b is None or d is None else max(b, d)
    return (low, high)


def within(left: Known, right: Known) -> bool:
    """Whether everything that ``left`` allows, ``right`` allows."""
    if isinstance(left, int) and isinstance(right, int):
        return left | right == right
    return left == right or join(left, right) == right


def without(known: Known, value: Known) -> Known | None:
    """What remains when the single value ``value`` is excluded; ``None`` if nothing does."""
    if isinstance(known, int) and isinstance(value, int):
        return known & ~value or None
    (low, high), (gone, _) = interval(known), interval(value)
    if low == gone and low is not None:
        low += 1
    if high == gone and high is not None:
        high -= 1
    return None if low is not None and high is not None and low > high else (low, high)


def single(known: Known) -> bool:
    """Whether exactly one value is left."""
    if isinstance(known, int):
        return known & (known - 1) == 0
    return known[0] is not None and known[0] == known[1]


def same(left: Known, right: Known) -> int:
    """Whether two values are equal, as a mask."""
    if meet(left, right) is None:
        return NO
    return YES if left == right and single(left) else EITHER


def smaller(left: Interval, right: Interval) -> int:
    """Whether ``left < right``, as a mask."""
    if left[1] is not None and right[0] is not None and left[1] < right[0]:
        return YES
    return NO if left[0] is not None and right[1] is not None and left[0] >= right[1] else EITHER


def interval(known: Known) -> Interval:
    """What is known of an integer, as the interval that it is."""
    assert isinstance(known, tuple)
    return known


def below(known: Interval, limit: int | None) -> Interval | None:
    """The part of an interval that is less than ``limit``."""
    return known if limit is None else meet(known, (None, limit - 1))  # type: ignore[return-value]


def above(known: Interval, limit: int | None) -> Interval | None:
    """The part of an interval that is greater than ``limit``."""
    return known if limit is None else meet(known, (limit + 1, None))  # type: ignore[return-value]


def plain(known: Known, sort: Sort) -> list[Any]:
    """The values as results print them, sorted; an open interval has none to list."""
    if isinstance(known, tuple):
        low, high = known
        return [] if low is None or high is None or high - low > 15 else list(range(low, high + 1))
    if isinstance(sort, EnumSort):
        return sorted(str(member) for member in sort.members if known & _bit(member))
    return [value for mask, value in ((NO, False), (YES, True)) if known & mask]
