"""Whether facts can hold under a model's assumptions: from facts that cannot, everything would follow."""

from __future__ import annotations

from collections.abc import Sequence

import z3

from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Conjunct
from mmsverify.symbolic.translate import Translator


def contradicted(model: ModelData, facts: Sequence[Expr]) -> Conjunct | None:
    """The first assumption that cannot hold beside the facts and the assumptions before it, if any."""
    translator = Translator(model)
    solver = z3.Solver()
    solver.add(*(translator.formula(fact) for fact in facts))
    for assumption in model.assumptions:
        solver.add(translator.formula(assumption.condition))
        if solver.check() == z3.unsat:
            return assumption
    return None
