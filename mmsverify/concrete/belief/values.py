"""What is known of one value: a set of truth values or of enumeration members, or an interval of integers.

Truth values are bit masks (``NO``, ``YES``, ``EITHER``), so that the hot path stays cheap. Every operation
errs to the larger set: what is not known stays possible.
"""

from __future__ import annotations

from typing import Any

from mmsverify.model.sorts import BoolSort, EnumSort, IntSort, Sort

NO, YES, EITHER = 1, 2, 3

Interval = tuple[int | None, int | None]
Known = int | frozenset[Any] | Interval
"""A mask, a set of members, or an interval whose open ends are ``None``."""


def everything(sort: Sort) -> Known:
    """All values of a sort."""
    match sort:
        case BoolSort():
            return EITHER
        case EnumSort(members=members):
            return frozenset(members)
        case IntSort(low=low, high=high):
            return (low, high)
    raise TypeError(f"{sort} has no values of its own")


def exactly(value: Any) -> Known:
    """The one value."""
    if isinstance(value, bool):
        return YES if value else NO
    return (value, value) if isinstance(value, int) else frozenset([value])


def meet(left: Known, right: Known) -> Known | None:
    """What both allow; ``None`` if nothing."""
    if isinstance(left, int) and isinstance(right, int):
        return left & right or None
    if isinstance(left, frozenset) and isinstance(right, frozenset):
        return left & right or None
    assert isinstance(left, tuple)
    assert isinstance(right, tuple)
    low, high = _higher(left[0], right[0]), _lower(left[1], right[1])
    return None if low is not None and high is not None and low > high else (low, high)


def join(left: Known, right: Known) -> Known:
    """What either allows (of intervals: the smallest interval around both)."""
    if isinstance(left, int) and isinstance(right, int):
        return left | right
    if isinstance(left, frozenset) and isinstance(right, frozenset):
        return left | right
    assert isinstance(left, tuple)
    assert isinstance(right, tuple)
    low = None if left[0] is None or right[0] is None else min(left[0], right[0])
    high = None if left[1] is None or right[1] is None else max(left[1], right[1])
    return (low, high)


def within(left: Known, right: Known) -> bool:
    """Whether everything that ``left`` allows, ``right`` allows."""
    if isinstance(left, int) and isinstance(right, int):
        return left | right == right
    return join(left, right) == right


def without(known: Known, value: Known) -> Known | None:
    """What remains when the single value ``value`` is excluded; ``None`` if nothing does."""
    if isinstance(known, int) and isinstance(value, int):
        return known & ~value or None
    if isinstance(known, frozenset) and isinstance(value, frozenset):
        return known - value or None
    assert isinstance(known, tuple)
    assert isinstance(value, tuple)
    low, high = known
    if low == value[0] and low is not None:
        low += 1
    if high == value[0] and high is not None:
        high -= 1
    return None if low is not None and high is not None and low > high else (low, high)


def single(known: Known) -> bool:
    """Whether exactly one value is left."""
    if isinstance(known, int):
        return known != EITHER
    return len(known) == 1 if isinstance(known, frozenset) else known[0] is not None and known[0] == known[1]


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


def plain(known: Known) -> list[Any]:
    """The values as results print them, sorted; an open interval has none to list."""
    if isinstance(known, int):
        return [value for mask, value in ((NO, False), (YES, True)) if known & mask]
    if isinstance(known, frozenset):
        return sorted(str(value) for value in known)
    low, high = known
    if low is None or high is None or high - low > 15:
        return []
    return list(range(low, high + 1))


def _higher(left: int | None, right: int | None) -> int | None:
    return right if left is None else left if right is None else max(left, right)


def _lower(left: int | None, right: int | None) -> int | None:
    return right if left is None else left if right is None else min(left, right)
