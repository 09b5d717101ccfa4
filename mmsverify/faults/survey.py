"""The survey of a text: broken properties with their shortest runs, dead steps, choices and gaps."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from mmsverify.checking.proofs import Proofs
from mmsverify.checking.request import Progress, Request
from mmsverify.checking.runs import Explorer, Run
from mmsverify.checking.verdicts import statement
from mmsverify.checking.worlds import small_worlds
from mmsverify.faults.mendings import Mended
from mmsverify.faults.oddities import oddities
from mmsverify.faults.pairs import Pair, pairs
from mmsverify.model import expr as ex
from mmsverify.model.load import load, load_variants
from mmsverify.model.model import ModelData, assemble
from mmsverify.model.rows import Claim
from mmsverify.resources import models_dir
from mmsverify.results import Breach, Fault, Survey
from mmsverify.symbolic.suspects import Suspects

STATES = 60_000
"""States to see in each small world while runs are looked for."""


def find_faults(name: str, *, variant: str = "as-written", progress: Progress = None) -> Survey:
    """Hold every property of a model against every procedure; a model by name or path.

    The properties are those of the variant and those that other variants add, where it can state them.
    """
    model = load(name, models_dir(), variant)
    variants = load_variants(name, models_dir())
    others = [assemble(each) for stated, each in variants.items() if stated != variant]
    return _Survey(model, others, progress).survey()


class _Survey:
    def __init__(self, model: ModelData, others: Sequence[ModelData], progress: Progress) -> None:
        self.model, self.progress = model, progress
        self.mended = [Mended(other) for other in others]
        self.claims = [*model.claims, *_added(model, others)]
        self.proofs = Proofs(model)

    def survey(self) -> Survey:
        self._tell("proving what holds")
        lasting = [claim for claim in self.claims if claim.kind != "sometimes"]
        self.proofs.prove(lasting)
        suspects = Suspects(self.model, self.proofs.invariants)
        open_claims = [c for c in lasting if c.name not in self.proofs.proved]
        asked = [pair for c in open_claims for pair in pairs(self.model, c, suspects.breakers(c))]
        runs = self._runs([pair.question for pair in asked])
        faults = tuple(self._faults(open_claims, asked, runs))
        return Survey(
            self.model.name, self.model.variant, self.model.standard, len(lasting),
            len({row.name for row in self.model.actions}), faults,
            tuple(oddities(self.model, self.claims, self.proofs, suspects)),
        )  # fmt: skip

    def _runs(self, questions: Sequence[Claim]) -> dict[str, Run]:
        explorer = Explorer(self.model, Request(), self.progress)
        explorer.explore(questions, small_worlds(self.model, None), states=STATES)
        return explorer.runs

    def _faults(
        self, claims: Sequence[Claim], asked: Sequence[Pair], runs: dict[str, Run]
    ) -> Iterator[Fault]:
        for claim in claims:
            mine = [pair for pair in asked if pair.claim is claim]
            found = [pair for pair in mine if pair.question.name in runs]
            if not found:
                continue
            left = {pair.procedure for pair in mine} - {pair.procedure for pair in found}
            yield self._fault(claim, [(pair, runs[pair.question.name]) for pair in found], left)

    def _fault(self, claim: Claim, found: Sequence[tuple[Pair, Run]], left: Iterable[str]) -> Fault:
        found = sorted(found, key=lambda each: (each[1].length, each[0].procedure, each[0].change))
        return Fault(
            name=claim.title,
            statement=statement(claim),
            clauses=claim.clause.ids + claim.clause.readings,
            consequence=self.model.options.get("consequences", {}).get(claim.name, ""),
            breaches=tuple(_breach(pair, run) for pair, run in found),
            open=tuple(sorted(left)),
            mendings=tuple(m for o in self.mended for m in o.mendings(claim, [run for _, run in found])),
            mended="; ".join(other.outcome(claim) for other in self.mended),
        )

    def _tell(self, what: str) -> None:
        if self.progress:
            self.progress(f"{self.model.name}: {what}")


def _added(model: ModelData, others: Sequence[ModelData]) -> Iterator[Claim]:
    """The claims that only another variant states, as far as this one has their variables."""
    known = {claim.name for claim in model.claims}
    for other in others:
        for claim in other.claims:
            reads = ex.variables_of(claim.formula)
            if claim.name not in known and claim.kind != "sometimes" and reads <= model.signatures.keys():
                known.add(claim.name)
                yield claim


def _breach(pair: Pair, run: Run) -> Breach:
    return Breach(pair.procedure, pair.change, ", ".join(_predefined(run)), run.steps)


def _predefined(run: Run) -> Iterator[str]:
    """What exists at power-on in the world of a run, where the model has a relation for that."""
    for (variable, args), held in sorted(run.facts.items(), key=str):
        if variable == "predefined" and held is True:
            kind = run.facts.get(("predefined_control", args))
            yield f"{args[0]} ({kind})" if kind is not None else args[0]
