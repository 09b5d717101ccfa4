"""What rows may do where the proved invariants hold: which claims they may break, which are never taken.

A suspicion is no finding: the state from which a row breaks a claim may be out of reach. It says where to
look.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.symbolic.allowed import Allowed
from mmsverify.symbolic.induction import may_break
from mmsverify.symbolic.translate import obligation


class Suspects:
    """Asks of each row what it may do, under assumptions and invariants that have been proved."""

    def __init__(self, model: ModelData, invariants: Sequence[Claim], *, timeout: float = 5.0) -> None:
        self.model = model
        self._allowed = Allowed(model, invariants, timeout=timeout)

    def breakers(self, claim: Claim) -> Iterator[Row]:
        """The rows after which the claim may be broken where it held before."""
        held = ex.TRUE if claim.kind == "step" else claim.formula
        for row in self.model.actions:
            if may_break(row, claim) and self._allowed.possible(
                held, row.guard_formula, ex.negation(obligation(claim, row))
            ):
                yield row

    def never_taken(self) -> Iterator[Row]:
        """The rows whose guard no state satisfies: proved, for what Z3 cannot decide counts as possible."""
        return (row for row in self.model.actions if not self._allowed.possible(row.guard_formula))
