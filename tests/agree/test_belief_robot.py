"""A robot that keeps the rules is never blamed.

Random conversations of the robot model, unseen events and all; they begin at power-on, as the belief knows.
"""

from __future__ import annotations

from functools import cache
from random import Random
from typing import Any

import pytest
from conversations import Conversation, run

from mmsverify.audit import robot
from mmsverify.checking import robot_messages
from mmsverify.concrete import Scope, scope_for
from mmsverify.concrete.belief import Belief
from mmsverify.concrete.formulas import Formulas
from mmsverify.concrete.ground import Grounding
from mmsverify.concrete.initial import initial_states
from mmsverify.concrete.layout import Layout
from mmsverify.concrete.trace_path import readable_state
from mmsverify.model import ModelData, load
from mmsverify.model.rows import PLUS
from mmsverify.resources import models_dir

HIDDEN = frozenset({"prevented", "to_idle", "to_stopped", "to_unrunnable"})
LATE = frozenset({"destructive"})
PROFILE = {
    "associations": "single",
    "predefined": [
        {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False},
        {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False},
    ],
}
SIZES = {"PI": 4, "Client": 2, "Request": 2}
ASSOCIATION = {"initiate", "release"}


@cache
def the_robot() -> ModelData:
    return load("mms-robot", models_dir(), "repaired")


class Talk(Conversation):
    """A conversation with a robot: two clients, and some requests at a time."""

    at_a_time = 1

    def show_status(self) -> None:
        shown = readable_state(self.model, self.scope, self.state)
        answer = robot_messages.answer(1, "status", {}, PLUS, shown)
        call = robot.shown_by_status(answer.body, answer.detail)
        assert call is not None
        self.look(call.service, call.bindings)

    def show_attributes(self, name: str) -> None:
        shown = readable_state(self.model, self.scope, self.state)
        if shown[f"state[{name}]"] == "NON-EXISTENT":
            self.look("noProgramInvocationAttributes", {"pi": name})
            return
        answer = robot_messages.attributes(1, name, shown)
        call = robot.shown_by_attributes(name, answer.body, answer.detail)
        assert call is not None
        self.look(call.service, call.bindings)

    def show_all(self) -> None:
        self.show_status()
        for name in self.scope.elements["PI"]:
            self.show_attributes(name)

    def request(self) -> None:
        free = [name for name in self.scope.elements["Request"][: self.at_a_time] if name not in self.pending]
        if free:
            service, said = self.wish({"request": free[0], "panel": False})
            self.ask(free[0], service, said)

    def wish(self, given: dict[str, Any]) -> tuple[str, dict[str, Any]]:
        """A request, mostly one that will be granted: refusals alone do not get far."""
        services = sorted({row.on.service for row in self.rows("response")} - ASSOCIATION)
        picky = self.random.random() < 0.7
        for _ in range(40):
            service = self.random.choice(LIKELY if self.random.random() < 0.8 else services)
            said = self.arguments(service, given)
            if not picky or self.accepts(service, said):
                break
        return service, said

    def serve(self) -> None:
        waiting = [slot for slot, request in self.pending.items() if request.performed is None]
        if waiting:
            self.perform(self.random.choice(waiting))

    def respond(self) -> None:
        ready = [slot for slot, request in self.pending.items() if request.performed is not None]
        if ready:
            self.answer(self.random.choice(ready))

    def exchange(self) -> None:
        """A request and its answer, with nothing shown in between."""
        self.request()
        self.serve()
        self.respond()

    def associate(self) -> None:
        """Association control is no request of the model's: its answer alone is an event."""
        user = self.random.choice(self.scope.elements["Client"])
        service = self.random.choice(sorted(ASSOCIATION))
        taken = self.take([r for r in self.rows("response", service) if r.answer != "-"], {"user": user})
        if taken is not None and taken[0].answer != "result(-)":
            self.told.append(f"{service} {user}")
            self.blamed(self.belief.respond(user, service, {"user": user}, taken[0].answer).blame)

    def unseen(self) -> None:
        """What happens inside; what explains an observed state only is observed at once."""
        wanted = "any" if self.random.random() < 0.7 else "observation"
        row = self.happen([row for row in self.rows("internal") if row.explains == wanted])
        if row is not None and row.explains != "any":
            self.show_all()

    def at_the_panel(self) -> None:
        """The operator acts, if local control is given."""
        if self.state["local_control", ()]:
            rows = [r for r in self.rows("response") if "panel" in {p.name for p in r.parameters}]
            self.happen(rows, {"panel": True})


LIKELY = ("createProgramInvocation", "select", "select", "start", "start", "start", "stop", "resume", "reset")


def talk(seed: int) -> Talk:
    model = the_robot()
    made = scope_for(model, SIZES, PROFILE)
    scope = Scope(made.elements, made.facts, (0, 3))
    layout = Layout(model, scope)
    start = initial_states(Grounding(layout, Formulas()), limit=1).states[0]
    state = layout.read(start)
    return Talk(model, scope, state, Belief(model, state, model.always), Random(seed), HIDDEN, LATE)


def spoken(seed: int, steps: int, at_a_time: int) -> str:
    """The accusations against one conversation of about as many steps; one request at a time, or more."""
    conversation = talk(seed)
    conversation.at_a_time = at_a_time
    asking: list[Any] = [conversation.request, conversation.serve, conversation.respond]
    acts: list[Any] = [conversation.exchange] if at_a_time == 1 else asking
    acts = [*acts * 4, conversation.show_status, conversation.unseen, conversation.at_the_panel]
    acts += [
        lambda: conversation.show_attributes(conversation.random.choice(conversation.scope.elements["PI"]))
    ]
    while not conversation.state["holder", ("client1",)]:
        conversation.associate()
    run(conversation, steps, acts)
    return conversation.verdict()


@pytest.mark.parametrize("seed", range(20))
def test_a_short_conversation_with_a_right_robot_is_not_blamed(seed: int) -> None:
    assert spoken(seed, 24, 1) == ""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(200))
def test_a_long_conversation_with_a_right_robot_is_not_blamed(seed: int) -> None:
    assert spoken(1000 + seed, 500, 1) == ""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(20))
def test_requests_that_overlap_are_not_blamed(seed: int) -> None:
    assert spoken(2000 + seed, 40, 2) == ""
