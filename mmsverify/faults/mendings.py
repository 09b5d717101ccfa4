"""How another variant mends a fault: the declarations that differ, and what is proved there."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.checking.proofs import Proofs
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.results import Breach, Mending


class Mended:
    """One variant that mends another: its repairs by declaration, and what is proved of its claims."""

    def __init__(self, model: ModelData) -> None:
        self.model = model
        self._stated = {claim.name for claim in model.claims}
        proofs = Proofs(model)
        proofs.prove([claim for claim in model.claims if claim.kind != "sometimes"])
        self._proved = proofs.proved

    def mendings(self, claim: Claim, breaches: Sequence[Breach]) -> Iterator[Mending]:
        """The repairs of the procedures that break the claim, and of the claim where it differs."""
        for name in dict.fromkeys([claim.name, *(breach.procedure for breach in breaches)]):
            repair = self.model.repairs.get(name)
            if repair is not None:
                yield Mending(name, ", ".join(repair.mends.readings), repair.mends.ids, repair.because)

    def outcome(self, claim: Claim) -> str:
        """What is known of the claim in this variant."""
        if claim.name not in self._stated:
            return f"not claimed in {self.model.variant}"
        if claim.name in self._proved:
            return f"proved in {self.model.variant}, for any number of elements"
        return f"not proved in {self.model.variant}"
