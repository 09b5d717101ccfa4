"""A property and one procedure, as a claim that a search can settle: the step of it that breaks the property.

Properties of the state are broken by a step from a state that keeps them. Of a property of steps that speaks
of one attribute only (figure 8), every change of the attribute is a case of its own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Const, Expr, RowFact
from mmsverify.model.model import ModelData
from mmsverify.model.rewrite import primed
from mmsverify.model.rows import Claim, Row
from mmsverify.model.sorts import EnumSort


@dataclass(frozen=True, slots=True)
class Pair:
    """``question`` comes true in a step of ``procedure`` that breaks ``claim``; ``change`` names the case."""

    claim: Claim
    procedure: str
    change: str
    question: Claim


def pairs(model: ModelData, claim: Claim, rows: Iterable[Row]) -> Iterator[Pair]:
    """The claim against each procedure that has one of the rows."""
    for name in dict.fromkeys(row.name for row in rows):
        taken = RowFact("name", (name,))
        broken = ex.conjunction(taken, _broken(claim))
        for change, condition in _changes(model, claim):
            title = f"{claim.name}!{name}!{change}" if change else f"{claim.name}!{name}"
            question = Claim(title, "sometimes", claim.clause, ex.conjunction(condition, broken))
            yield Pair(claim, name, change, question)


def _broken(claim: Claim) -> Expr:
    if claim.kind == "step":
        return ex.negation(claim.formula)
    return ex.conjunction(claim.formula, ex.negation(primed(claim.formula)))


def _changes(model: ModelData, claim: Claim) -> Iterator[tuple[str, Expr]]:
    view = _only_view(model, claim) if claim.kind == "step" else None
    if view is None:
        yield "", ex.TRUE
        return
    sort = view.sort
    assert isinstance(sort, EnumSort)
    for before in sort.members:
        for later in sort.members:
            condition = ex.conjunction(
                ex.equal(view, Const(before, sort)), ex.equal(primed(view), Const(later, sort))
            )
            yield f"{before} -> {later}", condition


def _only_view(model: ModelData, claim: Claim) -> Expr | None:
    """The attribute, drawn as a diagram, of which alone the claim speaks."""
    cells = {node.variable for node in ex.walk(claim.formula) if isinstance(node, Cell)}
    for name in _views(model):
        if name in model.signatures and cells == {name} and not model.signatures[name].sorts:
            return model.define(name)
    return None


def _views(model: ModelData) -> Sequence[str]:
    return list(model.options.get("views", {}).values())
