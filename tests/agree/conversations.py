"""Random runs of a model, and what a recording would show of them, told to a belief as the audit tells it.

A request is asked, performed and answered at three instants; other requests, internal steps and observations
come in between. Steps are taken by the judge, which shares nothing with beliefs but the rows. A conversation
is right by its making: whatever a belief blames in it is a false accusation.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from random import Random
from typing import Any

from random_steps import guessed, tried

from mmsverify.concrete import Scope
from mmsverify.concrete.belief import Belief, Blame
from mmsverify.concrete.evaluate import Valuation
from mmsverify.model import ModelData
from mmsverify.model.rows import PLUS, Row

TRIES = 60


@dataclass
class Pending:
    """A request on its way: what the client asked for, and the answer once the responder has decided."""

    slot: str
    service: str
    asked: Mapping[str, Any]
    performed: Row | None = None
    bindings: Mapping[str, Any] = field(default_factory=dict)


@dataclass
class Conversation:
    """A run in progress.

    ``hidden`` are the parameters that no message shows, ``late`` those that only the answer does.
    """

    model: ModelData
    scope: Scope
    state: Valuation
    belief: Belief
    random: Random
    hidden: frozenset[str] = frozenset()
    late: frozenset[str] = frozenset()
    pending: dict[str, Pending] = field(default_factory=dict)
    told: list[str] = field(default_factory=list)
    blames: list[Blame] = field(default_factory=list)

    def rows(self, phase: str, service: str | None = None) -> list[Row]:
        """The rows of one phase, of all services or of one."""
        return [r for r in self.model.rows if r.on.phase == phase and service in (None, r.on.service)]

    def bindings(self, row: Row, given: Mapping[str, Any]) -> dict[str, Any]:
        """Parameters of a row: those that are given, any values for the others."""
        return guessed(row, given, self.scope, self.random)

    def take(
        self, rows: Iterable[Row], given: Mapping[str, Any], tries: int = TRIES
    ) -> tuple[Row, dict[str, Any]] | None:
        """A step of one of the rows, if one is found; its row and parameters."""
        found = tried(self.model, self.scope, rows, given, self.state, self.random, tries)
        if found is None:
            return None
        row, bindings, self.state = found
        return row, bindings

    # A request in three instants.

    def arguments(self, service: str, given: Mapping[str, Any]) -> dict[str, Any]:
        """What a request for a service may say."""
        said: dict[str, Any] = {}
        for row in self.rows("response", service):
            shown = {p.name for p in row.on.parameters} - self.hidden - self.late
            said |= {k: v for k, v in self.bindings(row, {**given, **said}).items() if k in shown}
        return said

    def accepts(self, service: str, seen: Mapping[str, Any]) -> bool:
        """Whether the responder would perform the service if it were asked and did so now."""
        before = self.state
        self.take(self.rows("indication", service), seen)
        taken = self.take([r for r in self.rows("response", service) if r.answer == PLUS], seen, tries=5)
        self.state = before
        return taken is not None

    def ask(self, slot: str, service: str, seen: Mapping[str, Any]) -> None:
        """A request arrives; its indication takes effect where the model has one that applies."""
        self.take(self.rows("indication", service), seen)
        self.pending[slot] = Pending(slot, service, seen)
        self.told.append(f"asked {slot} {service} {_readable(seen)}")
        self.belief.indicate(slot, service, seen)

    def perform(self, slot: str) -> None:
        """The responder decides and acts; nothing shows it yet."""
        request = self.pending[slot]
        taken = self.take(self.rows("response", request.service), request.asked)
        if taken is not None:
            request.performed, request.bindings = taken
            self.told.append(f"  performed {slot} {taken[0].id} {taken[0].answer}")

    def answer(self, slot: str) -> None:
        """The answer is sent, if there is one."""
        request = self.pending.pop(slot)
        if request.performed is None:
            self.belief.drop(slot)
            return
        shown = {**request.asked, **{k: v for k, v in request.bindings.items() if k in self.late}}
        row = request.performed
        self.told.append(f"answered {slot} {request.service} {row.answer}")
        self.blamed(self.belief.respond(slot, request.service, shown, row.answer).blame)

    # What happens unseen, and what is seen.

    def happen(self, rows: Iterable[Row], given: Mapping[str, Any] | None = None) -> Row | None:
        """A step that no message shows."""
        taken = self.take(rows, given or {})
        if taken is None:
            return None
        self.told.append(f"  happened {taken[0].id} {_readable(taken[1])}")
        return taken[0]

    def look(self, service: str, shown: Mapping[str, Any], slot: str | None = None) -> None:
        """Something of the state is shown."""
        self.told.append(f"shown {service} {_readable(shown)}")
        self.blamed(self.belief.show(service, shown, slot).blame)

    def blamed(self, blame: Blame | None) -> None:
        """Remember an accusation."""
        if blame is not None:
            self.blames.append(blame)

    def verdict(self) -> str:
        """Nothing, or the false accusations with the conversation up to them."""
        found = [f"{b.rule}: {b.says} {b.before}" for b in self.blames]
        return "\n".join([*self.told, *found]) if found else ""


def run(conversation: Conversation, steps: int, acts: list[Callable[[], None]]) -> None:
    """Do ``steps`` random acts; stop at the first accusation, which may well be the cause of the next."""
    for _ in range(steps):
        conversation.random.choice(acts)()
        if conversation.blames:
            return


def _readable(bindings: Mapping[str, Any]) -> str:
    return " ".join(
        f"{k}={sorted(v) if isinstance(v, frozenset) else v!s}" for k, v in bindings.items() if v is not None
    )
