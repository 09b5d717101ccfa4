"""The check of models: in which order proofs and searches are tried, and the verdicts that come of them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from mmsverify.checking import verdicts
from mmsverify.checking.profile_facts import applies, assumed
from mmsverify.checking.proofs import Proofs
from mmsverify.checking.request import Progress, Request, require_known, require_sorts
from mmsverify.checking.runs import Explorer
from mmsverify.checking.worlds import World, small_worlds
from mmsverify.errors import ProfileError, UsageError
from mmsverify.model.expr import Expr
from mmsverify.model.load import load, made_for, names
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.profiles import ROBOT_TABLE, judge, load_profile, stated
from mmsverify.resources import models_dir
from mmsverify.results import ModelCheck, ProfileFinding, Verdict
from mmsverify.symbolic.consistency import contradicted
from mmsverify.symbolic.overlap import Coverage

FIRST_LOOK, SECOND_LOOK, LONG_LOOK, WHOLE_SCOPE = 40_000, 100_000, 400_000, 200_000
"""States to see in a world: between attempts at a proof, each harder than the last; in a scope asked for."""

NEAR_LOOK = 100_000
"""States to see breadth first, in the smallest world, after the first of the looks below."""

FAR_LOOKS = (8_000, 60_000, 250_000)
"""States to see in a world while witnesses under a profile are looked for: of all claims at once, then of
those to which the same variables matter."""


def check_models(
    models: Sequence[str],
    *,
    variant: str | None = None,
    properties: Sequence[str] = (),
    scope: Mapping[str, int] | None = None,
    unbounded: bool = False,
    depth: int | None = None,
    timeout: float | None = None,
    profile: Path | None = None,
    progress: Progress = None,
) -> list[ModelCheck]:
    """A verdict for every property of the models, by name or path; all that are shipped where none is named.

    ``scope`` bounds the numbers of elements, ``depth`` the steps of searches, ``timeout`` the
    seconds for each property.
    """
    folder = models_dir()
    tables = load_profile(profile) if profile is not None else {}
    texts = [load(name, folder, variant) for name in models or names(folder)]
    loaded = [made_for(model, tables.get(model.name, {})) for model in texts]
    require_known(properties, loaded)
    require_sorts(scope, loaded)
    checks = []
    for model in loaded:
        sizes = None if scope is None else {s.short: scope.get(s.short, 1) for s in model.sorts.values()}
        table = tables.get(model.name)
        judged = _judged(profile, model, table)
        request = Request(properties, sizes, unbounded, depth, timeout, table, judged)
        if not properties or any(map(request.asks_for, model.claims)):
            checks.append(check_model(model, request, progress))
    _require_something(properties, checks)
    return checks


def _require_something(properties: Sequence[str], checks: Sequence[ModelCheck]) -> None:
    """Refuse a request of which nothing is left: no verdict at all must not look like success."""
    if properties and not any(check.verdicts for check in checks):
        names = ", ".join(dict.fromkeys(name for check in checks for name in check.left_out))
        raise UsageError(
            f"{names}: not claimed of what has this profile, so that nothing is left to check",
            place="--property",
            cure="name another property, or leave --profile out",
        )


def _judged(
    profile: Path | None, model: ModelData, table: Mapping[str, Any] | None
) -> Sequence[ProfileFinding]:
    """What a robot's profile breaks by itself; of other models' tables there is nothing to judge."""
    if profile is None or table is None or model.name != ROBOT_TABLE:
        return ()
    return judge(table, stated(profile, model.name))


def check_model(model: ModelData, request: Request, progress: Progress = None) -> ModelCheck:
    """The verdicts of one model."""
    asked = [claim for claim in model.claims if request.asks_for(claim)]
    claims = [claim for claim in asked if _made_of(model, claim, request)]
    left_out = tuple(claim.title for claim in asked if claim not in claims)
    if asked and not claims:
        return ModelCheck(model.name, model.variant, [], (), request.judged, left_out)
    request = request.begun(len(claims))
    check = _Check(model, request, progress, claims)
    if request.sizes is None:
        check.without_bounds(claims)
    else:
        check.within(World(request.sizes, request.profile or {}), claims)
    found = [check.verdict(claim) for claim in claims]
    notes = [*_notes(model, request, found), *check.coverage()]
    return ModelCheck(model.name, model.variant, found, tuple(notes), request.judged, left_out)


def _require_possible(model: ModelData, facts: Sequence[Expr]) -> None:
    """Refuse a profile that contradicts what the model assumes of every robot: it would prove every claim."""
    broken = contradicted(model, facts) if facts else None
    if broken is not None:
        raise ProfileError(
            f"no {model.name} ({model.variant}) can have it: {' '.join(broken.clause.ids)} forbids it",
            place="--profile",
            cure="mend the profile",
        )


def _made_of(model: ModelData, claim: Claim, request: Request) -> bool:
    """Whether the claim is made of robots with the profile asked for; without one, every claim is."""
    if request.profile is None:
        return True
    return all(applies(model, claim, world.scope(model)) for world in small_worlds(model, request.profile))


def _notes(model: ModelData, request: Request, found: Sequence[Verdict]) -> Iterator[str]:
    for gap in model.gaps:
        yield f"gap {gap.name} ({' '.join(gap.clause.ids)}): {gap.says}"
    if request.sizes is not None and any(verdict.method != "induction" for verdict in found):
        low, high = World(request.sizes, request.profile or {}).scope(model, few=False).int_bounds
        yield f"where a verdict names a scope, integers without bounds range from {low} to {high}"


class _Check:
    """One model, one request: what is proved, what is found, what is still open."""

    def __init__(
        self, model: ModelData, request: Request, progress: Progress, asked: Sequence[Claim]
    ) -> None:
        self.model, self.request, self.progress = model, request, progress
        self.asked = asked
        facts = assumed(model, request.profile)
        _require_possible(model, facts)
        self.proofs = Proofs(model, request.timeout, facts, request.until)
        self.explorer = Explorer(model, request, progress)
        self.refuted: set[str] = set()

    def within(self, world: World, claims: Sequence[Claim]) -> None:
        """Every claim in one scope, searched whole if it can be; a proof for any number covers it too."""
        self.explorer.explore(claims, [world], states=WHOLE_SCOPE, few=False)
        if self.request.depth is None and any(c.kind != "sometimes" for c in self._unexplored(claims)):
            self._prove_all()

    def _unexplored(self, claims: Sequence[Claim]) -> Iterator[Claim]:
        """The open claims for which the scope was not searched whole."""
        searches = self.explorer.searches
        return (c for c in self._open(claims) if c.name not in searches or not searches[c.name][-1].exhausted)

    def without_bounds(self, claims: Sequence[Claim]) -> None:
        """Proofs for any number; short runs in one world; harder proofs of what is open; longer runs."""
        worlds = small_worlds(self.model, self.request.profile)
        if any(c.kind != "sometimes" for c in claims):
            self._prove_all()
        if self.request.profile is not None:
            self._reach(claims, worlds)
        self._look(claims, worlds[:1], FIRST_LOOK)
        self._prove_harder(claims, self._open(claims))
        self._look(claims, worlds, SECOND_LOOK)
        self._prove_harder(claims, self.model.always)
        self._look(claims, worlds, LONG_LOOK, few=False)
        self._tell("looking for shorter counterexamples")
        self.explorer.shorten([c for c in claims if c.kind != "sometimes"], worlds, states=FIRST_LOOK)

    def _prove_all(self) -> None:
        """Every claim of the model, whichever are asked for: they strengthen each other."""
        self._tell("proving by induction")
        self.proofs.attempt([c for c in self.model.claims if c.kind != "sometimes"])

    def _prove_harder(self, claims: Sequence[Claim], sources: Sequence[Claim]) -> None:
        left = [] if self.request.over else self._open(claims)
        if left:
            self._tell(f"harder proofs, {len(left)} properties open")
        if left and not self.proofs.proved:
            self._prove_all()
        self.proofs.sharpen([c for c in left if c.kind != "sometimes"], sources)
        self.refuted |= {c.name for c in left if c.kind == "sometimes" and self.proofs.refute(c)}

    def _look(self, claims: Sequence[Claim], worlds: Sequence[World], states: int, few: bool = True) -> None:
        wanted = [c for c in self._open(claims) if c.kind == "sometimes" or not self.request.unbounded]
        if wanted:
            self.explorer.explore(wanted, worlds, states=states, few=few)

    def _reach(self, claims: Sequence[Claim], worlds: Sequence[World]) -> None:
        """Witnesses under a profile: with all that it predefines, worlds are too large for other searches."""
        for number, states in enumerate(FAR_LOOKS):
            for world in worlds:
                wanted = [c for c in self._open(claims) if c.kind == "sometimes"]
                self.explorer.reach(wanted, world, states=states, together=number == 0)
            if number == 0:  # what is near, and yet shows nothing new
                self._look([c for c in claims if c.kind == "sometimes"], worlds[:1], NEAR_LOOK)

    def _open(self, claims: Sequence[Claim]) -> list[Claim]:
        settled = self.proofs.proved | self.explorer.runs.keys() | self.refuted
        return [claim for claim in claims if claim.name not in settled]

    def _tell(self, what: str) -> None:
        if self.progress:
            self.progress(f"{self.model.name}: {what}")

    def coverage(self) -> Iterator[str]:
        """Gaps and overlaps of the rows, where the whole model is checked for any number of elements."""
        if self.request.over:
            yield "the time limit was reached: what is open was not looked into further"
        elif self.request.sizes is None and not self.request.properties:
            yield from verdicts.told(Coverage(self.model, self.proofs.invariants))

    def _seconds(self, name: str) -> float:
        """What a claim took, with its share of what was proved beside the claims that are asked for."""
        asked = {claim.name for claim in self.asked}
        beside = sum(seconds for other, seconds in self.proofs.seconds.items() if other not in asked)
        own = self.proofs.seconds.get(name, 0.0) + self.explorer.seconds.get(name, 0.0)
        return own + beside / len(asked)

    def verdict(self, claim: Claim) -> Verdict:
        """What is known of a claim now."""
        name = claim.name
        seconds = self._seconds(name)
        searches = self.explorer.searches.get(name, [])
        if name in self.explorer.runs:
            return verdicts.by_run(claim, self.explorer.runs[name], seconds)
        if searches and searches[-1].exhausted and self.request.sizes is not None:
            return verdicts.by_search(claim, searches[-1], seconds)
        if name in self.proofs.proved:
            return verdicts.by_proof(self.model, claim, seconds)
        if name in self.refuted:
            return verdicts.out_of_reach(self.model, claim, seconds)
        if self.request.sizes is not None and searches:
            return verdicts.by_search(claim, searches[-1], seconds)
        return verdicts.undecided(self.model, claim, self.proofs.obstacles.get(name, []), searches, seconds)
