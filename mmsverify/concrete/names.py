"""Which parameters and variables an expression leaves open: what must be known to ground it."""

from __future__ import annotations

from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr


def free_names(expr: Expr) -> frozenset[str]:
    """Names of the parameters (values, sets, optional ones) and unbound variables of an expression."""
    own: frozenset[str] = frozenset()
    match expr:
        case ex.Ref(name) | ex.Present(name):
            own = frozenset((name,))
        case ex.Member(name):
            own = frozenset((name,))
        case ex.Quantified(_, bound, body):
            return free_names(body) - {ref.name for ref in bound}
    return own.union(*map(free_names, ex.children(expr)))


def conjuncts(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a conjunction, or the expression itself."""
    return expr.parts if isinstance(expr, ex.And) else (expr,)
