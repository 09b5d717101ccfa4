"""Declared claims: what must hold of every state, of some reachable state, of every step.

Beside them: conditions on the start, assumptions on what never changes, and what the text leaves open.
"""

from __future__ import annotations

from typing import Literal

from mmsverify.model import expr as ex
from mmsverify.model.declare import Declared
from mmsverify.model.expr import Expr
from mmsverify.model.place import caller, mistake
from mmsverify.model.rows import Claim, Clause, Conjunct, Gap, Repair
from mmsverify.model.terms import Term, formula


def _stated(what: str, source: Declared, clause: object, condition: Term | bool | None) -> Expr:
    """The formula of a declaration that needs a clause and a formula, in this order."""
    cure = f"write {type(source).__name__}('R-...', formula)"
    if not isinstance(clause, str) or not clause:
        raise mistake(f"{what} without a clause", cure, source.place)
    if condition is None:
        raise mistake(f"{what} without a formula", cure, source.place)
    return formula(condition)


class ClaimSource(Declared):
    """A declaration that becomes a claim."""

    kind: Literal["always", "sometimes", "step"]
    provided: Expr = ex.TRUE

    def __init__(
        self,
        clause: str,
        condition: Term | bool | None = None,
        *cites: str,
        says: str = "",
        repairs: Repair | None = None,
    ) -> None:
        self.place = caller()
        self.formula = _stated("a claim", self, clause, condition)
        self.clause = Clause.of(clause, *cites)
        self.says = says
        self.repairs = repairs
        if self.kind == "always" and ex.reads_next(self.formula):
            raise mistake("'.next' in an Always claim", "state it as Step(clause, ...)", self.place)

    def claim(self) -> Claim:
        """The claim as plain data."""
        return Claim(
            self.name,
            self.kind,
            self.clause,
            self.formula,
            self.says,
            provided=self.provided,
            place=self.place,
        )


class Always(ClaimSource):
    """Holds in every reachable state."""

    kind = "always"


class Sometimes(ClaimSource):
    """Holds in some reachable state, or (where it speaks of ``.next``) of some step.

    It stands beside every ``Always``, so that no proof is vacuous. ``provided`` says of which profiles it is
    claimed, where the text excepts some.
    """

    kind = "sometimes"

    def __init__(
        self,
        clause: str,
        condition: Term | bool | None = None,
        *cites: str,
        says: str = "",
        provided: Term | bool = True,
        repairs: Repair | None = None,
    ) -> None:
        super().__init__(clause, condition, *cites, says=says, repairs=repairs)
        self.place = caller()
        self.provided = formula(provided)


class Step(ClaimSource):
    """Holds of every step: a formula over ``x`` and ``x.next``.

    ``service_is`` and ``answered`` restrict it to the rows of some services or answers.
    """

    kind = "step"


class Initially(Declared):
    """A condition on the state at power-on."""

    def __init__(
        self, clause: str, condition: Term | bool | None = None, *cites: str, repairs: Repair | None = None
    ) -> None:
        self.place = caller()
        stated = _stated("a condition", self, clause, condition)
        self.conjunct = Conjunct(stated, Clause.of(clause, *cites))
        self.repairs = repairs


class Assume(Declared):
    """A fact about what never changes (``rigid`` variables): what a profile must respect."""

    def __init__(
        self, clause: str, condition: Term | bool | None = None, *cites: str, repairs: Repair | None = None
    ) -> None:
        self.place = caller()
        stated = _stated("a condition", self, clause, condition)
        self.conjunct = Conjunct(stated, Clause.of(clause, *cites))
        self.repairs = repairs


class Unspecified(Declared):
    """An event in states for which the text gives no rule; declared, so that the gap is known."""

    def __init__(self, clause: str, says: str, *cites: str) -> None:
        self.place = caller()
        self.repairs: Repair | None = None
        self.clause, self.says = Clause.of(clause, *cites), says

    def gap(self) -> Gap:
        """The gap as plain data."""
        return Gap(self.name, self.clause, self.says)


class Removed(Declared):
    """A row or claim of the text that a variant drops, with the reason."""

    def __init__(self, *, repairs: Repair) -> None:
        self.place = caller()
        self.repairs = repairs
