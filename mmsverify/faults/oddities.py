"""What a text says in vain, twice, or not at all.

Dead steps, transitions that nothing produces, overlaps, gaps, choices.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from mmsverify.checking.proofs import Proofs
from mmsverify.checking.verdicts import statement
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.results import Oddity
from mmsverify.symbolic.overlap import Coverage
from mmsverify.symbolic.suspects import Suspects


def oddities(
    model: ModelData, claims: Sequence[Claim], proofs: Proofs, suspects: Suspects
) -> Iterator[Oddity]:
    """All of them, those that are proved first."""
    coverage = Coverage(model, proofs.invariants)
    yield from chain(
        _unreachable(claims, proofs),
        _dead(suspects),
        _overlaps(coverage, model),
        _unanswered(coverage, model),
        _declared(model),
        _choices(model),
    )


def _unreachable(claims: Sequence[Claim], proofs: Proofs) -> Iterator[Oddity]:
    for claim in claims:
        if claim.kind == "sometimes" and proofs.refute(claim):
            yield Oddity(
                "unreachable", claim.title, claim.clause.ids,
                f"No run ever comes to it: {statement(claim) or 'what the property asks for'}.",
            )  # fmt: skip


def _dead(suspects: Suspects) -> Iterator[Oddity]:
    for row in suspects.never_taken():
        what = (
            f"This way to {row.answer or 'happen'} is open in no state that the procedures can bring about."
        )
        yield Oddity("unreachable", row.id, row.clause.ids, what)


def _overlaps(coverage: Coverage, model: ModelData) -> Iterator[Oddity]:
    rows = {row.id: row for row in model.actions}
    for overlap in coverage.overlaps():
        left, right = (rows[name] for name in overlap.rows)
        if left.answer != right.answer or left.name != right.name:
            both = tuple(dict.fromkeys(left.clause.ids + right.clause.ids))
            apart = " and ".join(f"{row.id} ({row.answer})" for row in (left, right))
            what = f"{overlap.event}: {apart} both apply in some state."
            yield Oddity("contradiction", f"{left.id} and {right.id}", both, what)


def _unanswered(coverage: Coverage, model: ModelData) -> Iterator[Oddity]:
    for gap in coverage.gaps():
        ids = tuple(
            dict.fromkeys(i for row in model.actions if str(row.on) == gap.event for i in row.clause.ids)
        )
        how = "no row answers it in some state" if gap.proved else "it may be that no row answers it"
        yield Oddity("gap", gap.event, ids, f"{how[:1].upper()}{how[1:]}.")


def _declared(model: ModelData) -> Iterator[Oddity]:
    for gap in model.gaps:
        yield Oddity("gap", gap.name, gap.clause.ids, f"{gap.says[:1].upper()}{gap.says[1:]}.")


def _choices(model: ModelData) -> Iterator[Oddity]:
    """Free choices of the responder: two conforming robots may differ here."""
    seen: set[tuple[str, str]] = set()
    for row in model.actions:
        for choice in row.choices:
            if choice.name.startswith("chooses_") and (row.name, choice.name) not in seen:
                seen.add((row.name, choice.name))
                label = choice.name.removeprefix("chooses_")
                yield Oddity(
                    "choice", f"{row.name}, step {label}", row.clause.ids,
                    "The text says 'may': one robot does it, another does not, and both conform.",
                )  # fmt: skip
