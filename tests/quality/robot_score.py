"""What becomes of each mutant of the robot model, by the cheapest means that tells.

1. ``check``: Z3 refutes a claim of a changed row that is proved of the real one.
2. Equal: Z3 proves that the changed rows do what the real ones do in every state that keeps the invariants.
3. ``audit`` of a recording that was not made from the rows: other findings.
4. ``audit`` of a conversation that leads to a moment at which the mutant acts otherwise: its robot is accused
   by the real model, or a right robot by the mutant.
"""

from __future__ import annotations

from functools import cache, cached_property
from pathlib import Path

from mutant_judge import Judge
from mutant_recordings import Shelf
from mutation import STEP, TRANSITION, Mutant, mutants
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, Any_Mutant, Score, all_mutants
from robot import robot
from robot_conversations import ROBOTS
from robot_moments import Hunt, found_by_audit
from robot_random import Chance, beginning

from mmsverify.model import Claim

WALKS, LENGTH = 60, 160


@cache
def numbered_mutants() -> tuple[Any_Mutant, ...]:
    """All mutants, in a fixed order."""
    model = robot("repaired")
    return all_mutants(model, mutants(model))


class RobotScore(Score):
    """Judges mutants one by one; what all need is made once."""

    def __init__(self, folder: Path) -> None:
        super().__init__(numbered_mutants())
        self.model = robot("repaired")
        self.folder = folder
        self.judge = Judge(self.model)

    def of_claim(self, claim: Claim) -> tuple[str, str]:
        """Killed if it is not proved any more."""
        refuted = self.judge.refuted(claim)
        if refuted is None:
            return OPEN, "Z3 does not know"
        return (CHECK, claim.name) if refuted else (EQUAL, "proved, too")

    def of_rows(self, mutant: Mutant) -> tuple[str, str]:
        """The means of the module, one after the other."""
        if claim := self.judge.lost(mutant):
            return CHECK, claim
        if self.judge.alike(mutant):
            return EQUAL, ""
        by = self.shelf.telling(mutant)
        if not by and mutant.what in (STEP, TRANSITION):
            by = found_by_audit(self.model, mutant, self.hunt, self.folder)
        return (AUDIT, by) if by else (OPEN, "")

    @cached_property
    def shelf(self) -> Shelf:
        """The recordings that were not made from the rows."""
        return Shelf(self.model, self.folder)

    @cached_property
    def hunt(self) -> Hunt:
        """Walks of the model, to look for moments in."""
        starts = (beginning(self.model, *ROBOTS[seed % len(ROBOTS)]) for seed in range(WALKS))
        walks = [Chance(t, seed, calm=True, gaps=0.0).hold(LENGTH) for seed, t in enumerate(starts)]
        return Hunt(self.model, walks)
