"""Which refusing steps can never refuse: Z3 finds no state that keeps the invariants and meets the guard."""

from __future__ import annotations

import z3

from mmsverify.model import ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.symbolic.translate import Translator

PANEL = "panel"


class Reach:
    """Asks of guards of one model whether its invariants leave a state for them."""

    def __init__(self, model: ModelData, *, seconds: float = 10.0) -> None:
        self.translator = Translator(model)
        self.solver = z3.Solver()
        self.solver.set("timeout", int(seconds * 1000))
        given = [*(c.condition for c in model.assumptions), *(c.formula for c in model.always)]
        self.solver.add(*map(self.translator.formula, given), *self.translator.bounds())

    def never(self, condition: Expr) -> bool:
        """Whether it is proved that the condition holds in no reachable state."""
        self.solver.push()
        self.solver.add(self.translator.formula(condition))
        answer = self.solver.check()
        self.solver.pop()
        return bool(answer == z3.unsat)

    def refusal(self, row: Row) -> str:
        """Why no message can meet this refusal: empty where nothing is proved."""
        if self.never(row.guard_formula):
            return "no reachable state"
        panel = next((p for p in row.on.parameters if p.name == PANEL), None)
        if isinstance(panel, ex.Ref) and self.never(ex.conjunction(row.guard_formula, ex.negation(panel))):
            return "only at the panel, which sends no message"
        return ""
