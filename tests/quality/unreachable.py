"""Which refusing steps can never refuse: Z3 finds no state that keeps the invariants and meets the guard."""

from __future__ import annotations

from mmsverify.model import ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.symbolic.allowed import Allowed

PANEL = "panel"


class Reach:
    """Asks of guards of one model whether its invariants leave a state for them."""

    def __init__(self, model: ModelData, *, seconds: float = 10.0) -> None:
        self.allowed = Allowed(model, model.always, timeout=seconds)

    def refusal(self, row: Row) -> str:
        """Why no message can meet this refusal: empty where nothing is proved."""
        if not self.allowed.possible(row.guard_formula):
            return "no reachable state"
        panel = next((p for p in row.on.parameters if p.name == PANEL), None)
        if isinstance(panel, ex.Ref) and not self.allowed.possible(row.guard_formula, ex.negation(panel)):
            return "only at the panel, which sends no message"
        return ""
