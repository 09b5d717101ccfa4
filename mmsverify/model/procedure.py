"""Declared rows: what a class body writes. A procedure's rows are derived from its printed steps.

One accepting row for each way to result(+), one refusing row for each step that refuses, each with the
effects of the steps before it: whether a refusal can leave a half-done effect is a question for the checker.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign, Declared, On
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.place import caller, mistake
from mmsverify.model.rewrite import bind, substitute
from mmsverify.model.rows import MINUS, PLUS, SHOWN, Clause, Conjunct, Level, Repair, Row, after
from mmsverify.model.sorts import ElementSort
from mmsverify.model.steps import Accept, Do, ForEach, Refuse, Step, check_distinct, cited
from mmsverify.model.terms import Element, SetOf, Term, formula


def repaired(reading: str, *mends: str, because: str) -> Repair:
    """The reason for a replaced or added row: its reading, the clauses that it mends, one sentence why."""
    if not mends or not because:
        raise mistake(
            f"the repair {reading} names no clause or no reason",
            "write repaired('RP-..', 'R-...', because='...')",
        )
    return Repair(Clause.of(reading, *mends), because)


class RowSource(Declared):
    """A declaration that becomes rows of the model."""

    repairs: Repair | None = None

    def rows(self) -> Iterator[Row]:
        """The rows of this declaration."""
        raise NotImplementedError


def needs(*cites: str, says: str = "", rule: str = "", level: Level = "error", that: object) -> Conjunct:
    """One guard conjunct with the clause that demands it."""
    return Conjunct(formula(that), Clause.of(*cites), rule, says, level)


class Transition(RowSource):
    """One row: on an event, when all conditions hold, make the updates. ``clauses`` are what it encodes."""

    def __init__(
        self,
        *clauses: str,
        on: On,
        when: Sequence[Term | Conjunct] = (),
        then: Sequence[Assign] = (),
        answer: str = "",
        observation_only: bool = False,
        never_after: Sequence[str] = (),
        repairs: Repair | None = None,
    ) -> None:
        self.place = caller()
        if not clauses:
            raise mistake(
                "a row without a clause",
                "cite the statement that it encodes: Transition('R-...', ...)",
                self.place,
            )
        check_distinct(then, self.place)
        self.clause = Clause.of(*clauses)
        self.on, self.answer, self.never_after = on, answer, tuple(never_after)
        self.then = tuple(_cited(assign, self.clause) for assign in then)
        self.guard = tuple(c if isinstance(c, Conjunct) else Conjunct(formula(c), self.clause) for c in when)
        self.observation_only = observation_only
        self.repairs = repairs

    def rows(self) -> Iterator[Row]:
        explains: Literal["any", "observation"] = "observation" if self.observation_only else "any"
        yield Row(
            self.name, self.on, self.guard, self.then, self.answer, self.clause,
            explains=explains, never_after=self.never_after, place=self.place,
        )  # fmt: skip


class Observation(RowSource):
    """What a message shows: conditions on the state at some instant between request and response."""

    def __init__(
        self, *clauses: str, on: On, shows: Sequence[Conjunct], repairs: Repair | None = None
    ) -> None:
        self.place = caller()
        if not clauses:
            raise mistake("an observation without a clause", "cite the statement that it encodes", self.place)
        self.clause, self.on, self.shows, self.repairs = Clause.of(*clauses), on, tuple(shows), repairs

    def rows(self) -> Iterator[Row]:
        yield Row(self.name, self.on, self.shows, (), SHOWN, self.clause, place=self.place)


class Procedure(RowSource):
    """The ordered steps of a service procedure; ``clause`` is the prefix that the printed labels extend.

    ``always`` are updates of every outcome (forgetting the request), ``on_refusal`` those of every result(-)
    (going back from a transient state). Both read the state that the steps have left.
    """

    def __init__(
        self,
        clause: str = "",
        *,
        on: On,
        steps: Sequence[Step],
        always: Sequence[Assign] = (),
        on_refusal: Sequence[Assign] = (),
        repairs: Repair | None = None,
    ) -> None:
        self.place = caller()
        if not clause:
            raise mistake("a row without a clause", "give the clause of the procedure", self.place)
        if not any(isinstance(step, Accept) for step in steps):
            raise mistake("a procedure that never accepts", "end the steps with accept('m')", self.place)
        self.clause, self.on, self.steps, self.repairs = clause, on, tuple(steps), repairs
        self.always, self.on_refusal = tuple(always), tuple(on_refusal)

    def rows(self) -> Iterator[Row]:
        run = _Run(self)
        for step in self.steps:
            yield from run.take(step)


@dataclass(slots=True)
class _Run:
    """The symbolic run of a procedure: conditions passed and effects made so far, over the first state."""

    source: Procedure
    passed: tuple[Conjunct, ...] = ()
    made: tuple[Assign, ...] = ()
    choices: tuple[Ref | SetOf, ...] = ()
    clause: Clause = field(default_factory=lambda: Clause(()))
    labels: dict[str, int] = field(default_factory=dict)

    def take(self, step: Step) -> Iterator[Row]:
        self.clause = self.clause + cited(self.source.clause, step)
        match step:
            case Refuse():
                yield from self._refuse(step)
            case Do():
                self._do(step.assigns, cited(self.source.clause, step))
            case Accept():
                yield from self._accept(step)
            case ForEach():
                yield from self._for_each(step)

    def now(self, condition: Expr) -> Expr:
        """A condition on the present state as one over the state at the start."""
        return after(condition, self.made)

    def _conjunct(self, step: Refuse | Accept | ForEach, condition: Expr) -> Conjunct:
        own = cited(self.source.clause, step)
        if isinstance(step, Accept):
            return Conjunct(condition, own)
        rule = step.rule or f"{self.source.name}.{step.label}".lower()
        level = step.level if isinstance(step, Refuse) else "error"
        return Conjunct(condition, own, rule, step.says, level)

    def _row(
        self, step: Step, answer: str, more: tuple[Conjunct, ...] = (), then: tuple[Assign, ...] = ()
    ) -> Row:
        last = (*then, *(self.source.on_refusal if answer == MINUS else ()), *self.source.always)
        own = cited(self.source.clause, step) if answer == MINUS else self.clause
        assigns = self.made + self._over_start(last)
        return Row(
            self.source.name, self.source.on, self.passed + more, assigns, answer, own,
            choices=self.choices, step=self._label(step), place=step.place,
        )  # fmt: skip

    def _label(self, step: Step) -> str:
        """The printed label, numbered where several refusals share it."""
        seen = self.labels[step.label] = self.labels.get(step.label, 0) + 1
        return step.label if seen == 1 else f"{step.label}#{seen}"

    def _over_start(self, assigns: Sequence[Assign]) -> tuple[Assign, ...]:
        return tuple(
            replace(a, args=tuple(map(self.now, a.args)), value=self.now(a.value), where=self.now(a.where))
            for a in assigns
        )

    def _refuse(self, step: Refuse) -> Iterator[Row]:
        condition = self.now(step.condition)
        yield self._row(step, MINUS, (self._conjunct(step, condition),), step.then)
        self.passed += (self._conjunct(step, ex.negation(condition)),)

    def _do(self, assigns: Sequence[Assign], clause: Clause) -> None:
        for assign in assigns:
            for name, ref in ex.refs_of(assign.where).items():
                if name.startswith("chooses_") and ref not in self.choices:
                    self.choices += (ref,)
        self.made += self._over_start([_cited(assign, clause) for assign in assigns])

    def _accept(self, step: Accept) -> Iterator[Row]:
        condition = self.now(step.condition)
        yield self._row(step, PLUS, () if condition == ex.TRUE else (self._conjunct(step, condition),))
        self.passed += (self._conjunct(step, ex.negation(condition)),)

    def _for_each(self, step: ForEach) -> Iterator[Row]:
        """Two rows in place of a loop: it fails on ``bad`` after handling ``done``, or it handles all."""
        sort = step.element.of
        assert isinstance(sort, ElementSort)
        bad, done = Element(Ref(f"bad_{step.label}", sort)), SetOf(f"done_{step.label}", sort)
        saved = self.choices, self.made
        self.choices += (bad.ref, done)
        failure = self._conjunct(step, self._fails(step, bad, done))
        self.made += self._over_start(self._half_done(step, done))
        yield self._row(step, MINUS, (failure,))
        self.choices, self.made = saved
        everywhere = bind(True, (step.element,), ex.disjunction(ex.negation(step.where), step.possible))
        self.passed += (self._conjunct(step, self.now(everywhere)),)
        handled = tuple(_over(assign, step.element, step.where) for assign in step.body)
        self._do(handled, cited(self.source.clause, step))

    def _fails(self, step: ForEach, bad: Element, done: SetOf) -> Expr:
        at_bad = substitute(
            ex.conjunction(step.where, ex.negation(step.possible)), {step.element.name: bad.expr}
        )
        inside = ex.Member(done.name, step.element)
        handled = ex.disjunction(ex.negation(inside), ex.conjunction(step.where, step.possible))
        return self.now(ex.conjunction(at_bad, bind(True, (step.element,), handled)))

    def _half_done(self, step: ForEach, done: SetOf) -> tuple[Assign, ...]:
        inside = ex.Member(done.name, step.element)
        first = tuple(_over(assign, step.element, inside) for assign in step.body)
        return first + tuple(
            replace(a, where=after(a.where, first), value=after(a.value, first))
            for a in (_over(assign, step.element, inside) for assign in step.undo)
        )


def _cited(assign: Assign, clause: Clause) -> Assign:
    return replace(assign, clauses=clause.ids, readings=clause.readings)


def _over(assign: Assign, element: Ref, where: Expr) -> Assign:
    return replace(assign, where=ex.conjunction(where, assign.where)).over(Element(element))
