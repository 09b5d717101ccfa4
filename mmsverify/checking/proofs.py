"""Proofs for any number of elements: by induction, then with sharper claims beside the open ones."""

from __future__ import annotations

import math
import time
from collections.abc import Mapping, Sequence
from typing import Literal

from mmsverify.concrete.machine import speaks_of_steps
from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.symbolic.induction import Obstacle, Prover
from mmsverify.symbolic.sharpen import ASSISTS, sharpened

QUERY_SECONDS = 10.0
"""How long Z3 may think about one obligation; they take milliseconds."""


class Proofs:
    """What has been proved of one model so far. What is known is given to every later attempt."""

    def __init__(
        self,
        model: ModelData,
        timeout: float | None = None,
        assumed: Sequence[Expr] = (),
        until: float = math.inf,
    ) -> None:
        self.model = model
        self.assumed = list(assumed)
        self.until = until
        self.timeout = min(QUERY_SECONDS, timeout or QUERY_SECONDS)
        self.invariants: list[Claim] = []
        self.proved: set[str] = set()
        self.obstacles: dict[str, list[Obstacle]] = {}
        self.seconds: dict[str, float] = {}

    def attempt(self, claims: Sequence[Claim]) -> None:
        """Prove the largest inductive part of the claims, given what is known already."""
        known = [*self.assumed, *(claim.formula for claim in self.invariants)]
        begin = time.monotonic()
        prover = Prover(self.model, timeout=self.timeout, facts=known, until=self.until)
        outcome = prover.prove(claims)
        self.proved |= outcome.proved
        self.invariants += [c for c in claims if c.kind == "always" and c.name in outcome.proved]
        self.obstacles |= outcome.obstacles
        self._spent(claims, outcome.seconds, time.monotonic() - begin)

    def _spent(self, claims: Sequence[Claim], asking: Mapping[str, float], elapsed: float) -> None:
        """Add what each claim took, and its share of what all took; what assists it counts as it."""
        share = (elapsed - sum(asking.values())) / max(1, len(claims))
        for claim in claims:
            name = claim.name.partition(ASSISTS)[0]
            self.seconds[name] = self.seconds.get(name, 0.0) + asking.get(claim.name, 0.0) + share

    def sharpen(self, claims: Sequence[Claim], sources: Sequence[Claim]) -> None:
        """Try the claims again, beside stronger ones made from those of ``sources`` that are not proved."""
        if claims:
            self.attempt([*claims, *sharpened([c for c in sources if c.name not in self.proved])])

    def prove(self, claims: Sequence[Claim]) -> None:
        """Attempt the claims, then those that are left open beside sharper ones made from them."""
        self.attempt(claims)
        self.sharpen([c for c in claims if c.name not in self.proved], claims)

    def refute(self, claim: Claim) -> bool:
        """Whether a ``Sometimes`` is proved to be out of reach: its negation is inductive."""
        never = negated(claim)
        self.attempt([never])
        return never.name in self.proved


def negated(claim: Claim) -> Claim:
    """The claim that no state, or no step, is what a ``Sometimes`` says."""
    kind: Literal["step", "always"] = "step" if speaks_of_steps(claim) else "always"
    return Claim(f"{claim.name}{ASSISTS}never", kind, claim.clause, ex.negation(claim.formula), assists=True)
