"""Rewriting of expressions: the same formula with parts replaced, renamed, bound or read after the step.

Everything here keeps to structure; what an update means is ``rows.after``, built on these.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from mmsverify.model.expr import (
    BOUND,
    And,
    Cell,
    Eq,
    Expr,
    Ite,
    Less,
    Member,
    Not,
    Or,
    Plus,
    Quantified,
    Ref,
    choice,
    conjunction,
    disjunction,
    equal,
    less,
    negation,
    plus,
    quantified,
    refs_of,
    variables_of,
)

Rebuild = Callable[[Expr], Expr]


def rebuilt(expr: Expr, change: Rebuild) -> Expr:
    """The node with every direct part changed, simplified where a part became a literal."""
    match expr:
        case Cell(variable, args, of, after):
            return Cell(variable, tuple(map(change, args)), of, after)
        case Member(name, element):
            return Member(name, change(element))
        case Not(body):
            return negation(change(body))
        case And(parts):
            return conjunction(*map(change, parts))
        case Or(parts):
            return disjunction(*map(change, parts))
        case Eq(left, right):
            return equal(change(left), change(right))
        case Less(left, right):
            return less(change(left), change(right))
        case Plus(left, right, factor):
            return plus(change(left), change(right), factor)
        case Ite(condition, then, otherwise):
            return choice(change(condition), change(then), change(otherwise))
        case Quantified(universal, bound, body):
            return quantified(universal, bound, change(body))
    return expr


def bind(universal: bool, bound: tuple[Ref, ...], body: Expr) -> Expr:
    """Close ``body`` over variables that were free in it; their names are marked as bound."""
    marked = {ref.name: Ref(ref.name + BOUND, ref.of) for ref in bound}
    return quantified(universal, tuple(marked.values()), substitute(body, marked))


def substitute(expr: Expr, refs: Mapping[str, Expr]) -> Expr:
    """The expression with parameters and free bound variables replaced.

    A bound name is renamed rather than captured.
    """
    if not refs:
        return expr
    if isinstance(expr, Ref):
        return refs.get(expr.name, expr)
    if isinstance(expr, Quantified):
        return _substitute_under(expr, refs)
    return rebuilt(expr, lambda part: substitute(part, refs))


def _substitute_under(expr: Quantified, refs: Mapping[str, Expr]) -> Expr:
    free = {name: value for name, value in refs.items() if all(ref.name != name for ref in expr.bound)}
    taken = {name for value in free.values() for name in refs_of(value)}
    fresh = {ref.name: Ref(unused(ref.name, taken), ref.of) for ref in expr.bound if ref.name in taken}
    bound = tuple(fresh.get(ref.name, ref) for ref in expr.bound)
    return quantified(expr.universal, bound, substitute(expr.body, {**free, **fresh}))


def unused(name: str, taken: set[str]) -> str:
    """A name like ``name`` that is not taken."""
    while name in taken:
        name += "'"
    return name


def map_cells(expr: Expr, change: Callable[[Cell], Expr], of: frozenset[str] | None = None) -> Expr:
    """The expression with cells replaced by ``change(cell)``, innermost first.

    ``of`` restricts this to the cells of some variables; ``None`` means all.
    """
    if of is not None and of.isdisjoint(variables_of(expr)):
        return expr
    inner = rebuilt(expr, lambda part: map_cells(part, change, of))
    # Asked of ``expr``: what is left of a connective may be a cell, too, and that one is changed already.
    return change(inner) if isinstance(expr, Cell) and isinstance(inner, Cell) else inner


def primed(expr: Expr) -> Expr:
    """The same expression over the state after the step."""
    return map_cells(expr, lambda cell: Cell(cell.variable, cell.args, cell.of, True))
