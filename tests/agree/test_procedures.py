"""The rows derived from a procedure do what its steps do when taken one by one, loops and all."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import permutations
from typing import Any

from hypothesis import HealthCheck, given, settings
from random_models import procedures

from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Moment, holds, successors, updated
from mmsverify.model import MINUS, PLUS, Clause, ModelData, On, Procedure, Row
from mmsverify.model.declare import Assign
from mmsverify.model.expr import refs_of
from mmsverify.model.steps import Accept, Do, ForEach, Refuse, Step

State = dict[Any, Any]
Outcome = tuple[str, frozenset[Any]]


class Run:
    """A procedure executed step by step, with every free choice and every order of a loop."""

    def __init__(self, procedure: Procedure, scope: Scope, bindings: dict[str, Any]) -> None:
        self.procedure, self.scope, self.bindings = procedure, scope, bindings

    def outcomes(self, state: State, steps: tuple[Step, ...]) -> Iterator[Outcome]:
        """The answers that can be given, each with the state after it."""
        first, rest = steps[0], steps[1:]
        match first:
            case Refuse(condition=condition, then=then):
                if self.true(condition, state):
                    yield self.end(MINUS, state, (*then, *self.procedure.on_refusal))
                else:
                    yield from self.outcomes(state, rest)
            case Accept(condition=condition):
                if self.true(condition, state):
                    yield self.end(PLUS, state, ())
                else:
                    yield from self.outcomes(state, rest)
            case Do(assigns=assigns):
                for choice in self.choices(assigns):
                    yield from self.outcomes(self.made(assigns, state, choice), rest)
            case ForEach():
                for order in permutations(self.scope.values(first.element.of)):
                    yield from self.loop(first, list(order), [], state, rest)

    def loop(
        self, step: ForEach, todo: list[Any], done: list[Any], state: State, rest: tuple[Step, ...]
    ) -> Iterator[Outcome]:
        if not todo:
            yield from self.outcomes(state, rest)
            return
        at = {step.element.name: todo[0]}
        if not self.true(step.where, state, at):
            yield from self.loop(step, todo[1:], done, state, rest)
        elif self.true(step.possible, state, at):
            yield from self.loop(step, todo[1:], [*done, todo[0]], self.made(step.body, state, at), rest)
        else:
            for element in done:
                state = self.made(step.undo, state, {step.element.name: element})
            yield self.end(MINUS, state, self.procedure.on_refusal)

    def choices(self, assigns: tuple[Assign, ...]) -> list[dict[str, Any]]:
        names = {name for assign in assigns for name in refs_of(assign.where) if name.startswith("chooses_")}
        assert len(names) <= 1
        return [{name: chosen} for name in names for chosen in (False, True)] or [{}]

    def true(self, condition: Any, state: State, more: dict[str, Any] | None = None) -> bool:
        return holds(condition, Moment(self.scope, state, {**self.bindings, **(more or {})}))

    def made(self, assigns: tuple[Assign, ...], state: State, more: dict[str, Any] | None = None) -> State:
        row = Row("step", On("internal", "step"), (), assigns, "", Clause(()))
        return updated(row, Moment(self.scope, state, {**self.bindings, **(more or {})}))

    def end(self, answer: str, state: State, then: tuple[Assign, ...]) -> Outcome:
        return answer, frozenset(self.made((*then, *self.procedure.always), state).items())


@settings(deadline=None, max_examples=150, suppress_health_check=list(HealthCheck))
@given(procedures())
def test_rows_do_what_the_steps_do(situation: tuple[ModelData, Scope, Procedure]) -> None:
    model, scope, procedure = situation
    state = dict(scope.facts)
    event = [parameter.name for parameter in procedure.on.parameters]
    found: dict[tuple[Any, ...], set[Outcome]] = {}
    for row, bindings, after in successors(model, scope, state):
        if row.name == procedure.name:
            key = tuple(bindings[name] for name in event)
            found.setdefault(key, set()).add((row.answer, frozenset(after.items())))
    for bindings in scope.bindings(Row("event", procedure.on, (), (), "", Clause(()))):
        run = Run(procedure, scope, bindings)
        expected = set(run.outcomes(state, procedure.steps))
        assert found.get(tuple(bindings[name] for name in event), set()) == expected
