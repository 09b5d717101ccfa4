"""Expressions with names resolved: nodes about the cells of known names, made once and remembered.

An environment gives parameters their values. What does not depend on the state is decided here: an equality
of names, a parameter, a quantifier's instances that are true anyway.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cache
from typing import Any

from mmsverify.concrete.belief.comparisons import Same, Smaller
from mmsverify.concrete.belief.nodes import (
    Among,
    Choice,
    Conditional,
    Connective,
    Equivalence,
    Every,
    Fixed,
    Formula,
    Not,
    Remember,
)
from mmsverify.concrete.belief.partial import OTHER, Identity, Key, Partial, World
from mmsverify.concrete.belief.slots import CellBeside, CellBits, Constant, Sum, Value
from mmsverify.concrete.belief.values import ABSENT, EITHER, NO, YES, Env, everything, exactly, single
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
    Or,
    Plus,
    Present,
    Quantified,
    Ref,
)  # fmt: skip
from mmsverify.model.sorts import BOOL, ElementSort

TRUE, FALSE, OPEN = Fixed(YES), Fixed(NO), Fixed(EITHER)
_MISSING = object()
LARGEST_MEMO = 200_000


class Ground:
    """Makes the nodes of one world; a new name makes it start anew."""

    def __init__(self, world: World) -> None:
        self.world = world
        self._lasting: dict[Any, Formula] = {}
        self._passing: dict[Any, Formula] = {}

    def forget(self) -> None:
        """Drop what a new name changes: quantifiers have more instances now."""
        self._passing.clear()

    def formula(self, expr: Expr, env: Env) -> Formula:
        """The formula about the names of the environment."""
        key = (expr, tuple([env.get(name, _MISSING) for name in mentioned(expr)]))
        memo = self._passing if quantifies(expr) else self._lasting
        found = memo.get(key)
        if found is None:
            if len(memo) > LARGEST_MEMO:
                memo.clear()
            found = memo[key] = self._formula(expr, env)
        return found

    def _formula(self, expr: Expr, env: Env) -> Formula:
        match expr:
            case Const(literal):
                return TRUE if literal else FALSE
            case Ref(name):
                given = env.get(name, EITHER)
                return FALSE if given is ABSENT else Fixed(given)
            case Cell():
                return self._cell(expr, env)
            case Member(name, inner):
                members = env.get(name)
                return OPEN if members is None else TRUE if element(inner, env) in members else FALSE
            case Present(name):
                return OPEN if name not in env else FALSE if env[name] is ABSENT else TRUE
            case ex.Not(body):
                return negated(self.formula(body, env))
            case And(parts):
                return connected([self.formula(part, env) for part in parts], NO)
            case Or(parts):
                return connected([self.formula(part, env) for part in parts], YES)
            case Eq(left, right):
                return self._equal(left, right, env)
            case Less(left, right):
                low, high = self.value(left, env), self.value(right, env)
                return FALSE if low is None or high is None else _decided(Smaller(low, high), self.world)
            case Quantified():
                return self._quantified(expr, env)
        raise TypeError(f"no truth value: {expr!r}")

    def _cell(self, cell: Cell, env: Env) -> Formula:
        args = tuple([element(arg, env) for arg in cell.args])
        if ABSENT in args:
            return FALSE
        place = self.world.places[cell.variable, args]
        return Among(place.shift, place.full, YES)

    def _equal(self, left: Expr, right: Expr, env: Env) -> Formula:
        if isinstance(left.sort, ElementSort):
            return _same_name(element(left, env), element(right, env))
        if left.sort is BOOL:
            return equivalent(self.formula(left, env), self.formula(right, env))
        if isinstance(left, Ite):
            return self._either(left, right, env)
        if isinstance(right, Ite):
            return self._either(right, left, env)
        one, two = self.value(left, env), self.value(right, env)
        return FALSE if one is None or two is None else equal(one, two, self.world)

    def _either(self, choice: Ite, other: Expr, env: Env) -> Formula:
        condition = self.formula(choice.condition, env)
        then, otherwise = ex.equal(choice.then, other), ex.equal(choice.otherwise, other)
        if isinstance(condition, Fixed) and single(condition.value):
            return self.formula(then if condition.value == YES else otherwise, env)
        first, second = self.formula(then, env), self.formula(otherwise, env)
        if isinstance(first, Fixed) and isinstance(second, Fixed) and first.value == second.value:
            return first
        return Choice(condition, first, second)

    def _quantified(self, expr: Quantified, env: Env) -> Formula:
        decided, other = (NO, YES) if expr.universal else (YES, NO)
        known: list[Formula] = []
        unseen: list[tuple[Formula, Remember]] = []
        names = tuple(ref.name for ref in expr.bound)
        for combination in self.world.combinations([ref.of for ref in expr.bound]):
            inner = {**env, **dict(zip(names, combination, strict=True))}
            part = self.formula(expr.body, inner)
            if isinstance(part, Fixed) and part.value == other:
                continue
            if OTHER in combination:
                unseen.append((part, self._remember(expr, inner)))
            elif isinstance(part, Fixed) and part.value == decided:
                return part
            else:
                known.append(part)
        return Every(expr.universal, known, unseen) if known or unseen else Fixed(other)

    def _remember(self, expr: Quantified, env: Env) -> Remember:
        """A formula that is left open for unseen names is kept for when they are seen."""
        mentions = (*(ref.name for ref in expr.bound), *mentioned(expr.body))
        given = frozenset((name, env[name]) for name in mentions if name in env)
        bound = tuple((ref.name, ref.of.name) for ref in expr.bound)

        def remember(state: Partial, want: bool) -> Partial:
            return state.put(self.fact((expr.body, want, given, bound)), YES)

        return remember

    def fact(self, identity: Identity) -> Key:
        """The key of a fact about unseen names; it is made where there is none yet."""
        body = identity[0]
        return self.world.fact(identity, lambda at: self.formula(body, at), ex.variables_of(body))

    def value(self, expr: Expr, env: Env) -> Value | None:
        """The value; ``None`` where it rests on a parameter that is not given."""
        match expr:
            case Const(literal):
                return Constant(exactly(literal))
            case Ref(name, sort) if sort is not BOOL:
                given = env.get(name)
                if given is ABSENT:
                    return None
                return CellBeside(("$" + name, ()), everything(sort), 0) if given is None else Constant(given)
            case Cell() if expr.of is not BOOL:
                return self._cell_value(expr, env)
            case Ite(condition, then, otherwise):
                return self._conditional(self.formula(condition, env), then, otherwise, env)
            case Plus(left, right, factor):
                one, two = self.value(left, env), self.value(right, env)
                return None if one is None or two is None else Sum(one, two, factor)
        return self.formula(expr, env)

    def _cell_value(self, cell: Cell, env: Env) -> Value | None:
        args = tuple([element(arg, env) for arg in cell.args])
        if ABSENT in args:
            return None
        key = (cell.variable, args)
        place = self.world.places.get(key)
        if place is not None:
            return CellBits(place)
        return CellBeside(key, self.world.full[cell.variable], self.world.spots[key])

    def _conditional(self, condition: Formula, then: Expr, otherwise: Expr, env: Env) -> Value:
        first, second = self.value(then, env), self.value(otherwise, env)
        one = Constant(everything(then.sort)) if first is None else first
        two = Constant(everything(otherwise.sort)) if second is None else second
        if isinstance(condition, Fixed) and single(condition.value):
            return one if condition.value == YES else two
        return Conditional(condition, one, two)


def element(expr: Expr, env: Env) -> Any:
    """The name that an element expression stands for, or ``ABSENT``."""
    assert isinstance(expr, Ref)
    return env.get(expr.name, ABSENT)


@cache
def mentioned(expr: Expr) -> tuple[str, ...]:
    """Names of the parameters that an expression mentions."""
    found = set(ex.refs_of(expr))
    for node in ex.walk(expr):
        if isinstance(node, Member):
            found.add(node.set)
        elif isinstance(node, Present):
            found.add(node.name)
    return tuple(sorted(found))


@cache
def quantifies(expr: Expr) -> bool:
    """Whether it speaks of all names, or of some."""
    return any(isinstance(node, Quantified) for node in ex.walk(expr))


def _same_name(left: Any, right: Any) -> Formula:
    """Two unseen names may or may not be one; an absent parameter is no name."""
    if left == right:
        return FALSE if left is ABSENT else OPEN if left == OTHER else TRUE
    return FALSE


def negated(body: Formula) -> Formula:
    """The negation, without a node where there need be none."""
    if isinstance(body, Fixed):
        return Fixed(body.value if body.value == EITHER else NO + YES - body.value)
    if isinstance(body, Among):
        return Among(body.shift, body.full, body.full & ~body.good)
    return body.body if isinstance(body, Not) else Not(body)


def connected(parts: Sequence[Formula], deciding: int) -> Formula:
    """The conjunction, or (``deciding`` is ``YES``) the disjunction, without what is decided."""
    left: dict[Any, Formula] = {}
    for part in _flat(parts, deciding):
        if isinstance(part, Fixed):
            if part.value == deciding:
                return part
            if part.value == EITHER:
                left[EITHER] = part
            continue
        key: Any = ("cell", part.shift) if isinstance(part, Among) else id(part)
        before = left.get(key)
        if isinstance(part, Among) and isinstance(before, Among):
            good = before.good & part.good if deciding == NO else before.good | part.good
            if good in (0, part.full):
                decided = Fixed(YES if good else NO)
                if decided.value == deciding:
                    return decided
                del left[key]
                continue
            part = Among(part.shift, part.full, good)
        left[key] = part
    if not left:
        return Fixed(NO + YES - deciding)
    return next(iter(left.values())) if len(left) == 1 else Connective(list(left.values()), deciding)


def _flat(parts: Sequence[Formula], deciding: int) -> Iterator[Formula]:
    for part in parts:
        if isinstance(part, Connective) and part.deciding == deciding:
            yield from part.parts
        else:
            yield part


def equivalent(left: Formula, right: Formula) -> Formula:
    """Both have one truth value; a side that is decided needs no node."""
    for known, other in ((left, right), (right, left)):
        if isinstance(known, Fixed) and known.value != EITHER:
            return other if known.value == YES else negated(other)
    return Equivalence(left, right)


def equal(left: Value, right: Value, world: World) -> Formula:
    """The two values are equal; a cell that is compared with one value needs no more than its bits."""
    for slot, other in ((left, right), (right, left)):
        if isinstance(slot, CellBits) and isinstance(other, Constant) and single(other.value):
            assert isinstance(other.value, int)
            return Among(slot.shift, slot.full, other.value)
    return _decided(Same(left, right), world)


def _decided(formula: Same | Smaller, world: World) -> Formula:
    """The formula, or its truth value where it does not depend on the state."""
    if isinstance(formula.left, Constant) and isinstance(formula.right, Constant):
        return Fixed(formula.holds(world.blank()))
    return formula
