"""Which parameters and variables an expression leaves open: what must be known to ground it."""

from __future__ import annotations

from mmsverify.errors import ModelError
from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.model.rows import Row


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


def check_names(row: Row) -> None:
    """Refuse a row that uses a name which is neither a parameter of its event nor bound."""
    known = {parameter.name for parameter in row.parameters}
    for conjunct in row.guard:
        _check(row, "guard", free_names(conjunct.condition) - known, row.place)
    for assign in row.assigns:
        used = free_names(assign.where).union(*map(free_names, (assign.value, *assign.args)))
        _check(
            row,
            f"update of {assign.variable}",
            used - known - {ref.name for ref in assign.bound},
            assign.place,
        )


def _check(row: Row, what: str, unknown: frozenset[str], place: str) -> None:
    if unknown:
        raise ModelError(
            f"the {what} in row {row.id} uses {sorted(unknown)[0]}, which is no parameter of its event",
            place=place or row.place,
            cure="add it to on=..., or bind it: for_all(x)(...), update.over(x)",
        )


def conjuncts(expr: Expr) -> tuple[Expr, ...]:
    """The parts of a conjunction, or the expression itself."""
    return expr.parts if isinstance(expr, ex.And) else (expr,)
