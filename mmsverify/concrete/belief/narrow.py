"""Assuming that a formula holds (or fails): the partial states that remain; none only where none is possible.

A conjunct narrows cells without a split. A disjunction with one possible part narrows by it; with a few, it
splits in order ("the first that holds is the i-th"), n parts for n alternatives; with many, or where splits
are not wanted, the state is kept as it is, which allows too much but never too little. Of unseen names only
what holds for each of them is assumed.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from mmsverify.concrete.belief.comparison import (
    Narrowing,
    by_cell,
    by_order,
    by_test,
    by_value,
    in_turn,
    is_place,
)  # fmt: skip
from mmsverify.concrete.belief.partial import OTHER, Fact, Partial
from mmsverify.concrete.belief.patterns import at, patterns
from mmsverify.concrete.belief.truth import Env, Truth, truth
from mmsverify.concrete.belief.values import EITHER, NO, YES
from mmsverify.model import expr as ex
from mmsverify.model.expr import And, Cell, Eq, Expr, Ite, Less, Not, Or, Quantified
from mmsverify.model.sorts import BOOL, ElementSort

LARGEST_SPLIT = 6


@cache
def narrowing(expr: Expr, want: bool) -> Narrowing:
    """What remains of a state when ``expr`` is assumed to be ``want``; the third argument allows splits."""
    match expr:
        case Cell():
            return by_cell(expr, want)
        case Not(body):
            return narrowing(body, not want)
        case And(parts) if want:
            return in_turn(tuple(narrowing(part, True) for part in parts))
        case Or(parts) if not want:
            return in_turn(tuple(narrowing(part, False) for part in parts))
        case And(parts) | Or(parts):
            return _first(tuple((truth(p), narrowing(p, want), narrowing(p, not want)) for p in parts), want)
        case Eq(left, right):
            return _equality(left, right, want)
        case Less(left, right):
            return by_order(left, right, want)
        case Quantified(universal):
            return _every(expr, want) if universal == want else _some(expr, want)
    return by_test(expr, want)


def _first(
    parts: tuple[tuple[Callable[[Partial, Env], int], Narrowing, Narrowing], ...], want: bool
) -> Narrowing:
    """A disjunction (of the parts, or of their negations): the alternatives in order."""
    good, bad = (YES, NO) if want else (NO, YES)

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        possible = []
        for holds, take, refuse in parts:
            found = holds(state, env)
            if found == good:
                return [state]
            if found != bad:
                possible.append((take, refuse))
        return alternatives(state, env, split, possible)

    return narrow


def alternatives(
    state: Partial, env: Env, split: bool, possible: list[tuple[Narrowing, Narrowing]]
) -> list[Partial]:
    """The states in which the first, or else the second ..., of several formulas holds."""
    if len(possible) == 1:
        return possible[0][0](state, env, split)
    if not possible:
        return []
    if not split or len(possible) > LARGEST_SPLIT:
        return [state]
    result: list[Partial] = []
    rest = [state]
    for take, refuse in possible:
        result += [after for before in rest for after in take(before, env, split)]
        rest = [after for before in rest for after in refuse(before, env, False)]
    return result


def _equality(left: Expr, right: Expr, want: bool) -> Narrowing:
    if isinstance(left.sort, ElementSort):
        return by_test(Eq(left, right), want)
    if left.sort is BOOL:
        return _equivalence(left, right, want)
    if isinstance(left, Ite):
        return _choice(left, right, want)
    if isinstance(right, Ite):
        return _choice(right, left, want)
    ways = [by_value(a, b, want) for a, b in ((left, right), (right, left)) if is_place(a)]
    return in_turn(tuple(ways)) if ways else by_test(Eq(left, right), want)


def _equivalence(left: Expr, right: Expr, want: bool) -> Narrowing:
    """``left`` and ``right`` have one truth value (or two): if either is decided, so is the other."""
    sides = (
        (truth(left), narrowing(right, True), narrowing(right, False)),
        (truth(right), narrowing(left, True), narrowing(left, False)),
    )

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        for holds, take, refuse in sides:
            found = holds(state, env)
            if found != EITHER:
                return (take if (found == YES) == want else refuse)(state, env, split)
        if not split:
            return [state]
        true = [
            b for a in narrowing(left, True)(state, env, split) for b in narrowing(right, want)(a, env, split)
        ]
        false = [
            b
            for a in narrowing(left, False)(state, env, split)
            for b in narrowing(right, not want)(a, env, split)
        ]
        return true + false

    return narrow


def _choice(choice: Ite, other: Expr, want: bool) -> Narrowing:
    """An if-then-else compared with a value: the branches that may lead there."""
    yes, no = narrowing(choice.condition, True), narrowing(choice.condition, False)
    then, otherwise = (
        narrowing(ex.equal(choice.then, other), want),
        narrowing(ex.equal(choice.otherwise, other), want),
    )
    may_then, may_otherwise = truth(ex.equal(choice.then, other)), truth(ex.equal(choice.otherwise, other))
    wanted = YES if want else NO

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        first = may_then(state, env) & wanted
        second = may_otherwise(state, env) & wanted
        if first and second and not split:
            return [state]
        result: list[Partial] = []
        if first:
            result += [b for a in yes(state, env, split) for b in then(a, env, split)]
        if second:
            result += [b for a in no(state, env, split) for b in otherwise(a, env, split)]
        return result

    return narrow


def _every(expr: Quantified, want: bool) -> Narrowing:
    """For all names: assumed of each known one; of unseen ones only without a split, for they may differ."""
    names, sorts = tuple(ref.name for ref in expr.bound), tuple(ref.of for ref in expr.bound)
    assume = narrowing(expr.body, want)
    holds, wanted = truth(expr.body), YES if want else NO
    cells = tuple(patterns(expr.body))
    bound = tuple(zip(names, (sort.name for sort in sorts), strict=True))

    def remember(state: Partial, env: Env) -> Partial:
        """A formula that is left open for unseen names is kept for when they are seen."""
        given = {name: env[name] for name in (*names, *needed) if name in env}
        key = state.world.fact(
            (id(assume), frozenset(given.items())),
            lambda: Fact(assume, holds, wanted, given, bound, at(cells, given)),
        )
        return state.put(key, YES)

    needed = tuple(
        sorted(set(ex.refs_of(expr.body)) | {n.set for n in ex.walk(expr.body) if isinstance(n, ex.Member)})
    )

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        states = [state]
        for combination in state.world.combinations(sorts):
            inner = {**env, **dict(zip(names, combination, strict=True))}
            unseen = OTHER in combination
            if unseen:
                states = [
                    _of_unseen(before, inner, assume, holds, wanted, remember=remember) for before in states
                ]
            else:
                states = [after for before in states for after in assume(before, inner, split)]
        return states

    return narrow


def _of_unseen(
    state: Partial,
    env: Env,
    assume: Narrowing,
    holds: Truth,
    wanted: int,
    *,
    remember: Callable[[Partial, Env], Partial],
) -> Partial:
    """What holds of every unseen name narrows their common cells.

    Where it leaves them open, it is kept as a fact.
    """
    if holds(state, env) == wanted:
        return state
    narrowed = assume(state, env, False)
    if len(narrowed) != 1:
        return state  # of no unseen name: then there is none, and nothing is known of cells that do not exist
    return narrowed[0] if holds(narrowed[0], env) == wanted else remember(narrowed[0], env)


def _some(expr: Quantified, want: bool) -> Narrowing:
    """For some name: narrowed where only known names come into question."""
    names, sorts = tuple(ref.name for ref in expr.bound), tuple(ref.of for ref in expr.bound)
    holds, take, refuse = truth(expr.body), narrowing(expr.body, want), narrowing(expr.body, not want)
    good, bad = (YES, NO) if want else (NO, YES)

    def narrow(state: Partial, env: Env, split: bool) -> list[Partial]:
        possible: list[tuple[Narrowing, Narrowing]] = []
        open_end = False
        for combination in state.world.combinations(sorts):
            inner = {**env, **dict(zip(names, combination, strict=True))}
            found = holds(state, inner)
            if OTHER in combination:
                open_end = open_end or found != bad
            elif found == good:
                return [state]
            elif found != bad:
                possible.append((_within(take, inner), _within(refuse, inner)))
        return [state] if open_end else alternatives(state, env, split, possible)

    return narrow


def _within(narrow: Narrowing, env: Env) -> Narrowing:
    return lambda state, _env, split: narrow(state, env, split)
