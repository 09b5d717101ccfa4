"""From what was proved and found to verdicts: what is known of a claim, by which method, in which scope."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.checking.runs import Run, Search
from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.model.show import shown
from mmsverify.results import PathStep, Result, Verdict
from mmsverify.symbolic.induction import Obstacle
from mmsverify.symbolic.overlap import Coverage

LONGEST_STATEMENT = 200

Steps = tuple[PathStep, ...] | None


def any_number(model: ModelData) -> str:
    """The scope of a proof: ``any number of PI, Client``."""
    sorts = [sort.short for sort in model.sorts.values()]
    return f"any number of {', '.join(sorts)}" if sorts else "every run"


def by_proof(model: ModelData, claim: Claim, seconds: float) -> Verdict:
    """Proved by induction."""
    return _verdict(claim, "proved", "induction", any_number(model), seconds)


def out_of_reach(model: ModelData, claim: Claim, seconds: float) -> Verdict:
    """A ``Sometimes`` whose negation is proved."""
    what = "step" if any(isinstance(n, ex.RowFact) for n in ex.walk(claim.formula)) else "state"
    reason = f"no run reaches such a {what}: that it never happens is proved by induction"
    return _verdict(claim, "violated", "induction", any_number(model), seconds, reason=reason)


def by_run(claim: Claim, run: Run, seconds: float) -> Verdict:
    """Violated by a counterexample, or a ``Sometimes`` proved by a witness."""
    if claim.kind == "sometimes":
        return _verdict(claim, "proved", "bmc", run.scope, seconds, depth=run.length, witness=run.steps)
    return _verdict(claim, "violated", "bmc", run.scope, seconds, depth=run.length, counterexample=run.steps)


def by_search(claim: Claim, search: Search, seconds: float) -> Verdict:
    """Settled by a whole scope, or not at all."""
    if search.exhausted and claim.kind != "sometimes":
        return _verdict(claim, "proved", "exhaustive", search.scope, seconds, depth=search.depth)
    if search.exhausted:
        method = "exhaustive"
        reason = f"not reached in {search.scope}, searched whole; a larger scope may reach it"
    else:
        nothing = f"{_nothing_found(claim)} within {search.depth} steps"
        method, reason = "bmc", f"{nothing}; the search ended at {search.reason}"
    return _verdict(claim, "unknown", method, search.scope, seconds, depth=search.depth, reason=reason)


def undecided(
    model: ModelData, claim: Claim, obstacles: Sequence[Obstacle], searches: Sequence[Search], seconds: float
) -> Verdict:
    """Neither proved nor refuted; says what stands in the way of a proof and how far runs were looked for."""
    parts = [*_standing_in_the_way(obstacles), *_looked(claim, searches)]
    deepest = max((s.depth for s in searches), default=None)
    scope = searches[-1].scope if searches else any_number(model)
    method = "bmc" if searches else "induction"
    parts = parts or ["the time limit was reached before a run was looked for"]
    return _verdict(claim, "unknown", method, scope, seconds, depth=deepest, reason="; ".join(parts))


def told(coverage: Coverage) -> Iterator[str]:
    """Gaps and overlaps as notes, one for each row that others overlap with."""
    for gap in coverage.gaps():
        how = "no row answers it in some state" if gap.proved else "it may be that no row answers it"
        yield f"{gap.event}: {how}"
    seen: dict[tuple[str, str], int] = {}
    for overlap in coverage.overlaps():
        key = overlap.event, overlap.rows[1]
        seen[key] = seen.get(key, 0) + 1
    for (event, row), count in seen.items():
        yield f"{event}: {row} can be taken where another row can ({count} of them): the responder chooses"


def _standing_in_the_way(obstacles: Sequence[Obstacle]) -> list[str]:
    if not obstacles:
        return []
    rows = list(dict.fromkeys(o.row or "the initial state" for o in obstacles))
    if any(o.answer == "timeout" for o in obstacles):
        return ["the time limit was reached before it was proved"]
    if any(o.answer != "sat" for o in obstacles):
        return [f"the solver gave no answer for {', '.join(rows)}"]
    return [f"not inductive: {', '.join(rows)} may break it, from a state that may be out of reach"]


def _looked(claim: Claim, searches: Sequence[Search]) -> list[str]:
    depths: dict[str, int] = {}
    for search in searches:
        depths[search.scope] = max(search.depth, depths.get(search.scope, 0))
    return [f"{_nothing_found(claim)} within {depth} steps in {scope}" for scope, depth in depths.items()]


def _nothing_found(claim: Claim) -> str:
    return "no witness" if claim.kind == "sometimes" else "no counterexample"


def _verdict(
    claim: Claim, result: Result, method: str, scope: str, seconds: float, *, depth: int | None = None,
    counterexample: Steps = None, witness: Steps = None, reason: str = "",
) -> Verdict:  # fmt: skip
    ids = claim.clause.ids + claim.clause.readings
    return Verdict(
        claim.title, claim.kind, ids, result, method, scope, seconds, depth, counterexample, witness, reason,
        statement(claim),
    )  # fmt: skip


def statement(claim: Claim) -> str:
    """What the claim says, in its own words or as its formula where that is short."""
    formula = claim.says or shown(claim.formula)
    return formula if len(formula) <= LONGEST_STATEMENT else ""
