"""Random conversations with a robot that keeps the rules: who asks what, when it acts, what is unseen."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from math import inf
from random import Random
from typing import Any

from random_steps import guessed
from robot_acts import LOOKS, Act
from robot_events import DEFINE, DELETE, ENROLLING
from robot_talk import ASSOCIATING, Talk, row_name

from mmsverify.audit.words import ARM
from mmsverify.checking.domain_messages import FROM_ROBOT
from mmsverify.concrete import Scope, scope_for
from mmsverify.concrete.formulas import Formulas
from mmsverify.concrete.ground import Grounding
from mmsverify.concrete.initial import initial_states
from mmsverify.concrete.layout import Layout
from mmsverify.concrete.scope import Binding
from mmsverify.model import ModelData, Row
from mmsverify.model.rows import PLUS

COUNTS = (0, 3)
ENROLLMENTS = ("E1", "E2", "E3")
TRIES, GUESSES, WISHES = 12, 6, 5
HOPED = {
    "status": "STATE-CHANGES-ALLOWED",
    "taken": False,
    "destructive": False,
    "to_unrunnable": frozenset(),
}
"""What lets the conversation go on: parameters of what happens unseen, where it may as well be this."""

GRANTED = 0.7
"""How often a request is one that will be granted: refusals alone do not get far."""

SELDOM = {
    "kill": 0.03,
    "vMDStop": 0.03,
    "vMDReset": 0.03,
    "deleteProgramInvocation": 0.2,
    "relinquishControl": 0.2,
}
"""Services after which little is left to talk about."""


def beginning(model: ModelData, profile: Mapping[str, Any], sizes: Mapping[str, int]) -> Talk:
    """A robot at power-on."""
    made = scope_for(model, sizes, profile)
    scope = Scope(made.elements, made.facts, COUNTS)
    layout = Layout(model, scope)
    start = initial_states(Grounding(layout, Formulas()), limit=1).states[0]
    return Talk(model, scope, layout.read(start))


class Chance:
    """Throws the dice for one conversation."""

    def __init__(self, talk: Talk, seed: int, *, calm: bool = False, gaps: float = 0.003) -> None:
        """``calm``: one request at a time; ``gaps``: how often messages begin to be lost."""
        self.talk, self.random = talk, Random(seed)
        self.model, self.scope = talk.model, talk.scope
        self.calm, self.gaps = calm, gaps
        rows = talk.model.actions
        asked = (r for r in rows if r.on.phase == "response" and self._can_be_named(r))
        self.services = sorted({r.on.service for r in asked} - ASSOCIATING.keys() - FROM_ROBOT)
        self.of_robot = [r for r in rows if r.on.service in FROM_ROBOT and self._can_be_named(r)]
        self.internal = [row for row in rows if row.on.phase == "internal"]
        self.at_panel = [
            row
            for row in rows
            if any(p.name == "panel" for p in row.on.parameters) and self._can_be_named(row)
        ]

    def _can_be_named(self, row: Row) -> bool:
        """Whether there is something of every sort that the row's parameters name."""
        return all(self.scope.parameter_values(row, parameter) for parameter in row.parameters)

    def hold(self, count: int) -> Talk:
        """A conversation of ``count`` messages or a few more: what must be answered is."""
        while len(self.talk.messages) < count:
            self.act()
        self.talk.settle()
        return self.talk

    def join_late(self, count: int) -> Talk:
        """``count`` messages are said that no recording has."""
        while len(self.talk.messages) < count or not self.talk.do(Act("late")):
            self.act()
        return self.talk

    def act(self) -> None:
        """One thing happens, or none."""
        acts: list[tuple[int, Callable[[], Any]]] = [
            (10, self.exchange), (8, self.unseen), (2, self.tell), (3, self.panel), (1, self.leave),
            (6, self.serve), (4, self.notify),
        ]  # fmt: skip
        if not self.calm:
            acts += [(8, self.ask), (12, self.perform), (12, self.answer)]
        if not self.talk.open or self.random.random() < 0.05:
            self.join()
        elif self.random.random() < (0.2 if self.talk.lost_from is not None else self.gaps):
            self.talk.do(Act("gap", what="begin" if self.talk.lost_from is None else "end"))
        else:
            self.random.choices([act for _, act in acts], [weight for weight, _ in acts])[0]()

    # Associations.

    def join(self) -> None:
        """A client sets up an association."""
        away = [name for name in self.scope.elements["Client"] if name not in self.talk.open]
        if away:
            self.talk.do(Act("open", self.random.choice(away)))

    def leave(self) -> None:
        """A client concludes, or its connection breaks."""
        if self.random.random() < 0.2:
            self.talk.do(Act(self.random.choice(("close", "reset")), self.random.choice(self.talk.open)))

    def tell(self) -> None:
        """The robot tells its status."""
        self.talk.do(Act("tell", self.random.choice(self.talk.open)))

    def serve(self) -> None:
        """The robot asks for a segment of a domain, or ends a download."""
        user = self.random.choice(self.talk.open)
        for row in self.random.sample(self.of_robot, len(self.of_robot)):
            for _ in range(GUESSES):
                given = self.guessed(row, {"user": user})
                if self.talk.do(Act("serve", user, row_name(row), given)):
                    return

    # Requests.

    def ask(self) -> str | None:
        """A request; its name."""
        free = [slot for slot in self.scope.elements["Request"] if slot not in self.talk.pending]
        if not free or not self.talk.open:
            return None
        user = self.random.choice(self.talk.open)
        if sum(p.user == user for p in self.talk.pending.values()) >= 5:
            return None
        service, given = self.asked_for(user, free[0])
        return free[0] if self.talk.do(Act("ask", free[0], service, {"user": user, **given})) else None

    def asked_for(self, user: str, slot: str) -> tuple[str, dict[str, Any]]:
        """What a client asks for."""
        if self.random.random() < 0.3:
            return self.view()
        return self.enrollment() if self.random.random() < 0.2 else self.wish(user, slot)

    def enrollment(self) -> tuple[str, dict[str, Any]]:
        """A client wants to be told of something, or not any more."""
        name = self.random.choice(ENROLLMENTS)
        if name in self.talk.events.enrolled and self.random.random() < 0.5:
            return DELETE, {"enrollment": name}
        conditions = sorted(self.talk.events.occurrences)
        if not self.talk.arms:
            conditions.remove(ARM)
        condition = self.random.choice(conditions)
        return DEFINE, {"enrollment": name, "condition": condition, "both": self.random.random() < 0.7}

    def notify(self) -> None:
        """The robot tells of an event that has occurred."""
        due = list(self.talk.events.due())
        if due:
            self.talk.do(Act("notify", what=self.random.choice(due)))

    def view(self) -> tuple[str, dict[str, Any]]:
        """Something of the state is asked for."""
        return self.random.choice(list(self.talk.views()))

    def wish(self, user: str, slot: str) -> tuple[str, dict[str, Any]]:
        """A service is asked for: of some that come to mind, mostly one that will be granted."""
        known = {"request": slot, "user": user, "panel": False}
        weights = [SELDOM.get(service, 1.0) for service in self.services]
        ideas = []
        for service in dict.fromkeys(self.random.choices(self.services, weights, k=WISHES)):
            row, given = self.promising(service, known)
            ideas.append((self.worn(row), service, given, row is not None and row.answer == PLUS))
        granted = [idea for idea in ideas if idea[3]]
        if not granted and self.random.random() < 0.3:
            self.unseen(seldom=True)
        if granted and self.random.random() < GRANTED:
            ideas = granted
        _, service, given, _ = min(ideas, key=lambda idea: idea[0])
        return service, given

    def promising(self, service: str, known: Mapping[str, Any]) -> tuple[Row | None, dict[str, Any]]:
        """Arguments with which a service would be granted, if some are found, and the row that answers."""
        for _ in range(TRIES):
            given = self.arguments(service, known)
            row = self.foreseen(service, given)
            if row is not None and row.answer == PLUS:
                break
        return row, given

    def worn(self, row: Row | None) -> float:
        """How often a row has been taken."""
        return inf if row is None else sum(act.what == row_name(row) for act in self.talk.done)

    def arguments(self, service: str, known: Mapping[str, Any]) -> dict[str, Any]:
        """Values for all parameters that rows of a service have."""
        found: dict[str, Any] = dict(known)
        for row in self.talk.rows("response", service):
            found = {**self.guessed(row, found), **found}
        return found

    def guessed(self, row: Row, known: Mapping[str, Any]) -> dict[str, Binding]:
        """Parameters of a row: those that are known, any values for the others."""
        return guessed(row, known, self.scope, self.random)

    def foreseen(self, service: str, given: Mapping[str, Any]) -> Row | None:
        """A row that would be taken if the service were asked for and performed now."""
        talk, before = self.talk, self.talk.state
        for row in talk.rows("indication", service):
            talk.state = talk.takes(row, talk.bindings(row, given)) or talk.state
        rows = talk.rows("response", service)
        found = next((row for row in rows if talk.takes(row, self.guessed(row, given))), None)
        talk.state = before
        return found

    def perform(self, slot: str | None = None) -> None:
        """The robot acts on a request that waits."""
        waiting = [name for name, request in self.talk.pending.items() if request.answer is None]
        if waiting:
            self.performed(slot or self.random.choice(waiting))

    def performed(self, slot: str) -> None:
        """What the rows of the service's procedure say; now and then, a failure of the robot's own."""
        request = self.talk.pending[slot]
        if request.service in LOOKS or request.service in ENROLLING:
            self.talk.do(Act("perform", slot))
            return
        rows = self.talk.rows("response", request.service)
        if self.random.random() < 0.9:
            rows = [row for row in rows if row.step]
        for _ in range(TRIES):
            for row in self.random.sample(rows, len(rows)):
                known = self.talk.bindings(row, request.asked)
                hoped = self.talk.bindings(row, HOPED) if self.random.random() < 0.9 else {}
                hidden = {k: v for k, v in self.guessed(row, {**hoped, **known}).items() if k not in known}
                if self.talk.do(Act("perform", slot, row_name(row), hidden)):
                    return

    def answer(self, slot: str | None = None) -> None:
        """An answer is sent."""
        ready = [name for name, request in self.talk.pending.items() if request.answer is not None]
        if ready:
            self.talk.do(Act("answer", slot or self.random.choice(ready)))

    def exchange(self) -> None:
        """A request and its answer, with nothing in between."""
        slot = self.ask()
        if slot is not None:
            self.perform(slot)
            if self.talk.pending[slot].answer is not None:
                self.answer(slot)

    # What no message shows.

    def unseen(self, seldom: bool | None = None) -> None:
        """Something happens inside; seldom what explains an observed state only."""
        if seldom is None:
            seldom = self.random.random() < 0.03
        rows = [row for row in self.internal if (row.explains != "any") is seldom]
        self.happens(rows, HOPED if self.random.random() < 0.7 else {})

    def panel(self) -> None:
        """The operator acts at the panel, if local control is given."""
        free = [slot for slot in self.scope.elements["Request"] if slot not in self.talk.pending]
        if free and self.talk.state.get(("local_control", ())):
            self.happens(self.at_panel, {"panel": True, "request": free[0]})

    def happens(self, rows: list[Row], known: Mapping[str, Any]) -> None:
        """One of the rows is taken, rather one that has not been taken often."""
        ideas = [self.random.choice(rows) for _ in range(TRIES if rows else 0)]
        for row in sorted(ideas, key=self.worn):
            for _ in range(GUESSES):
                given = self.guessed(row, self.talk.bindings(row, known))
                if self.talk.do(Act("happen", what=row_name(row), given=given)):
                    return
