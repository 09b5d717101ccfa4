"""What Z3 says of mutants: whether a claim is lost, and whether anything has changed at all.

Nothing is proved anew that a change cannot touch: the other rows keep every claim, and a changed row is asked
only for those that it may break. What is asked is asked under the invariants that are proved of the real
model. Where Z3 does not know, nothing is said: such a mutant counts neither as killed nor as equal.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from functools import cached_property

import z3
from mutation import Mutant

from mmsverify.model import Claim, ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.rewrite import bind, rebuilt, substitute
from mmsverify.model.rows import after, step_formula
from mmsverify.model.sorts import BOOL, IntSort
from mmsverify.model.terms import SetOf
from mmsverify.symbolic.allowed import Allowed
from mmsverify.symbolic.induction import may_break
from mmsverify.symbolic.translate import obligation

LOCAL = frozenset({"prevented"})
"""Parameters of a robot's answers that stand for local conditions, of which no message tells."""
NEGATED, STRICTER = "claim negated", "condition of a claim dropped"


class Judge:
    """Asks of mutants of one model, given all that is proved of it.

    ``untold``: parameters of answers that nothing recorded tells.
    """

    def __init__(self, model: ModelData, *, seconds: float = 5.0, untold: frozenset[str] = LOCAL) -> None:
        self.model = model
        self._untold = untold
        self.claims = [claim for claim in model.claims if claim.kind != "sometimes"]
        self._allowed = Allowed(model, model.always, timeout=seconds)
        self._asked: dict[tuple[object, ...], tuple[tuple[str, Expr], ...]] = {}
        self._begins = Allowed(model, (), timeout=seconds)

    # Rows.

    def lost(self, mutant: Mutant) -> str | None:
        """A claim that a changed row may break, or that nothing can bear out any more.

        Empty if there is none, ``None`` if Z3 does not know.
        """
        changed = [row for row in mutant.rows.values() if row is not None]
        answers: list[str | None] = []
        for row in changed:
            answers.append(self._lost(row))
            if answers[-1]:
                return answers[-1]
        return None if None in answers else self._starved(frozenset(mutant.rows), changed)

    def _lost(self, row: Row) -> str | None:
        goals = self._goals(row)
        answer = self._fails(row, goals) if goals else z3.unsat
        if answer == z3.unsat:
            return ""
        return self._first_lost(row, goals) if answer == z3.sat else None

    def _goals(self, row: Row) -> tuple[tuple[str, Expr], ...]:
        """What each claim asks of a row; rows that differ in their guard alone are asked the same."""
        key = row.name, row.answer, row.on, row.choices, row.assigns
        if key not in self._asked:
            goals = ((c.name, obligation(c, row)) for c in self.claims if may_break(row, c))
            self._asked[key] = tuple((name, goal) for name, goal in goals if goal != ex.TRUE)
        return self._asked[key]

    def _fails(self, row: Row, goals: Sequence[tuple[str, Expr]]) -> z3.CheckSatResult:
        whole = ex.conjunction(*(goal for _, goal in goals))
        return self._allowed.ask(row.guard_formula, ex.negation(whole))

    def _first_lost(self, row: Row, goals: Sequence[tuple[str, Expr]]) -> str | None:
        """One of the claims, of which together it is known that the row may break them."""
        if len(goals) == 1:
            return goals[0][0]
        middle = len(goals) // 2
        halves = (goals[:middle], goals[middle:])
        lost = next((half for half in halves if self._fails(row, half) == z3.sat), None)
        return None if lost is None else self._first_lost(row, lost)

    def _starved(self, numbers: frozenset[int], changed: Sequence[Row]) -> str:
        """A claim that something can happen which only these rows made happen, and the changed ones do not.

        The changed rows keep the invariants, so that what they cannot do in a state that keeps these never
        happens.
        """
        for claim, makers in self._makers.items():
            if makers and makers <= numbers and not any(self._makes(row, claim) for row in changed):
                return claim.name
        return ""

    @cached_property
    def _makers(self) -> dict[Claim, frozenset[int]]:
        """The rows by which each claimed step can happen."""
        actions = [(n, row) for n, row in enumerate(self.model.rows) if row.on.phase != "shown"]
        return {
            claim: frozenset(n for n, row in actions if self._makes(row, claim))
            for claim in self.model.claims
            if claim.kind == "sometimes" and of_a_step(claim.formula)
        }

    def _makes(self, row: Row, claim: Claim) -> bool:
        wanted = step_formula(claim.formula, row)
        return wanted != ex.FALSE and self._allowed.possible(row.guard_formula, wanted)

    def alike(self, mutant: Mutant) -> bool:
        """Whether the changed rows are proved to do what the real ones do, wherever the invariants hold.

        Rows with one answer and one effect stand for each other: which step refuses is not to be seen. So do
        rows that differ in how a free choice is called: TRUE for FALSE, a number for the next one, a set for
        what is not in it.
        """
        if mutant.occurrences:
            return False
        if self._as_real(mutant.rows):
            return True
        choices = free_choices((self.model.rows[n] for n in mutant.rows), self._untold)
        return any(self._as_real(renamed(mutant.rows, choice)) for choice in choices)

    def _as_real(self, rows: Mapping[int, Row | None]) -> bool:
        real = _outcomes(self.model.rows[n] for n in rows)
        changed = _outcomes(row for row in rows.values() if row is not None)
        if all(self._same(real.get(key), changed.get(key)) for key in {*real, *changed}):
            return True
        return all(self._alike(self.model.rows[n], row) for n, row in rows.items())

    def _same(self, real: Expr | None, changed: Expr | None) -> bool:
        mine, yours = real or ex.FALSE, changed or ex.FALSE
        return mine == yours or self._never(ex.negation(ex.equal(mine, yours)))

    def _alike(self, real: Row, changed: Row | None) -> bool:
        if changed is None:
            return self._never(real.guard_formula)
        mine, yours = real.guard_formula, changed.guard_formula
        if mine != yours and not self._never(ex.negation(ex.equal(mine, yours))):
            return False
        return real.assigns == changed.assigns or self._never(
            mine, ex.negation(same_effect(self.model, real, changed))
        )

    def _never(self, *conditions: Expr) -> bool:
        return not self._allowed.possible(*conditions)

    # Claims.

    def refuted(self, claim: Claim) -> bool | None:
        """Whether the changed claim is not proved any more: ``None`` if Z3 does not know.

        It is asked beside the real invariants, of the start and of every row.
        """
        answers = [*self._starts(claim)]
        if z3.sat in answers:
            return True
        for row in self.model.actions:
            if not _understood(claim, row):
                continue
            goal = obligation(claim, row)
            if goal != ex.TRUE and (claim.kind == "step" or may_break(row, claim)):
                conditions = [] if claim.kind == "step" else [claim.formula]
                answers.append(self._allowed.ask(*conditions, row.guard_formula, ex.negation(goal)))
                if answers[-1] == z3.sat:
                    return True
        return None if z3.unknown in answers else False

    def _starts(self, claim: Claim) -> Iterator[z3.CheckSatResult]:
        if claim.kind == "always":
            yield self._begins.ask(*(c.condition for c in self.model.initial), ex.negation(claim.formula))


def _understood(claim: Claim, row: Row) -> bool:
    """Whether the row has the things that the claim names: where they are missing, it says nothing."""
    has = {p.name: p.of for p in row.parameters}
    meant = (ref for ref in ex.refs_of(claim.formula).values() if not ref.name.endswith(ex.BOUND))
    return all(has.get(ref.name) == ref.of or (ref.of == BOOL and ref.name not in has) for ref in meant)


def _outcomes(rows: Iterable[Row]) -> dict[tuple[str, frozenset[Assign]], Expr]:
    """When each outcome (answer and effect) is possible."""
    found: dict[tuple[str, frozenset[Assign]], Expr] = {}
    for row in rows:
        key = row.answer, frozenset(row.assigns)
        found[key] = ex.disjunction(found.get(key, ex.FALSE), row.guard_formula)
    return found


def same_effect(model: ModelData, left: Row, right: Row) -> Expr:
    """Every cell that either row writes gets the same value from both."""
    return ex.conjunction(*(_same(model, name, left, right) for name in sorted(left.writes | right.writes)))


def _same(model: ModelData, name: str, left: Row, right: Row) -> Expr:
    signature = model.signatures[name]
    refs = tuple(ex.Ref(f"at{i}", sort) for i, sort in enumerate(signature.sorts))
    cell = ex.Cell(name, refs, signature.of)
    return bind(True, refs, ex.equal(after(cell, left.assigns), after(cell, right.assigns)))


def free_choices(rows: Iterable[Row], untold_names: frozenset[str]) -> Iterator[Ref | SetOf]:
    """Parameters that no message tells, of which one value may be called by another's name."""
    seen = set()
    for row in rows:
        for parameter in row.parameters:
            untold = row.on.phase == "internal" or parameter in row.choices or parameter.name in untold_names
            of = parameter.of
            plain = isinstance(parameter, Ref) and (of == BOOL or isinstance(of, IntSort))
            if untold and (plain or isinstance(parameter, SetOf)):
                seen.add(parameter)
    yield from sorted(seen, key=lambda parameter: parameter.name)


def renamed(rows: Mapping[int, Row | None], choice: Ref | SetOf) -> dict[int, Row | None]:
    """The rows with the values of a choice called otherwise, one by one."""

    def change(expr: Expr) -> Expr:
        if isinstance(choice, SetOf):
            return complemented(expr, choice.name)
        other = ex.negation(choice) if choice.of == BOOL else ex.Plus(choice, ex.Const(1, choice.of), -1)
        return substitute(expr, {choice.name: other})

    def changed(row: Row) -> Row:
        guard = tuple(replace(c, condition=change(c.condition)) for c in row.guard)
        assigns = (replace(a, value=change(a.value), where=change(a.where)) for a in row.assigns)
        return replace(row, guard=guard, assigns=tuple(assigns))

    return {number: None if row is None else changed(row) for number, row in rows.items()}


def complemented(expr: Expr, name: str) -> Expr:
    """The expression with a set that is given called by what is not in it."""
    if isinstance(expr, ex.Member) and expr.set == name:
        return ex.negation(expr)
    return rebuilt(expr, lambda part: complemented(part, name))


def of_a_step(formula: Expr) -> bool:
    """Whether a claim speaks of a step, and not of a state."""
    return ex.reads_next(formula) or any(isinstance(part, ex.RowFact) for part in ex.walk(formula))


def claim_mutants(model: ModelData) -> Iterator[tuple[str, Claim]]:
    """Each claim negated, and each with a condition less; what is then claimed is more than the text says.

    Negated, what is to happen sometimes is claimed never to happen.
    """
    for claim in model.claims:
        negated = replace(claim, formula=ex.negation(claim.formula))
        if claim.kind == "sometimes":
            yield NEGATED, replace(negated, kind="step" if of_a_step(claim.formula) else "always")
            continue
        yield NEGATED, negated
        for formula in _stricter(claim.formula):
            yield STRICTER, replace(claim, formula=formula)


def _stricter(formula: Expr) -> Iterator[Expr]:
    """The formula with one alternative less; of an implication, with one condition less."""
    match formula:
        case ex.Quantified(True, bound, body):
            yield from (ex.quantified(True, bound, made) for made in _stricter(body))
        case ex.And(parts):
            for at, part in enumerate(parts):
                for made in _stricter(part):
                    yield ex.conjunction(*parts[:at], made, *parts[at + 1 :])
        case ex.Or(parts):
            for at, part in enumerate(parts):
                for made in _less(part):
                    yield ex.disjunction(*parts[:at], made, *parts[at + 1 :])


def _less(part: Expr) -> Iterator[Expr]:
    """One alternative, made harder to meet."""
    match part:
        case ex.Not(ex.And(conditions)):
            for at in range(len(conditions)):
                yield ex.negation(ex.conjunction(*conditions[:at], *conditions[at + 1 :]))
        case _:
            yield ex.FALSE
