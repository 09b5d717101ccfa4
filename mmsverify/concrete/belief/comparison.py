"""Narrowing by one comparison: a cell, or a free choice, restricted to what the other side allows.

Nothing here looks into connectives or quantifiers; ``narrow`` does, and comes down to these.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal

from mmsverify.concrete.belief.partial import Key, Partial
from mmsverify.concrete.belief.truth import Env, key_of, truth, value
from mmsverify.concrete.belief.values import (
    NO,
    YES,
    Interval,
    Known,
    above,
    below,
    interval,
    meet,
    single,
    without,
)  # fmt: skip
from mmsverify.model.expr import Cell, Eq, Expr, Less, Ref

Narrowing = Callable[[Partial, Env, bool], list[Partial]]
"""What remains of a state when a formula is assumed; the third argument allows splits."""


def by_test(expr: Expr, want: bool) -> Narrowing:
    """Nothing to narrow: the state stays where the formula may have the wanted value."""
    holds, wanted = truth(expr), YES if want else NO

    def keep(state: Partial, env: Env, _split: bool) -> list[Partial]:
        return [state] if holds(state, env) & wanted else []

    return keep


def by_cell(cell: Cell, want: bool) -> Narrowing:
    """A truth value: the cell narrowed to the wanted one. At an absent name nothing holds."""
    key, mask = key_of(cell), YES if want else NO

    def narrow(state: Partial, env: Env, _split: bool) -> list[Partial]:
        where = key(env)
        if where is None:
            return [] if want else [state]
        left = state.narrowed(where, mask)
        return [] if left is None else [left]

    return narrow


def in_turn(parts: tuple[Narrowing, ...]) -> Narrowing:
    """All of the narrowings, each of what the one before it has left."""

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        states = [state]
        for part in parts:
            states = [after for before in states for after in part(before, env, split)]
            if not states:
                break
        return states

    return narrow


def is_place(expr: Expr) -> bool:
    """Whether the expression is a cell or a parameter: something of which more can be known."""
    return isinstance(expr, Cell | Ref)


def by_value(place: Expr, other: Expr, want: bool) -> Narrowing:
    """Narrow a cell or a free choice to the values that the other side may have, or away from its one."""
    known, key = value(other), _place_key(place)
    holds = truth(Eq(place, other))
    now = value(place)

    def narrow(state: Partial, env: Env, _split: bool) -> list[Partial]:
        where = key(env)
        if where is None:
            return [state] if holds(state, env) & (YES if want else NO) else []
        theirs = known(state, env)
        if want:
            return _restricted(state, where, now(state, env), theirs)
        if not single(theirs):
            return [state]
        left = without(now(state, env), theirs)
        return [] if left is None else [state.put(where, left)]

    return narrow


def _restricted(state: Partial, where: Key, now: Known, theirs: Known) -> list[Partial]:
    left = meet(now, theirs)
    if left is None:
        return []
    return [state] if left == now else [state.put(where, left)]


def _place_key(place: Expr) -> Callable[[Env], Key | None]:
    """The key of a cell; of a parameter that no event shows, that of what is found out about it."""
    if isinstance(place, Cell):
        return key_of(place)
    assert isinstance(place, Ref)
    name, key = place.name, ("$" + place.name, ())
    return lambda env: None if name in env else key


def by_order(left: Expr, right: Expr, want: bool) -> Narrowing:
    """``left < right`` (or its contrary): narrows either side by the other's bound."""
    steps: list[Narrowing] = [by_test(Less(left, right), want)]
    if is_place(left):
        steps.append(_bounded(left, right, 1 if want else 0, below if want else _from))
    if is_place(right):
        steps.append(_bounded(right, left, 0 if want else 1, above if want else _up_to))
    return in_turn(tuple(steps))


def _from(known: Interval, limit: int | None) -> Interval | None:
    return above(known, None if limit is None else limit - 1)


def _up_to(known: Interval, limit: int | None) -> Interval | None:
    return below(known, None if limit is None else limit + 1)


def _bounded(
    place: Expr, other: Expr, end: Literal[0, 1], cut: Callable[[Interval, int | None], Interval | None]
) -> Narrowing:
    """The place cut at one end (0 the lower, 1 the upper) of what the other side may be."""
    key, now, theirs = _place_key(place), value(place), value(other)

    def narrow(state: Partial, env: Env, _split: bool) -> list[Partial]:
        where = key(env)
        if where is None:
            return [state]
        before = interval(now(state, env))
        left = cut(before, interval(theirs(state, env))[end])
        return [] if left is None else [state if left == before else state.put(where, left)]

    return narrow
