"""What rows may do where the proved invariants hold: which claims they may break, which are never taken.

A suspicion is no finding: the state from which a row breaks a claim may be out of reach. It says where to
look.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import z3

from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.symbolic.induction import may_break
from mmsverify.symbolic.translate import Translator, obligation


class Suspects:
    """Asks of each row what it may do, under assumptions and invariants that have been proved."""

    def __init__(self, model: ModelData, invariants: Sequence[Claim], *, timeout: float = 5.0) -> None:
        self.model = model
        self._translator = Translator(model)
        self._solver = z3.Solver()
        self._solver.set("timeout", int(timeout * 1000))
        given = [*(c.condition for c in model.assumptions), *(c.formula for c in invariants)]
        self._solver.add(*map(self._translator.formula, given), *self._translator.bounds())

    def breakers(self, claim: Claim) -> Iterator[Row]:
        """The rows after which the claim may be broken where it held before."""
        held = ex.TRUE if claim.kind == "step" else claim.formula
        for row in self.model.actions:
            if may_break(row, claim) and self._possible(
                [held, row.guard_formula, ex.negation(obligation(claim, row))]
            ):
                yield row

    def never_taken(self) -> Iterator[Row]:
        """The rows whose guard no state satisfies: proved, for what Z3 cannot decide counts as possible."""
        return (row for row in self.model.actions if not self._possible([row.guard_formula]))

    def _possible(self, conditions: Iterable[ex.Expr]) -> bool:
        self._solver.push()
        self._solver.add(*map(self._translator.formula, conditions))
        answer = self._solver.check()
        self._solver.pop()
        return bool(answer != z3.unsat)
