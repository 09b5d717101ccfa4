"""What becomes of each mutant of the robot model, by the cheapest means that tells.

1. ``check``: Z3 refutes a claim of a changed row that is proved of the real one.
2. Equal: Z3 proves that the changed rows do what the real ones do in every state that keeps the invariants.
3. ``audit`` of a recording that was not made from the rows: other findings.
4. ``audit`` of a conversation that leads to a moment at which the mutant acts otherwise: its robot is accused
   by the real model, or a right robot by the mutant.
"""

from __future__ import annotations

import time
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from mutant_recordings import Shelf
from robot import robot
from robot_conversations import ROBOTS
from robot_judge import Judge, claim_mutants
from robot_moments import Hunt, found_by_audit
from robot_mutation import STEP, TRANSITION, Mutant, mutants
from robot_random import Chance, beginning

from mmsverify.model import Claim

CHECK, EQUAL, AUDIT, OPEN = "check", "equal", "audit", "open"
CLAIM = "property"
WALKS, LENGTH = 60, 160

Any_Mutant = Mutant | tuple[str, Claim]


@dataclass(frozen=True)
class Fate:
    """What became of a mutant: by what it is killed, or that it is none, or that it lives."""

    number: int
    what: str
    kind: str
    place: str
    fate: str
    by: str
    seconds: float

    @property
    def open(self) -> bool:
        """Whether nothing kills it."""
        return self.fate == OPEN

    def __str__(self) -> str:
        return f"{self.fate}  {self.what}, {self.kind}: {self.place}  {self.by}"


@cache
def numbered_mutants() -> tuple[Any_Mutant, ...]:
    """All mutants, in a fixed order."""
    model = robot("repaired")
    return (*mutants(model), *claim_mutants(model))


class Score:
    """Judges mutants one by one; what all need is made once."""

    def __init__(self, folder: Path) -> None:
        self.model = robot("repaired")
        self.folder = folder
        self.judge = Judge(self.model)
        self._shelf: Shelf | None = None
        self._hunt: Hunt | None = None

    def fate(self, number: int) -> Fate:
        """What becomes of the mutant of this number."""
        begin = time.process_time()
        mutant = numbered_mutants()[number]
        if isinstance(mutant, Mutant):
            what, kind, place = mutant.what, mutant.kind, mutant.place
            fate, by = self._of_rows(mutant)
        else:
            kind, claim = mutant
            what, place = CLAIM, claim.name
            fate, by = self._of_claim(claim)
        return Fate(number, what, kind, place, fate, by, time.process_time() - begin)

    def _of_claim(self, claim: Claim) -> tuple[str, str]:
        refuted = self.judge.refuted(claim)
        if refuted is None:
            return OPEN, "Z3 does not know"
        return (CHECK, claim.name) if refuted else (EQUAL, "proved, too")

    def _of_rows(self, mutant: Mutant) -> tuple[str, str]:
        if claim := self.judge.lost(mutant):
            return CHECK, claim
        if self.judge.alike(mutant):
            return EQUAL, ""
        by = self.shelf.telling(mutant)
        if not by and mutant.what in (STEP, TRANSITION):
            by = found_by_audit(self.model, mutant, self.hunt, self.folder)
        return (AUDIT, by) if by else (OPEN, "")

    @property
    def shelf(self) -> Shelf:
        """The recordings that were not made from the rows."""
        if self._shelf is None:
            self._shelf = Shelf(self.model, self.folder)
        return self._shelf

    @property
    def hunt(self) -> Hunt:
        """Walks of the model, to look for moments in."""
        if self._hunt is None:
            starts = (beginning(self.model, *ROBOTS[seed % len(ROBOTS)]) for seed in range(WALKS))
            walks = [Chance(t, seed, calm=True, gaps=0.0).hold(LENGTH) for seed, t in enumerate(starts)]
            self._hunt = Hunt(self.model, walks)
        return self._hunt
