"""What becomes of each mutant of the VR framework's models, by the cheapest means that tells.

1. ``check``: Z3 finds a claim that a changed row may break, and the search finds the run that breaks it.
2. Equal: Z3 proves that the changed rows do what the real ones do in every state that keeps the invariants.
3. ``check``: the search of all states finds a claim that fails, or sees that what is to happen sometimes
   never does.
4. ``audit`` of a recording that was not made from the rows: other findings. Of vr-template only: what a
   recording shows is not split into the steps of the two tasks.
"""

from __future__ import annotations

from functools import cache

from mutant_judge import Judge
from mutation import Mutant, mutants
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, Any_Mutant, Score, all_mutants
from vr_shelf import telling

from mmsverify.concrete import search
from mmsverify.concrete.scope import scope_for
from mmsverify.model import Claim, ModelData, load
from mmsverify.resources import models_dir

TEMPLATE, TASKS = "vr-template", "vr-tasks"
UNTOLD = frozenset({"cuts_in"})
"""Whether an action is cut short by way of an inserted mode: no cell says which of the two will come."""


@cache
def repaired(name: str) -> ModelData:
    """One of the two models."""
    return load(name, models_dir(), "repaired")


@cache
def numbered_mutants(name: str) -> tuple[Any_Mutant, ...]:
    """All mutants, in a fixed order."""
    model = repaired(name)
    return all_mutants(model, mutants(model, entries=True))


class VrScore(Score):
    """Judges mutants one by one. With ``alone``, audits are asked of those that ``check`` kills, too."""

    def __init__(self, name: str, *, alone: bool = False) -> None:
        super().__init__(numbered_mutants(name))
        self.model = repaired(name)
        self.judge = Judge(self.model, untold=UNTOLD)
        self._claims = {claim.name: claim for claim in self.model.claims}
        self._audited = name == TEMPLATE
        self._alone = alone

    def of_rows(self, mutant: Mutant) -> tuple[str, str]:
        """The means of the module, one after the other."""
        changed = mutant.applied(self.model)
        suspect = self._claims.get(self.judge.lost(mutant) or "")
        if suspect is not None and failing(changed, suspect):
            return CHECK, suspect.name
        if self.judge.alike(mutant):
            return EQUAL, ""
        if claim := failing(changed, *self.model.claims):
            return CHECK, claim
        by = telling(changed) if self._audited else ""
        return (AUDIT, by) if by else (OPEN, "")

    def of_claim(self, claim: Claim) -> tuple[str, str]:
        """Killed if some run breaks it; equal if Z3 proves it of all."""
        if self.judge.refuted(claim) is False:
            return EQUAL, "proved, too"
        broken = failing(self.model, claim)
        return (CHECK, broken) if broken else (OPEN, "holds in every state, but Z3 does not prove it")

    def told(self, mutant: Mutant) -> str:
        """The recording by which an audit alone tells it."""
        return telling(mutant.applied(self.model)) if self._audited and self._alone else ""


def failing(model: ModelData, *claims: Claim) -> str:
    """A claim that does not hold of all reachable states, which are searched; empty if all do."""
    found = search(model, scope_for(model, {}, {}), claims=claims)
    never = (c.name for c in claims if c.kind == "sometimes" and c.name not in found.witnesses)
    return next(iter(found.violations), "") or next(never, "")
