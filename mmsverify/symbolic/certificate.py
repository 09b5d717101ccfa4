"""Proofs as SMT-LIB 2 scripts that any solver can check again: one for each thing that the proof rests on.

An inductive proof rests on this: every invariant holds at the start; every row, taken where all invariants
hold, leads to where those hold again that it may touch, and breaks no claim about steps. Each script asks
for a state in which that fails; ``unsat`` says that there is none. The scripts are written from the rows
and from nothing else.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import z3

from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim
from mmsverify.symbolic.induction import may_break
from mmsverify.symbolic.translate import Translator, obligation

SOLVED = "unsat"
_PLAIN = {ex.BOUND: "!bound", "·": "!each", "'": "!other"}


@dataclass(frozen=True, slots=True)
class Certificate:
    """One script: what it is about (``start`` or the id of a row), the claims it is for, the text."""

    about: str
    claims: tuple[str, ...]
    script: str


def certificates(model: ModelData, proved: Sequence[Claim]) -> Iterator[Certificate]:
    """The scripts for claims that are proved together; ``proved`` must hold all that the proof used."""
    invariants = [claim for claim in proved if claim.kind == "always"]
    base = [c.condition for c in model.assumptions]
    start = [*base, *(c.condition for c in model.initial)]
    yield _certificate(model, "start", invariants, start, [c.formula for c in invariants])
    known = [*base, *(c.formula for c in invariants)]
    for row in model.actions:
        touched = [claim for claim in proved if may_break(row, claim)]
        goals = [obligation(claim, row) for claim in touched]
        if ex.conjunction(*goals) != ex.TRUE:
            yield _certificate(model, row.id, touched, [*known, row.guard_formula], goals)


def _certificate(
    model: ModelData, about: str, claims: Sequence[Claim], given: Sequence[Expr], goals: Sequence[Expr]
) -> Certificate:
    translator = Translator(model)
    solver = z3.Solver()
    solver.add(*(translator.formula(each) for each in given), *translator.bounds())
    solver.add(z3.Not(translator.formula(ex.conjunction(*goals))))
    head = f"; {model.name}, {model.variant}: {about}; expected answer: {SOLVED}\n"
    return Certificate(about, tuple(c.title for c in claims), head + _ascii(solver.to_smt2()))


def _ascii(script: str) -> str:
    """The script with the marks of bound names spelled in ASCII, as the format wants it."""
    for mark, plain in _PLAIN.items():
        script = script.replace(mark, plain)
    return script


def reads_as(script: str) -> str:
    """What Z3 answers to a script read anew: ``unsat``, ``sat`` or ``unknown``."""
    solver = z3.Solver()
    solver.from_string(script)
    return str(solver.check())
