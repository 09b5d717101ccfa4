"""What becomes of each mutant of a model, by the cheapest means that tells.

How a mutant is killed differs from model to model; what is asked of all of them is here.
"""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass

from mutant_judge import claim_mutants
from mutation import Mutant

from mmsverify.model import Claim, ModelData

CHECK, EQUAL, AUDIT, OPEN = "check", "equal", "audit", "open"
CLAIM = "property"

Any_Mutant = Mutant | tuple[str, Claim]
Key = tuple[str, str, str]


@dataclass(frozen=True)
class Fate:
    """What became of a mutant: by what it is killed, or that it is none, or that it lives.

    ``told``: the recording by which an audit alone tells it, where that was asked.
    """

    number: int
    what: str
    kind: str
    place: str
    fate: str
    by: str
    seconds: float
    told: str = ""

    @property
    def open(self) -> bool:
        """Whether nothing kills it."""
        return self.fate == OPEN

    def __str__(self) -> str:
        return f"{self.fate}  {self.what}, {self.kind}: {self.place}  {self.by}"


def key(mutant: Any_Mutant) -> Key:
    """A mutant's name in tables: what was changed, how, where. Several of a claim may have the same."""
    if isinstance(mutant, Mutant):
        return mutant.what, mutant.kind, mutant.place
    kind, claim = mutant
    return CLAIM, kind, claim.name


def all_mutants(model: ModelData, of_rows: Iterable[Mutant]) -> tuple[Any_Mutant, ...]:
    """All mutants in a fixed order: those of the rows, then those of the claims."""
    return (*of_rows, *claim_mutants(model))


class Score(ABC):
    """Judges mutants one by one; what all need is made once."""

    def __init__(self, numbered: tuple[Any_Mutant, ...]) -> None:
        self.mutants = numbered

    def fate(self, number: int) -> Fate:
        """What becomes of the mutant of this number."""
        begin = time.process_time()
        mutant = self.mutants[number]
        told = ""
        if isinstance(mutant, Mutant):
            fate, by = self.of_rows(mutant)
            told = "" if fate == EQUAL else self.told(mutant)
        else:
            fate, by = self.of_claim(mutant[1])
        return Fate(number, *key(mutant), fate, by, time.process_time() - begin, told)

    @abstractmethod
    def of_rows(self, mutant: Mutant) -> tuple[str, str]:
        """The fate of a change of rows, and by what."""

    @abstractmethod
    def of_claim(self, claim: Claim) -> tuple[str, str]:
        """The fate of a changed claim, and by what."""

    def told(self, _: Mutant) -> str:
        """The recording by which an audit alone tells a change of rows; empty where that is not asked."""
        return ""
