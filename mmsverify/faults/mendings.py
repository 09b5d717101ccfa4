"""How another variant mends a fault: the steps that keep its runs from the breach; what is proved there."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

from mmsverify.checking.proofs import Proofs
from mmsverify.checking.runs import Run
from mmsverify.faults.partings import Parting, last_parting
from mmsverify.model import expr as ex
from mmsverify.model.model import ModelData
from mmsverify.model.rows import READINGS, Claim, Clause
from mmsverify.results import Mending


class Mended:
    """One variant that mends another: its repairs by declaration, and what is proved of its claims."""

    def __init__(self, model: ModelData) -> None:
        self.model = model
        self._stated = {claim.name for claim in model.claims}
        proofs = Proofs(model)
        proofs.prove([claim for claim in model.claims if claim.kind != "sometimes"])
        self._proved = proofs.proved

    def mendings(self, claim: Claim, runs: Sequence[Run]) -> Iterator[Mending]:
        """The repair of the claim, if it is stated otherwise; then what keeps each run from the breach."""
        told = (
            [Parting(claim.name, "", Clause(()), "is stated otherwise")]
            if claim.name in self.model.repairs
            else []
        )
        watched = ex.variables_of(claim.formula)
        for run in runs:
            told += self._partings(run, watched) or self._partings(run, self.model.signatures.keys())
        for parting in {(p.declared, p.step): p for p in reversed(told)}.values():
            yield self._mending(parting)

    def _partings(self, run: Run, watched: Collection[str]) -> list[Parting]:
        return last_parting(self.model, run.world, run.path, watched)

    def _mending(self, parting: Parting) -> Mending:
        """The reading of the step where it has one of its own, else that of the declaration."""
        repair = self.model.repairs.get(parting.declared)
        readings = [r for r in parting.clause.readings if r.startswith(READINGS)]
        clauses, because = parting.clause.ids, parting.says
        if repair is not None:
            readings = readings or list(repair.mends.readings)
            clauses = clauses or repair.mends.ids
            because = because if parting.step else f"{because}: {repair.because}"
        name = f"{parting.declared}/{parting.step}" if parting.step else parting.declared
        return Mending(name, ", ".join(readings), clauses, because)

    def outcome(self, claim: Claim) -> str:
        """What is known of the claim in this variant."""
        if claim.name not in self._stated:
            return f"not claimed in {self.model.variant}"
        if claim.name in self._proved:
            return f"proved in {self.model.variant}, for any number of elements"
        return f"not proved in {self.model.variant}"
