"""A belief is never less than the truth: whatever a model may do, unseen steps included, is never blamed.

Random small models run by the judge, a random part of the run shown to a belief that starts with all or with
little.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random
from typing import Any

from conversations import Conversation, run
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from random_models import Hand, World, body, condition, model_of, scope_of, updates

from mmsverify.concrete import Scope
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.evaluate import successors
from mmsverify.model import BOOL, ModelData, Observation, Transition, internal, needs, parameter, shown
from mmsverify.model.sorts import ElementSort

CALM = settings(deadline=None, max_examples=25, suppress_health_check=list(HealthCheck))
THOROUGH = settings(CALM, max_examples=1500)

Draw = Callable[[st.SearchStrategy[Any]], Any]


def windows(world: World) -> dict[str, Any]:
    """Observations of every cell: what one thing is, how two things are linked, what belongs to no thing."""
    p, q = world.things.element("p"), world.things.element("q")
    yes, tone = parameter("yes", BOOL), parameter("tone", world.colour.value_sort)
    high = parameter("high", world.count.value_sort)
    return {
        "thing": Observation("X-5", on=shown("thing", p, yes, tone, high), shows=[
            needs("X-5", that=world.mark[p] == yes), needs("X-5", that=world.colour[p] == tone),
            needs("X-5", that=world.level[p] == high)]),
        "tie": Observation("X-6", on=shown("tie", p, q, yes), shows=[
            needs("X-6", that=world.link[p, q] == yes)]),
        "whole": Observation("X-7", on=shown("whole", yes, high), shows=[
            needs("X-7", that=world.flag() == yes), needs("X-7", that=world.count() == high)]),
    }  # fmt: skip


def unseen(draw: Draw, world: World, number: int) -> Transition:
    """A row that no message shows; beliefs ask for parameters that are given."""
    hand = Hand(world, [world.things.element("p")])
    if draw(st.booleans()):
        hand.flags.append(parameter("f", BOOL))
    if draw(st.booleans()):
        hand.sets.append(world.things.some("s"))
    return Transition(
        f"X-1{number}", on=internal(f"act{number}", *hand.elements, *hand.flags, *hand.sets),
        when=[condition(draw, hand, 1) for _ in range(draw(st.integers(0, 2)))], then=updates(draw, hand),
    )  # fmt: skip


@st.composite
def worlds(draw: Draw, unseen_rows: int) -> tuple[ModelData, Scope]:
    """A random model with windows on its state, and a scope with one initial state."""
    world = World.new()
    names = body(draw, world)
    del names["act"]
    for number in range(unseen_rows):
        names[f"act{number}"] = unseen(draw, world, number)
    model = model_of({**names, **windows(world)})
    return model, scope_of(draw, model)


class Story(Conversation):
    """A run with two requests at a time; each unseen row acts once on the same things."""

    acted: set[tuple[Any, ...]]

    def unseen(self) -> None:
        """Something happens that no message shows, for the first time with these names."""
        before = self.state
        for row in self.rows("internal"):
            taken = self.take([row], {})
            if taken is None:
                continue
            named = tuple(
                taken[1][p.name] for p in row.parameters if isinstance(p.of, ElementSort) and p.name == "p"
            )
            if (row.name, named) in self.acted:
                self.state = before
                continue
            self.acted.add((row.name, named))
            self.told.append(f"  happened {row.name} {taken[1]}")
            return

    def request(self) -> None:
        for slot in ("r1", "r2"):
            if slot not in self.pending:
                self.ask(slot, "serve", self.arguments("serve", {}))
                return

    def serve(self) -> None:
        for slot, request in self.pending.items():
            if request.performed is None:
                self.perform(slot)
                return

    def respond(self) -> None:
        if self.pending:
            slot = self.random.choice(sorted(self.pending))
            if self.pending[slot].performed is not None:
                self.answer(slot)

    def show(self) -> None:
        """One of the windows shows what is."""
        p, q = (self.random.choice(self.scope.elements["T"]) for _ in "pq")
        at = self.state
        window = self.random.choice(("thing", "tie", "whole"))
        if window == "thing":
            self.look(
                window,
                {"p": p, "yes": at["mark", (p,)], "tone": at["colour", (p,)], "high": at["level", (p,)]},
            )
        elif window == "tie":
            self.look(window, {"p": p, "q": q, "yes": at["link", (p, q)]})
        else:
            self.look(window, {"yes": at["flag", ()], "high": at["count", ()]})

    def show_everything(self) -> None:
        for _ in range(12):
            self.show()


def story(model: ModelData, scope: Scope, seed: int, known: bool) -> Story:
    """A run at its beginning. A belief that knows little knows what never changes."""
    facts = {k: v for k, v in scope.facts.items() if known or model.signatures[k[0]].rigid}
    made = Story(model, scope, dict(scope.facts), Belief(model, facts), Random(seed))
    made.acted = set()
    return made


def accusations(made: Story, steps: int) -> str:
    run(made, steps, [made.request, made.serve, made.respond, made.unseen, made.show])
    if not made.blames:
        made.show_everything()
    return made.verdict()


@CALM
@given(worlds(unseen_rows=2), st.integers(0, 2**32), st.booleans())
def test_nothing_that_a_model_does_is_blamed(
    situation: tuple[ModelData, Scope], seed: int, known: bool
) -> None:
    assert accusations(story(*situation, seed, known), 16) == ""


def possible_answers(model: ModelData, scope: Scope, asked: dict[str, Any]) -> set[str]:
    """The answers that some row gives to a request in the initial state."""
    return {
        row.answer
        for row, bindings, _ in successors(model, scope, dict(scope.facts))
        if row.on.phase == "response" and all(bindings[name] == given for name, given in asked.items())
    }


@CALM
@given(worlds(unseen_rows=0), st.integers(0, 2**32))
def test_where_all_is_known_every_possible_answer_is_believed(
    situation: tuple[ModelData, Scope], seed: int
) -> None:
    model, scope = situation
    made = story(model, scope, seed, known=True)
    asked = made.arguments("serve", {})
    for answer in sorted(possible_answers(model, scope, asked)):
        belief = story(model, scope, seed, known=True).belief
        belief.indicate("r1", "serve", asked)
        blame = belief.respond("r1", "serve", asked, answer).blame
        assert blame is None, (asked, answer, blame)
