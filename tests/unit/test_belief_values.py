"""What is known of one value: operations allow at least what is true of the members."""

from __future__ import annotations

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from mmsverify.concrete.belief.values import (
    EITHER,
    NO,
    YES,
    Known,
    above,
    below,
    everything,
    exactly,
    join,
    meet,
    plain,
    same,
    single,
    smaller,
    within,
    without,
)
from mmsverify.model import Enumeration
from mmsverify.model.sorts import BOOL, EnumSort, IntSort


class Colour(Enumeration):
    """Three values."""

    RED = "RED"
    GREEN = "GREEN"
    BLUE = "BLUE"


COLOURS = EnumSort("Colour", tuple(Colour))
LOW, HIGH = -4, 4
RANGE = range(LOW - 2, HIGH + 3)

masks = st.integers(1, 7)
ends = st.one_of(st.none(), st.integers(LOW, HIGH))
intervals = st.tuples(ends, ends).filter(lambda i: i[0] is None or i[1] is None or i[0] <= i[1])
pairs = st.one_of([st.tuples(kind, kind) for kind in (masks, intervals)])


def members(known: Known | None) -> set[Any]:
    """The values that it allows; of integers those around zero."""
    if known is None:
        return set()
    if isinstance(known, int):
        return {bit for bit in range(known.bit_length()) if known >> bit & 1}
    low, high = known
    return {n for n in RANGE if (low is None or low <= n) and (high is None or n <= high)}


def truths(mask: int) -> set[bool]:
    """The truth values in a mask."""
    return {value for value, bit in ((False, NO), (True, YES)) if mask & bit}


@given(pairs)
def test_both_allow_what_their_meet_allows(pair: tuple[Known, Known]) -> None:
    assert members(meet(*pair)) == members(pair[0]) & members(pair[1])


@given(pairs)
def test_a_join_allows_what_either_allows(pair: tuple[Known, Known]) -> None:
    assert members(join(*pair)) >= members(pair[0]) | members(pair[1])
    assert within(pair[0], join(*pair))
    assert within(pair[1], join(*pair))


@given(pairs)
def test_within_is_being_a_subset(pair: tuple[Known, Known]) -> None:
    if within(*pair):
        assert members(pair[0]) <= members(pair[1])


@given(pairs)
def test_two_values_are_the_same_as_far_as_all_choices_say(pair: tuple[Known, Known]) -> None:
    verdicts = {a == b for a in members(pair[0]) for b in members(pair[1])}
    assert verdicts <= truths(same(*pair))


@given(intervals, intervals)
def test_one_number_is_smaller_as_far_as_all_choices_say(left: Any, right: Any) -> None:
    verdicts = {a < b for a in members(left) for b in members(right)}
    assert verdicts <= truths(smaller(left, right))


@given(pairs)
def test_excluding_a_single_value_keeps_all_others(pair: tuple[Known, Known]) -> None:
    known, value = pair
    if single(value):
        assert members(without(known, value)) >= members(known) - members(value)


@given(intervals, st.integers(LOW, HIGH))
def test_bounds_cut_exactly(known: Any, limit: int) -> None:
    assert members(below(known, limit)) == {n for n in members(known) if n < limit}
    assert members(above(known, limit)) == {n for n in members(known) if n > limit}


def test_no_bound_cuts_nothing() -> None:
    assert below((0, 3), None) == above((0, 3), None) == (0, 3)


@pytest.mark.parametrize(
    ("sort", "values"),
    [
        (BOOL, [False, True]),
        (COLOURS, ["BLUE", "GREEN", "RED"]),
        (IntSort("n", 0, 2), [0, 1, 2]),
    ],
)
def test_everything_is_all_values_of_the_sort(sort: Any, values: list[Any]) -> None:
    assert plain(everything(sort), sort) == values


@pytest.mark.parametrize(
    ("value", "sort", "word"),
    [(True, BOOL, True), (False, BOOL, False), (3, IntSort("n"), 3), (Colour.RED, COLOURS, "RED")],
)  # fmt: skip
def test_exactly_one_value_is_single(value: Any, sort: Any, word: Any) -> None:
    assert plain(exactly(value), sort) == [word]
    assert single(exactly(value))


@pytest.mark.parametrize(
    ("known", "sort", "listed"),
    [(EITHER, BOOL, [False, True]), (YES, BOOL, [True]), (0b101, COLOURS, ["BLUE", "RED"]),
     ((1, 3), IntSort("n"), [1, 2, 3]), ((1, None), IntSort("n"), []), ((0, 99), IntSort("n"), [])],
)  # fmt: skip
def test_results_list_what_can_be_listed(known: Known, sort: Any, listed: list[Any]) -> None:
    assert plain(known, sort) == listed
