"""Inductive invariants: initiation and consecution of every claim, for any number of elements.

The claims strengthen each other: all are assumed together. Those that fail are dropped and the rest is tried
again until it is stable (Houdini; Flanagan and Leino, FME 2001), so that what remains is inductive on its
own. A dropped claim is not refuted; that takes a run (bounded search).
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field

import z3

from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.symbolic.translate import Translator, obligation


@dataclass(frozen=True, slots=True)
class Obstacle:
    """Why a claim is not inductive.

    ``row`` may break it (``None``: the start does), ``answer`` is how Z3 ended: ``sat`` or ``unknown``, or
    ``timeout`` where the time of all proofs was over.
    """

    claim: str
    row: str | None
    answer: str
    state: str = ""


@dataclass(slots=True)
class Induction:
    """The outcome: names of the claims that are proved, and for the others what stood in the way."""

    proved: set[str] = field(default_factory=set)
    obstacles: dict[str, list[Obstacle]] = field(default_factory=dict)
    seconds: dict[str, float] = field(default_factory=dict)
    queries: int = 0


class Prover:
    """Discharges initiation and consecution with one incremental solver a model.

    ``timeout``: seconds for one question; ``until``: when, on the monotonic clock, no more is asked.
    """

    def __init__(
        self,
        model: ModelData,
        *,
        timeout: float = 10.0,
        facts: Sequence[Expr] = (),
        until: float = math.inf,
    ) -> None:
        self.model = model
        self.translator = Translator(model)
        self.timeout = timeout
        self.until = until
        self.base = [c.condition for c in model.assumptions] + list(facts)
        self.queries = 0

    def prove(self, claims: Iterable[Claim]) -> Induction:
        """The largest inductive subset of the ``always`` claims, then every ``step`` claim under it."""
        listed = list(claims)
        outcome = Induction()
        kept = self._initiation([c for c in listed if c.kind == "always"], outcome)
        kept = self._consecution(kept, outcome)
        outcome.proved |= {c.name for c in kept}
        self._steps([c for c in listed if c.kind == "step"], kept, outcome)
        outcome.queries = self.queries
        return outcome

    def _initiation(self, claims: list[Claim], outcome: Induction) -> list[Claim]:
        solver = self._solver([*self.base, *(c.condition for c in self.model.initial)])
        return [c for c in claims if not self._record(outcome, solver, c, None, c.formula)]

    def _consecution(self, claims: list[Claim], outcome: Induction) -> list[Claim]:
        kept, stable = claims, False
        while not stable:
            solver = self._solver([*self.base, *(c.formula for c in kept)])
            lost = {c.name for row in self.model.actions for c in self._broken(solver, row, kept, outcome)}
            stable = not lost
            kept = [c for c in kept if c.name not in lost]
        return kept

    def _steps(self, claims: list[Claim], kept: list[Claim], outcome: Induction) -> None:
        solver = self._solver([*self.base, *(c.formula for c in kept)])
        lost = {c.name for row in self.model.actions for c in self._broken(solver, row, claims, outcome)}
        outcome.proved |= {c.name for c in claims if c.name not in lost}

    def _broken(
        self, solver: z3.Solver, row: Row, claims: Sequence[Claim], outcome: Induction
    ) -> list[Claim]:
        """The claims that the row may break: one query for all of them, and one each where that fails."""
        if self._over():
            return self._unasked(row, claims, outcome)
        goals = [(c, obligation(c, row)) for c in claims if may_break(row, c)]
        goals = [(c, goal) for c, goal in goals if goal != ex.TRUE]
        if not goals:
            return []
        solver.push()
        solver.add(self.translator.formula(row.guard_formula))
        begin = time.perf_counter()
        together = self._holds(solver, ex.conjunction(*(goal for _, goal in goals))) == z3.unsat
        for claim, _ in goals:
            outcome.seconds[claim.name] = outcome.seconds.get(claim.name, 0.0) + (
                time.perf_counter() - begin
            ) / len(goals)
        broken = [] if together else [c for c, goal in goals if self._record(outcome, solver, c, row, goal)]
        solver.pop()
        return broken

    def _record(
        self, outcome: Induction, solver: z3.Solver, claim: Claim, row: Row | None, goal: Expr
    ) -> bool:
        """Whether the goal may fail; the obstacle is kept."""
        if self._over():
            return bool(self._unasked(row, [claim], outcome))
        begin = time.perf_counter()
        answer = self._holds(solver, goal)
        outcome.seconds[claim.name] = outcome.seconds.get(claim.name, 0.0) + time.perf_counter() - begin
        if answer == z3.unsat:
            return False
        state = str(self._model) if answer == z3.sat else ""
        found = Obstacle(claim.name, row.id if row else None, str(answer), state)
        outcome.obstacles.setdefault(claim.name, []).append(found)
        return True

    def _over(self) -> bool:
        return time.monotonic() >= self.until

    def _unasked(self, row: Row | None, claims: Sequence[Claim], outcome: Induction) -> list[Claim]:
        """Every claim may fail where there is no time left to ask."""
        for claim in claims:
            found = Obstacle(claim.name, row.id if row else None, "timeout")
            outcome.obstacles.setdefault(claim.name, []).append(found)
        return list(claims)

    def _holds(self, solver: z3.Solver, goal: Expr) -> z3.CheckSatResult:
        """Ask for a state in which the goal fails: ``unsat`` means that it holds."""
        self.queries += 1
        solver.push()
        solver.add(z3.Not(self.translator.formula(goal)))
        answer = solver.check()
        self._model = solver.model() if answer == z3.sat else None
        solver.pop()
        return answer

    def _solver(self, formulas: Sequence[Expr]) -> z3.Solver:
        solver = z3.Solver()
        left = min(self.timeout, self.until - time.monotonic())
        solver.set("timeout", max(1, int(left * 1000)))
        solver.add(*(self.translator.formula(f) for f in formulas), *self.translator.bounds())
        return solver


def may_break(row: Row, claim: Claim) -> bool:
    """Whether the row writes a variable that the claim reads; it can break no other.

    A two-state claim may ask for the row itself, so that any row may break it.
    """
    return claim.kind == "step" or bool(row.writes & ex.variables_of(claim.formula))
