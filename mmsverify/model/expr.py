"""Expressions as data: frozen, structurally equal, picklable. Every reader of a model walks these nodes.

No operator overloading here (that is ``terms``), no rewriting (``rewrite``), no text (``show``), and no
meaning beyond structure (that is each reader's): the nodes, the functions that make them, and what occurs in
them. Conjunctions and disjunctions are flat and keep their order, for replay names the conjunct that failed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from mmsverify.model.sorts import BOOL, ElementSort, Enumeration, EnumSort, IntSort, Sort, integer


class Expr:
    """Any expression; ``sort`` tells what it evaluates to."""

    __slots__ = ("_hash",)
    _hash: int

    @property
    def sort(self) -> Sort:
        """The sort of the value; Boolean unless a node says otherwise."""
        return BOOL


@dataclass(frozen=True, slots=True)
class Const(Expr):
    """A literal: a Boolean, an integer or a member of an enumeration."""

    value: bool | int | Enumeration
    of: Sort = BOOL

    @property
    def sort(self) -> Sort:
        return self.of


@dataclass(frozen=True, slots=True)
class Ref(Expr):
    """A parameter of a row or a bound variable, by name."""

    name: str
    of: Sort

    @property
    def sort(self) -> Sort:
        return self.of


@dataclass(frozen=True, slots=True)
class Cell(Expr):
    """A state variable at its arguments, before the step or (``next``) after it."""

    variable: str
    args: tuple[Expr, ...]
    of: Sort
    next: bool = False

    @property
    def sort(self) -> Sort:
        return self.of


@dataclass(frozen=True, slots=True)
class Member(Expr):
    """Whether an element belongs to a set-valued parameter."""

    set: str
    element: Expr


@dataclass(frozen=True, slots=True)
class Present(Expr):
    """Whether an optional parameter is given."""

    name: str


@dataclass(frozen=True, slots=True)
class Not(Expr):
    """Negation."""

    body: Expr


@dataclass(frozen=True, slots=True)
class And(Expr):
    """Conjunction, in order."""

    parts: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Or(Expr):
    """Disjunction, in order."""

    parts: tuple[Expr, ...]


@dataclass(frozen=True, slots=True)
class Eq(Expr):
    """Equality of two values of one sort (also equivalence of Booleans)."""

    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class Less(Expr):
    """``left < right`` over the integers."""

    left: Expr
    right: Expr


@dataclass(frozen=True, slots=True)
class Plus(Expr):
    """``left + factor * right`` with a literal factor of 1 or -1: counters stay linear."""

    left: Expr
    right: Expr
    factor: int = 1

    @property
    def sort(self) -> Sort:
        return integer()


@dataclass(frozen=True, slots=True)
class Ite(Expr):
    """If-then-else on values."""

    condition: Expr
    then: Expr
    otherwise: Expr

    @property
    def sort(self) -> Sort:
        return self.then.sort


@dataclass(frozen=True, slots=True)
class Quantified(Expr):
    """For all, or for some, elements of the bound variables' sorts."""

    universal: bool
    bound: tuple[Ref, ...]
    body: Expr


@dataclass(frozen=True, slots=True)
class RowFact(Expr):
    """A fact about the row that makes the step, for two-state claims: its answer, service, phase or name."""

    fact: str
    values: tuple[str, ...]


def _hashed_once(structural: Callable[[Any], int]) -> Callable[[Expr], int]:
    """A node's hash, kept in the node: readers look expressions up far more often than they make them."""

    def hashed(node: Expr) -> int:
        try:
            found: int = node._hash
        except AttributeError:
            found = structural(node)
            object.__setattr__(node, "_hash", found)
        return found

    return hashed


for _kind in Expr.__subclasses__():
    setattr(_kind, "__hash__", _hashed_once(_kind.__hash__))  # noqa: B010 - mypy takes no assignment to a method

TRUE = Const(True)
FALSE = Const(False)

BOUND = "°"
"""Ends the name of every bound variable, so that none is ever taken for a parameter of a row."""


def children(expr: Expr) -> tuple[Expr, ...]:
    """The direct parts of a node, in order."""
    match expr:
        case Cell(args=args):
            return args
        case Member(element=element):
            return (element,)
        case Not(body=body) | Quantified(body=body):
            return (body,)
        case And(parts=parts) | Or(parts=parts):
            return parts
        case Eq(left, right) | Less(left, right) | Plus(left, right):
            return (left, right)
        case Ite(condition, then, otherwise):
            return (condition, then, otherwise)
    return ()


def negation(body: Expr) -> Expr:
    """``not body``, without double negation."""
    if isinstance(body, Const):
        return Const(not body.value)
    return body.body if isinstance(body, Not) else Not(body)


def _flat(kind: type[And] | type[Or], parts: tuple[Expr, ...], neutral: Expr, absorbing: Expr) -> Expr:
    kept: dict[Expr, None] = {}
    for part in parts:
        for inner in part.parts if isinstance(part, kind) else (part,):
            if inner == absorbing:
                return absorbing
            if inner != neutral:
                kept.setdefault(inner)
    if not kept:
        return neutral
    return next(iter(kept)) if len(kept) == 1 else kind(tuple(kept))


def conjunction(*parts: Expr) -> Expr:
    """The flat conjunction of the parts, without literals and repetitions."""
    return _flat(And, parts, TRUE, FALSE)


def disjunction(*parts: Expr) -> Expr:
    """The flat disjunction of the parts, without literals and repetitions."""
    return _flat(Or, parts, FALSE, TRUE)


def equal(left: Expr, right: Expr) -> Expr:
    """``left == right``; equality with a truth value is the formula itself or its negation."""
    if left == right:
        return TRUE
    if isinstance(left, Const) and isinstance(right, Const):
        return Const(left.value == right.value)
    if isinstance(left, Const):
        left, right = right, left
    if isinstance(right, Const) and right.sort is BOOL:
        return left if right.value else negation(left)
    return Eq(left, right)


def less(left: Expr, right: Expr) -> Expr:
    """``left < right``, decided where both are literals."""
    if isinstance(left, Const) and isinstance(right, Const):
        return Const(int_value(left) < int_value(right))
    return Less(left, right)


def plus(left: Expr, right: Expr, factor: int = 1) -> Expr:
    """``left + factor * right``, computed where both are literals."""
    if isinstance(left, Const) and isinstance(right, Const):
        return Const(int_value(left) + factor * int_value(right), integer())
    return Plus(left, right, factor)


def int_value(const: Const) -> int:
    """The integer of a literal whose sort was checked when the term was built."""
    assert isinstance(const.value, int)
    return const.value


def choice(condition: Expr, then: Expr, otherwise: Expr) -> Expr:
    """``then if condition else otherwise``; of Booleans it becomes connectives."""
    if isinstance(condition, Const):
        return then if condition.value else otherwise
    if then == otherwise:
        return then
    if then.sort is BOOL:
        return conjunction(disjunction(negation(condition), then), disjunction(condition, otherwise))
    return Ite(condition, then, otherwise)


def quantified(universal: bool, bound: tuple[Ref, ...], body: Expr) -> Expr:
    """The quantified formula; a body that is a literal needs no quantifier (a sort is never empty)."""
    if isinstance(body, Const) or not bound:
        return body
    if isinstance(body, Quantified) and body.universal == universal:
        return Quantified(universal, bound + body.bound, body.body)
    return Quantified(universal, bound, body)


def walk(expr: Expr) -> Iterator[Expr]:
    """The node and all nodes below it, outermost first."""
    yield expr
    for child in children(expr):
        yield from walk(child)


@lru_cache(maxsize=65536)
def variables_of(expr: Expr) -> frozenset[str]:
    """Names of the state variables that the expression reads (before or after the step)."""
    return frozenset(node.variable for node in walk(expr) if isinstance(node, Cell))


def refs_of(expr: Expr) -> dict[str, Ref]:
    """Parameters and bound variables that occur in the expression, by name."""
    return {node.name: node for node in walk(expr) if isinstance(node, Ref)}


def reads_next(expr: Expr) -> bool:
    """Whether the expression speaks of the state after the step."""
    return any(isinstance(node, Cell) and node.next for node in walk(expr))


def literal(value: Any, sort: Sort) -> Const | None:
    """``value`` as a literal of ``sort``, or ``None`` if it is not one."""
    fits = (
        (sort is BOOL and isinstance(value, bool))
        or (isinstance(sort, IntSort) and isinstance(value, int) and not isinstance(value, bool))
        or (isinstance(sort, EnumSort) and value in sort.members)
    )
    return Const(value, sort) if fits and not isinstance(sort, ElementSort) else None
