"""What proved invariants allow: one solver that holds them, asked about states and events again and again."""

from __future__ import annotations

from collections.abc import Sequence

import z3

from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.symbolic.translate import Translator


class Allowed:
    """Asks for states of a model that keep its assumptions and the invariants.

    ``timeout``: seconds for one question.
    """

    def __init__(self, model: ModelData, invariants: Sequence[Claim], *, timeout: float) -> None:
        self._translator = Translator(model)
        self._solver = z3.Solver()
        self._solver.set("timeout", int(timeout * 1000))
        given = [*(c.condition for c in model.assumptions), *(c.formula for c in invariants)]
        self._solver.add(*map(self._translator.formula, given), *self._translator.bounds())

    def ask(self, *conditions: Expr) -> z3.CheckSatResult:
        """What Z3 says of all the conditions together."""
        self._solver.push()
        self._solver.add(*map(self._translator.formula, conditions))
        answer = self._solver.check()
        self._solver.pop()
        return answer

    def possible(self, *conditions: Expr) -> bool:
        """Whether no proof rules the conditions out: what Z3 cannot decide counts as possible."""
        return bool(self.ask(*conditions) != z3.unsat)
