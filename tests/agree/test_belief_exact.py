"""Beliefs measured by the exact belief of random small models: never less, and seldom more.

A recording of a random run is told to both, sometimes with a lie in it. Where the belief blames, the exact
belief must be empty; every state that is left in the exact belief must be one that the belief can be shown.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from random import Random
from typing import Any

import pytest
from exact_belief import ExactBelief
from hypothesis import given, settings
from hypothesis import strategies as st
from test_belief_sound import CALM, THOROUGH, worlds

from mmsverify.concrete import Scope
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.evaluate import Valuation, step, within_bounds
from mmsverify.model import ModelData
from mmsverify.model.rows import MINUS, PLUS

WINDOWS = ("thing", "tie", "whole")


@dataclass
class Trial:
    """One run, told to the belief and to the exact belief; ``told`` is for whoever reads a failure."""

    model: ModelData
    scope: Scope
    random: Random
    state: dict[Any, Any]
    belief: Belief
    exact: ExactBelief
    lies: float = 0.0
    performed: dict[str, str] = field(default_factory=dict)
    told: list[str] = field(default_factory=list)
    blamed: bool = False
    missed: bool = False

    def act(self) -> bool:
        """One event or unseen step; whether the trial goes on."""
        way = self.random.choice((self.unseen, self.unseen, self.ask, self.perform, self.answer, self.show))
        return way()

    def step(self, row: Any, given: dict[str, Any]) -> bool:
        for _ in range(20):
            bindings = {
                p.name: given[p.name]
                if p.name in given
                else self.random.choice(self.scope.parameter_values(row, p))
                for p in row.parameters
            }
            after = step(row, bindings, self.state, self.scope)
            if after is not None and within_bounds(self.model, self.scope, after):
                self.state = after
                return True
        return False

    def unseen(self) -> bool:
        row = self.random.choice([r for r in self.model.rows if r.on.phase == "internal"])
        if self.step(row, {}):
            self.told.append(f"  happened {row.id}")
        return True

    def ask(self) -> bool:
        slot = f"r{len(self.exact.asked) + 1}"
        if slot not in self.exact.asked and len(self.exact.asked) < 2:
            row = next(r for r in self.model.rows if r.on.phase == "response")
            said = {
                p.name: self.random.choice(self.scope.parameter_values(row, p)) for p in row.on.parameters
            }
            self.told.append(f"asked {slot} {said}")
            self.exact.indicate(slot, "serve", said)
            self.belief.indicate(slot, "serve", said)
        return True

    def perform(self) -> bool:
        for slot, (service, said) in self.exact.asked.items():
            if slot not in self.performed:
                rows = [r for r in self.model.rows if r.on.phase == "response" and r.on.service == service]
                for row in self.random.sample(rows, len(rows)):
                    if self.step(row, dict(said)):
                        self.told.append(f"  performed {slot} {row.id}")
                        self.performed[slot] = row.answer
                        return True
        return True

    def answer(self) -> bool:
        for slot in sorted(self.performed):
            answer = self.performed.pop(slot)
            if self.random.random() < self.lies:
                answer = MINUS if answer == PLUS else PLUS
            said = self.exact.asked[slot][1]
            self.told.append(f"answered {slot} {answer}")
            return self.compare(
                self.exact.respond(slot, answer), self.belief.respond(slot, "serve", said, answer).blame
            )
        return True

    def show(self) -> bool:
        window = self.random.choice(WINDOWS)
        names = self.scope.elements["T"]
        shown = seen(window, self.state, self.random.choice(names), self.random.choice(names))
        if self.random.random() < self.lies:
            lie = self.random.choice([k for k in shown if k not in ("p", "q")])
            row = next(r for r in self.model.rows if r.on.service == window)
            parameter = next(p for p in row.on.parameters if p.name == lie)
            shown[lie] = self.random.choice(self.scope.parameter_values(row, parameter))
        self.told.append(f"shown {window} {shown}")
        return self.compare(self.exact.show(window, shown), self.belief.show(window, shown).blame)

    def compare(self, possible: bool, blame: Any) -> bool:
        """Whether both still see a way; a blame where there is one is what must never be."""
        if blame is not None and possible:
            self.blamed = True
            self.told.append(f"BLAMED {blame.rule} {blame.says} {blame.before}")
        self.missed = blame is None and not possible
        return possible and blame is None


def seen(window: str, at: Valuation, p: str, q: str) -> dict[str, Any]:
    """What a window shows of a state."""
    if window == "thing":
        return {"p": p, "yes": at["mark", (p,)], "tone": at["colour", (p,)], "high": at["level", (p,)]}
    if window == "tie":
        return {"p": p, "q": q, "yes": at["link", (p, q)]}
    return {"yes": at["flag", ()], "high": at["count", ()]}


def trial(model: ModelData, scope: Scope, seed: int, lies: float, unknown: str = "") -> Trial:
    """A trial at its beginning; both beliefs know the facts about all things but the ``unknown`` one."""
    facts = {key: value for key, value in scope.facts.items() if unknown not in key[1]}
    exact = ExactBelief(model, scope)
    exact.begin(alike(model, scope, facts))
    belief = Belief(model, facts)
    return Trial(model, scope, Random(seed), dict(scope.facts), belief, exact, lies)


def alike(model: ModelData, scope: Scope, facts: Valuation) -> list[dict[Any, Any]]:
    """The states that agree with the facts."""
    states: list[dict[Any, Any]] = [{}]
    for signature in model.signatures.values():
        for key in scope.cells(signature):
            values = (facts[key],) if key in facts else scope.values(signature.of)
            states = [{**state, key: value} for state in states for value in values]
    return states


def played(made: Trial, steps: int) -> Trial:
    """The trial after as many steps, or when it is over."""
    for _ in range(steps):
        if not made.act() or made.exact.gave_up:
            break
    return made


def unshowable(made: Trial) -> str:
    """A state of the exact belief that the belief cannot be shown, with what was told, if there is one."""
    left = sorted(made.exact.closed(), key=str)
    for sort in made.model.sorts.values():  # twins share their world: what one sees, all must have seen
        for name in made.scope.names(sort):
            made.belief.see(sort, name)
    for frozen in made.random.sample(left, min(4, len(left))):
        state = made.exact.valuation(frozen)
        belief = copied(made.belief)
        for window, p, q in everything(made.scope):
            shown = seen(window, state, p, q)
            blame = belief.show(window, shown).blame
            if blame is not None:
                return "\n".join([*made.told, f"cannot show {window} {shown} of {state}: {blame}"])
    return ""


def copied(belief: Belief) -> Belief:
    """A belief that can be told more without the other."""
    import copy

    twin = copy.copy(belief)
    twin.states = list(belief.states)
    return twin


def everything(scope: Scope) -> Any:
    """All windows on all things."""
    names = scope.elements["T"]
    yield "whole", names[0], names[0]
    for p in names:
        yield "thing", p, p
        for q in names:
            yield "tie", p, q


@settings(CALM, max_examples=8)
@given(worlds(unseen_rows=2), st.integers(0, 2**32), st.sampled_from((0.0, 0.1)))
def test_a_belief_is_never_less_than_the_exact_one(
    situation: tuple[ModelData, Scope], seed: int, lies: float
) -> None:
    never_less(played(trial(*situation, seed, lies), 14))


@pytest.mark.slow
@settings(THOROUGH, max_examples=400)
@given(worlds(unseen_rows=2), st.integers(0, 2**32), st.sampled_from((0.0, 0.1)))
def test_a_belief_is_never_less_than_the_exact_one_of_many_models(
    situation: tuple[ModelData, Scope], seed: int, lies: float
) -> None:
    never_less(played(trial(*situation, seed, lies), 20))


@pytest.mark.slow
@settings(CALM, max_examples=100)
@given(worlds(unseen_rows=1), st.integers(0, 2**32), st.sampled_from((0.0, 0.2)))
def test_a_belief_that_has_not_seen_all_things_is_never_less(
    situation: tuple[ModelData, Scope], seed: int, lies: float
) -> None:
    model, scope = situation
    never_less(played(trial(model, scope, seed, lies, unknown=scope.elements["T"][-1]), 8))


def never_less(made: Trial) -> None:
    if made.exact.gave_up:
        return
    assert not made.blamed, "\n".join(made.told)
    if made.exact.states:
        assert unshowable(made) == ""
