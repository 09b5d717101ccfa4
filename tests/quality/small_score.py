"""What becomes of each mutant of a small model, by the cheapest means that tells.

A model is small if all its states can be searched, be it for few things of each sort: the two of the VR
framework, and the server of signals.

1. ``check``: Z3 finds a claim that a changed row may break, and the search finds the run that breaks it.
2. Equal: Z3 proves that the changed rows do what the real ones do in every state that keeps the invariants.
3. ``check``: the search of all states finds a claim that fails, or sees that what is to happen sometimes
   never does.
4. ``audit`` of a recording that was not made from the rows: other findings. Not of vr-tasks: what a
   recording shows is not split into the steps of the two tasks.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cache

from mutant_judge import Judge
from mutation import Mutant, mutants
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, Any_Mutant, Score, all_mutants

from mmsverify.concrete import search
from mmsverify.concrete.scope import scope_for
from mmsverify.model import Claim, ModelData, load
from mmsverify.resources import models_dir

LEAST = 0.95
"""Of the mutants that are not equal, this share is to be killed."""


def silent(_: ModelData) -> str:
    """No recording shows the steps of the model."""
    return ""


@dataclass(frozen=True)
class Small:
    """One of the models, by its name.

    ``sizes``: how many things there are of each sort in the states that are searched; ``untold``: parameters
    of answers that nothing recorded tells; ``telling``: the recording by which an audit tells a change.
    """

    name: str
    sizes: Mapping[str, int] = field(default_factory=dict)
    untold: frozenset[str] = frozenset()
    telling: Callable[[ModelData], str] = silent


@cache
def repaired(name: str) -> ModelData:
    """One of the models."""
    return load(name, models_dir(), "repaired")


@cache
def numbered_mutants(name: str) -> tuple[Any_Mutant, ...]:
    """All mutants, in a fixed order."""
    model = repaired(name)
    return all_mutants(model, mutants(model, entries=True))


def the_mutant(name: str, place: str, kind: str) -> Mutant:
    """That of a model's rows at this place, of this kind."""
    made = mutants(repaired(name), entries=True)
    return next(mutant for mutant in made if (mutant.place, mutant.kind) == (place, kind))


class SmallScore(Score):
    """Judges mutants one by one. With ``alone``, audits are asked of those that ``check`` kills, too."""

    def __init__(self, small: Small, *, alone: bool = False) -> None:
        super().__init__(numbered_mutants(small.name))
        self.model, self._small = repaired(small.name), small
        self.judge = Judge(self.model, untold=small.untold)
        self._claims = {claim.name: claim for claim in self.model.claims}
        self._alone = alone

    def of_rows(self, mutant: Mutant) -> tuple[str, str]:
        """The means of the module, one after the other."""
        changed = mutant.applied(self.model)
        suspect = self._claims.get(self.judge.lost(mutant) or "")
        if suspect is not None and self._failing(changed, suspect):
            return CHECK, suspect.name
        if self.judge.alike(mutant):
            return EQUAL, ""
        if claim := self._failing(changed, *self.model.claims):
            return CHECK, claim
        by = self._small.telling(changed)
        return (AUDIT, by) if by else (OPEN, "")

    def of_claim(self, claim: Claim) -> tuple[str, str]:
        """Killed if some run breaks it; equal if Z3 proves it of all."""
        if self.judge.refuted(claim) is False:
            return EQUAL, "proved, too"
        broken = self._failing(self.model, claim)
        return (CHECK, broken) if broken else (OPEN, "holds in every state, but Z3 does not prove it")

    def told(self, mutant: Mutant) -> str:
        """The recording by which an audit alone tells it."""
        return self._small.telling(mutant.applied(self.model)) if self._alone else ""

    def noticed(self) -> tuple[float, list[str]]:
        """The share of the mutants that are killed, of those that are not equal; those that live."""
        fates = [fate for fate in map(self.fate, range(len(self.mutants))) if fate.fate != EQUAL]
        alive = [str(fate) for fate in fates if fate.open]
        return 1 - len(alive) / len(fates), alive

    def _failing(self, model: ModelData, *claims: Claim) -> str:
        """A claim that does not hold of all reachable states, which are searched; empty if all do."""
        found = search(model, scope_for(model, self._small.sizes, {}), claims=claims)
        never = (c.name for c in claims if c.kind == "sometimes" and c.name not in found.witnesses)
        return next(iter(found.violations), "") or next(never, "")
