"""Stronger claims to try where one is true but not inductive: the same with a condition or alternative less.

A claim often fails to be inductive only because it excuses states that never occur ("where ``a`` exists, a
list of ``a`` means that ``a`` is selected", though no list outlives the selection at all). What is tried here
is proved or dropped by the prover like any other claim; nothing is assumed.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from itertools import combinations

from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.rows import Claim

ASSISTS = "!"
"""Parts the name of a claim from the number of one that is made of it."""

_FEWEST, _MOST_DROPPED = 1, 2


def sharpened(claims: Iterable[Claim]) -> Iterator[Claim]:
    """Invariants to try beside ``claims``; each implies one of them, or a part of one."""
    known = {claim.formula for claim in claims}
    for claim in claims:
        if claim.kind == "always":
            for number, formula in enumerate(_stronger(claim.formula)):
                if formula not in known:
                    known.add(formula)
                    name = f"{claim.name}{ASSISTS}{number}"
                    yield Claim(name, "always", claim.clause, formula, assists=True)


def _stronger(formula: Expr) -> Iterator[Expr]:
    bound: tuple[Ref, ...] = ()
    if isinstance(formula, ex.Quantified) and formula.universal:
        bound, formula = formula.bound, formula.body
    for clause in _clauses(formula):
        for size in range(len(clause), max(_FEWEST, len(clause) - _MOST_DROPPED) - 1, -1):
            for kept in combinations(clause, size):
                yield ex.quantified(True, bound, ex.disjunction(*kept))


def _clauses(formula: Expr) -> list[tuple[Expr, ...]]:
    """The formula as clauses, as far as a conclusion that is a conjunction is concerned."""
    alternatives = _alternatives(formula)
    last = alternatives[-1]
    if isinstance(last, ex.And):
        return [(*alternatives[:-1], part) for part in last.parts]
    return [alternatives]


def _alternatives(formula: Expr) -> tuple[Expr, ...]:
    """The parts of a disjunction, with the parts of a negated conjunction negated."""
    match formula:
        case ex.Or(parts):
            return tuple(inner for part in parts for inner in _alternatives(part))
        case ex.Not(ex.And(parts)):
            return tuple(ex.negation(part) for part in parts)
    return (formula,)
