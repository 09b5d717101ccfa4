"""What a partial state says of an expression: the set of values that it may have.

Expressions are compiled once into closures. An environment gives parameters their values: the name of an
element, a known set of values, a set of names (``None``: any set), or ``ABSENT``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any

from mmsverify.concrete.belief.partial import OTHER, Partial
from mmsverify.concrete.belief.values import (
    EITHER,
    NO,
    YES,
    Known,
    everything,
    exactly,
    interval,
    join,
    same,
    smaller,
)  # fmt: skip
from mmsverify.model import expr as ex
from mmsverify.model.expr import (
    And,
    Cell,
    Const,
    Eq,
    Expr,
    Ite,
    Less,
    Member,
    Not,
    Or,
    Plus,
    Present,
    Quantified,
    Ref,
)  # fmt: skip
from mmsverify.model.sorts import BOOL, ElementSort


class Absent:
    """The value of an optional parameter that is not given."""


ABSENT = Absent()
Env = Mapping[str, Any]
Truth = Callable[[Partial, Env], int]
Value = Callable[[Partial, Env], Known]
Name = Callable[[Env], Any]

_FLIP = {NO: YES, YES: NO, EITHER: EITHER}


def element(expr: Expr) -> Name:
    """The name that an element expression stands for, or ``ABSENT``."""
    assert isinstance(expr, Ref)
    name = expr.name
    return lambda env: env.get(name, ABSENT)


@cache
def key_of(cell: Cell) -> Callable[[Env], Any]:
    """The key of a cell in an environment; ``None`` where an argument is absent."""
    variable, names = cell.variable, tuple(arg.name for arg in cell.args if isinstance(arg, Ref))
    if not names:
        fixed = (variable, ())
        return lambda _env: fixed
    if len(names) == 1:
        return partial(_key_of_one, variable, names[0])
    return partial(_key_of_many, variable, names)


def _key_of_one(variable: str, name: str, env: Env) -> Any:
    given = env.get(name, ABSENT)
    return None if given is ABSENT else (variable, (given,))


def _key_of_many(variable: str, names: tuple[str, ...], env: Env) -> Any:
    args = tuple([env.get(name, ABSENT) for name in names])
    return None if ABSENT in args else (variable, args)


@cache
def truth(expr: Expr) -> Truth:
    """Whether a formula holds: ``NO``, ``YES`` or ``EITHER``."""
    match expr:
        case Const(literal):
            mask = YES if literal else NO
            return lambda _state, _env: mask
        case Ref(name):
            return lambda _state, env: env.get(name, EITHER) if not isinstance(env.get(name), Absent) else NO
        case Cell():
            return _cell(expr)
        case Member(name, inner):
            return _member(name, element(inner))
        case Present(name):
            return lambda _state, env: NO if env.get(name, ABSENT) is ABSENT else YES
        case Not(body):
            inside = truth(body)
            return lambda state, env: _FLIP[inside(state, env)]
        case And(parts):
            return _all(tuple(map(truth, parts)))
        case Or(parts):
            return _any(tuple(map(truth, parts)))
        case Eq(left, right):
            return _equal(left, right)
        case Less(left, right):
            low, high = value(left), value(right)
            return lambda state, env: smaller(interval(low(state, env)), interval(high(state, env)))
        case Quantified():
            return _quantified(expr)
    raise TypeError(f"no truth value: {expr!r}")


def _cell(cell: Cell) -> Truth:
    key = key_of(cell)

    def holds(state: Partial, env: Env) -> int:
        where = key(env)
        return NO if where is None else state.get(where)  # type: ignore[return-value]

    return holds


def _member(name: str, inner: Name) -> Truth:
    def holds(_state: Partial, env: Env) -> int:
        members = env.get(name)
        if members is None:
            return EITHER
        return YES if inner(env) in members else NO

    return holds


def _all(parts: tuple[Truth, ...]) -> Truth:
    def holds(state: Partial, env: Env) -> int:
        result = YES
        for part in parts:
            found = part(state, env)
            if found == NO:
                return NO
            if found == EITHER:
                result = EITHER
        return result

    return holds


def _any(parts: tuple[Truth, ...]) -> Truth:
    def holds(state: Partial, env: Env) -> int:
        result = NO
        for part in parts:
            found = part(state, env)
            if found == YES:
                return YES
            if found == EITHER:
                result = EITHER
        return result

    return holds


def _equal(left: Expr, right: Expr) -> Truth:
    if isinstance(left.sort, ElementSort):
        one, two = element(left), element(right)
        return lambda _state, env: _same_name(one(env), two(env))
    if left.sort is BOOL:
        first, second = truth(left), truth(right)
        return lambda state, env: same(first(state, env), second(state, env))
    these, those = value(left), value(right)
    return lambda state, env: same(these(state, env), those(state, env))


def _same_name(left: Any, right: Any) -> int:
    """Two unseen names may or may not be one; an absent parameter is no name."""
    if left == right:
        return NO if left is ABSENT else EITHER if left == OTHER else YES
    return NO


def _quantified(expr: Quantified) -> Truth:
    names, inside = tuple(ref.name for ref in expr.bound), truth(expr.body)
    sorts = tuple(ref.of for ref in expr.bound)
    decided, other = (NO, YES) if expr.universal else (YES, NO)

    def holds(state: Partial, env: Env) -> int:
        result = other
        for combination in state.world.combinations(sorts):
            found = inside(state, {**env, **dict(zip(names, combination, strict=True))})
            # Of unseen names there may be none: they alone make no universal false, no existential true.
            if found == decided and OTHER not in combination:
                return decided
            if found != other:
                result = EITHER
        return result

    return holds


@cache
def value(expr: Expr) -> Value:
    """The values that an expression may have."""
    match expr:
        case Const(literal):
            known = exactly(literal)
            return lambda _state, _env: known
        case Ref(name, sort):
            full = everything(sort)
            return lambda state, env: _parameter(state, env, name, full)
        case Cell():
            key = key_of(expr)
            return lambda state, env: (
                state.world.full[expr.variable] if key(env) is None else state.get(key(env))
            )
        case Ite(condition, then, otherwise):
            return _choice(truth(condition), value(then), value(otherwise))
        case Plus(left, right, factor):
            one, two = value(left), value(right)
            return lambda state, env: _plus(one(state, env), two(state, env), factor)
    if expr.sort is BOOL:
        return truth(expr)
    raise TypeError(f"no value: {expr!r}")


def _parameter(state: Partial, env: Env, name: str, full: Known) -> Known:
    """A parameter that the event shows, or else what the state has found out about the free choice of it."""
    if name in env:
        given = env[name]
        return full if given is ABSENT else given
    return state.cells.get(("$" + name, ()), full)


def _choice(condition: Truth, then: Value, otherwise: Value) -> Value:
    def chosen(state: Partial, env: Env) -> Known:
        holds = condition(state, env)
        if holds == YES:
            return then(state, env)
        if holds == NO:
            return otherwise(state, env)
        return join(then(state, env), otherwise(state, env))

    return chosen


def _plus(left: Known, right: Known, factor: int) -> Known:
    (first, last), (low, high) = interval(left), interval(right)
    if factor < 0:
        low, high = high, low
    return (
        None if first is None or low is None else first + factor * low,
        None if last is None or high is None else last + factor * high,
    )


def names_in(expr: Expr) -> frozenset[str]:
    """Names of the parameters that an expression mentions."""
    return frozenset(ex.refs_of(expr))
