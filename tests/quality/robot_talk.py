"""A robot that keeps the rules, and what a recording of its conversations holds: MMS PDUs and link events.

It lives by the rows of the model, one step at a time, judged by the tree walk. What happens is a list of
acts, so that a conversation can be cut down and told again: an act that is not possible any more is left out,
and what remains is conforming by its making.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import robot_events
from random_steps import taken
from robot_acts import LOOKS, Act, Pending
from robot_events import ENROLLING, PATIENCE, Events
from robot_recording import Link, Message, Said, write

from mmsverify.audit import robot as adapter
from mmsverify.audit import words
from mmsverify.checking import domain_messages
from mmsverify.checking import robot_messages as messages
from mmsverify.checking.robot_trace import profile_of
from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Valuation
from mmsverify.concrete.trace_path import readable, readable_state
from mmsverify.formats.mms import Pdu, decode, encode
from mmsverify.formats.trace import Sender
from mmsverify.model import ModelData, Row
from mmsverify.model.rows import MINUS, PLUS
from mmsverify.model.sorts import EnumSort
from mmsverify.results import PathStep
from mmsverify.samples import pdus
from mmsverify.samples.cell import OFFERED, ROBOT_ADDITIONAL

ARMS = frozenset({"R_ARM"})
"""The domains of an arm, where a program invocation of an arm is predefined."""

OUTSTANDING = 5
NO_NUMBER_LEFT = "upload.id-in-use"
"""The robot gives an upload its number, so that it refuses one only for want of numbers."""
SERVICES = (*OFFERED["server"], "loadDomainContent", "storeDomainContent")
ASSOCIATING = {"initiate": "open", "release": "close"}
"""Rows that answer to no confirmed request, and the act that performs each."""


@dataclass(frozen=True, slots=True)
class Taken:
    """A step of the robot: by which row, in which act (by its number), from which state to which."""

    act: int
    row: Row
    bindings: Mapping[str, Any]
    before: Valuation
    after: Valuation
    scope: Scope


class Talk:
    """A conversation with one robot, from power-on."""

    def __init__(self, model: ModelData, scope: Scope, start: Valuation) -> None:
        self.scope = scope
        self.state: Valuation = start
        self.messages: list[Message] = []
        self.pending: dict[str, Pending] = {}
        self.open: list[str] = []
        self.done: list[Act] = []
        self.lost_from: int | None = None
        self.events = Events(model, scope)
        self._ids: dict[str, int] = {}
        self._start = start
        bound = (key for key, held in start.items() if key[0] == "predefined_arm" and held)
        self.arms = ARMS if any(start["predefined", key[1]] for key in bound) else frozenset()
        self._shown: tuple[Valuation, dict[str, Any]] | None = None
        self.taken: list[Taken] = []
        self.become(model)

    def become(self, model: ModelData) -> None:
        """From now on the robot lives by these rows."""
        self.model = model
        self._rows: dict[tuple[str, str], list[Row]] = {}
        for row in model.rows:
            self._rows.setdefault((row.on.phase, row.on.service), []).append(row)

    def rows(self, phase: str, service: str) -> list[Row]:
        """The rows of one phase of one service."""
        return self._rows.get((phase, service), [])

    # What happens.

    def do(self, act: Act) -> bool:
        """Let it happen if it can; connections neither come nor go while messages are lost."""
        if self.lost_from is not None and act.kind in ("open", "close", "reset"):
            return False
        happened = bool(getattr(self, f"_{act.kind}")(act))
        if happened:
            self.done.append(act)
            for name in list(self.events.due()):
                if len(self.messages) - self.events.enrolled[name].since > PATIENCE:
                    self._told(name)
        return happened

    def takes(self, row: Row, bindings: Mapping[str, Any]) -> Valuation | None:
        """The state after the row, if it can be taken now."""
        return taken(self.model, self.scope, row, bindings, self.state)

    def _take(self, row: Row, bindings: Mapping[str, Any]) -> bool:
        after = self.takes(row, bindings)
        if after is None:
            return False
        occurring = self.events.occurring(self.state, after)
        for name in set(occurring).intersection(self.events.due()):
            self._told(name)
        self.taken.append(Taken(len(self.done), row, bindings, self.state, after, self.scope))
        self.state = after
        self.events.act(occurring, len(self.messages), self._acted)
        return True

    def _open(self, act: Act) -> bool:
        (row,) = (row for row in self.rows("response", "initiate") if row.answer == PLUS)
        if act.who in self.open or not self._take(row, {"user": act.who, **act.given}):
            return False
        self.open.append(act.who)
        self.messages.append(Link(act.who, "open"))
        self._say(act.who, "client", pdus.initiation("Request", OFFERED["client"], (), OUTSTANDING))
        agreed = pdus.initiation("Response", SERVICES, ROBOT_ADDITIONAL, OUTSTANDING)
        self._say(act.who, "server", agreed)
        return True

    def _close(self, act: Act) -> bool:
        """Conclude; all requests have been answered."""
        if any(p.user == act.who for p in self.pending.values()):
            return False
        due = list(self.events.due(act.who))
        for name in due if act.who in self.open else ():
            self._told(name)
        if not self._released(act):
            return False
        self._say(act.who, "client", Pdu("conclude-RequestPDU"))
        self._say(act.who, "server", Pdu("conclude-ResponsePDU"))
        self.messages.append(Link(act.who, "close"))
        return True

    def _reset(self, act: Act) -> bool:
        """The connection is lost, and with it what was asked."""
        if self.owes(act.who) or not self._released(act):
            return False
        self.pending = {slot: p for slot, p in self.pending.items() if p.user != act.who}
        self.messages.append(Link(act.who, "reset"))
        return True

    def _released(self, act: Act) -> bool:
        (row,) = self.rows("response", "release")
        if act.who not in self.open or not self._take(row, {"user": act.who, **act.given}):
            return False
        self.open.remove(act.who)
        self.events.released(act.who)
        return True

    def _ask(self, act: Act) -> bool:
        """A request arrives; its indication takes effect where the model has one that applies."""
        user, slot = str(act.given["user"]), act.who
        if user not in self.open or slot in self.pending or self._unheard(act):
            return False
        invoke_id = self._id(user)
        given = {name: readable(held) for name, held in act.given.items()}
        given["binds_arm"] = given.get("binds_arm", False) and bool(self.arms)
        made = robot_events.request if act.what in ENROLLING else messages.request
        asked = decode(encode(made(invoke_id, act.what, given)))
        self._say(user, "client", asked)
        call = adapter.performed(asked, self.arms)
        bindings = {"request": slot, "user": user, **(call.bindings if call else act.given)}
        for row in self.rows("indication", act.what):
            if self._take(row, self.bindings(row, bindings)):
                break
        self.pending[slot] = Pending(user, invoke_id, act.what, bindings)
        return True

    def _unheard(self, act: Act) -> bool:
        """Whether it speaks of an upload whose number the client has not been told yet."""
        begun = (p for p in self.pending.values() if p.service == "initiateUploadSequence")
        return "upload" in act.given and any(p.asked["upload"] == act.given["upload"] for p in begun)

    def bindings(self, row: Row, known: Mapping[str, Any]) -> dict[str, Any]:
        """The parameters of a row that are known, as values of the model."""
        found = {}
        for parameter in row.parameters:
            if parameter.name in known:
                given = known[parameter.name]
                if isinstance(parameter.of, EnumSort) and isinstance(given, str):
                    given = next(m for m in parameter.of.members if given in (m.value, m.name))
                found[parameter.name] = given
        return found

    def _perform(self, act: Act) -> bool:
        """The robot decides and acts by the row ``what``; nothing shows it yet."""
        request = self.pending.get(act.who)
        if request is None or request.answer is not None:
            return False
        if request.service in LOOKS:
            request.answer = self._looked(request)
            return True
        if request.service in ENROLLING:
            request.answer = self.events.perform(request.service, request.asked, request.invoke_id)
            return True
        row = next((r for r in self.rows("response", request.service) if row_name(r) == act.what), None)
        if row is None or not self._take(row, {**act.given, **self.bindings(row, request.asked)}):
            return False
        self._decide(request, row)
        return True

    def _decide(self, request: Pending, row: Row) -> None:
        said = {name: readable(held) for name, held in request.asked.items()}
        request.answer = messages.answer(request.invoke_id, request.service, said, row.answer, self.shown())
        if row.answer == MINUS and row.guard and row.guard[-1].rule == NO_NUMBER_LEFT:
            request.answer = pdus.failure(request.invoke_id, ("resource", "capability-unavailable"))

    def _answer(self, act: Act) -> bool:
        request = self.pending.get(act.who)
        if request is None or request.answer is None:
            return False
        del self.pending[act.who]
        self._say(request.user, "server", request.answer)
        return True

    def _serve(self, act: Act) -> bool:
        """The robot asks the client for something that it may ask for, and is answered at once."""
        row = next((r for r in self.model.actions if row_name(r) == act.what), None)
        if row is None or act.who not in self.open:
            return False
        (needed,) = self.rows("shown", f"{row.on.service}Asked")
        asked = {"discard": False, **act.given}
        if self.takes(needed, self.bindings(needed, asked)) is None or not self._take(row, act.given):
            return False
        invoke_id = self._id(act.who)
        said = {name: readable(held) for name, held in act.given.items()}
        self._say(act.who, "server", messages.request(invoke_id, row.on.service, said))
        self._say(
            act.who, "client", messages.answer(invoke_id, row.on.service, said, row.answer, self.shown())
        )
        return True

    def _happen(self, act: Act) -> bool:
        """A step that no message shows; what explains an observed state only is observed at once."""
        row = next((r for r in self.model.actions if row_name(r) == act.what), None)
        before = dict(self.sights()) if row is not None and row.explains != "any" else {}
        if row is None or (row.explains != "any" and not self.open) or not self._take(row, act.given):
            return False
        now = dict(self.sights()) if before else {}
        for view, sight in before.items():
            if now[view] != sight:
                self._look(Act("look", self.open[0], view[0], dict(view[1])))
        return True

    def _tell(self, act: Act) -> bool:
        """The robot tells its status unasked."""
        if act.who not in self.open:
            return False
        self._say(act.who, "server", messages.unsolicited_status(self.shown()))
        return True

    def _notify(self, act: Act) -> bool:
        """The robot tells of an event."""
        if act.what not in self.events.due():
            return False
        self._told(act.what)
        return True

    def _told(self, name: str) -> None:
        user, told = self.events.told(name)
        self._say(user, "server", told)

    def _acted(self, action: str) -> Pdu:
        """What an action shows now."""
        if action == words.ARM:
            return messages.attributes(0, words.ARM, self.shown())
        return messages.answer(0, "status", {}, PLUS, self.shown())

    def _gap(self, act: Act) -> bool:
        """Messages are lost from here (``what`` is ``begin``) to there, on all connections."""
        if (act.what == "begin") is (self.lost_from is not None):
            return False
        if self.lost_from is None:
            if any(map(self.owes, self.open)):
                return False
            self.lost_from = len(self.messages)
            return True
        self._lost(self.lost_from)
        self.messages += [Link(user, "gap") for user in self.open]
        self.lost_from = None
        return True

    def _late(self, _act: Act) -> bool:
        """The recording begins only here, in mid-operation."""
        if self.lost_from is not None:
            return False
        self._lost(0)
        return True

    def _lost(self, begin: int) -> None:
        del self.messages[begin:]
        for request in self.pending.values():
            request.missed = True

    def owes(self, user: str) -> bool:
        """Whether an answer to that client must stand in the recording and does not yet."""
        return any(p.owed for p in self.pending.values() if p.user == user)

    def settle(self) -> None:
        """The answers that the recording must hold come."""
        for slot, request in list(self.pending.items()):
            if request.owed and self.lost_from is None:
                self.do(Act("answer", slot))

    # What is seen.

    def look_round(self, user: str) -> None:
        """All that messages can show is shown, on one association."""
        for service, given in self.views():
            self._look(Act("look", user, service, given))

    def _look(self, act: Act) -> bool:
        """State is asked for and shown at once."""
        if act.who not in self.open:
            return False
        request = Pending(act.who, self._id(act.who), act.what, act.given)
        self._say(act.who, "client", messages.request(request.invoke_id, act.what, act.given))
        self._say(act.who, "server", self._looked(request))
        return True

    def sights(self) -> Iterator[tuple[tuple[str, tuple[tuple[str, Any], ...]], Pdu]]:
        """What each view shows now."""
        for service, given in self.views():
            view = service, tuple(given.items())
            yield view, self._looked(Pending("", 0, service, given))

    def views(self) -> Iterator[tuple[str, dict[str, Any]]]:
        """Every request that shows something of the state; Status, which tells what is admitted, last."""
        yield "reportSemaphoreStatus", {}
        for name in self.scope.elements["PI"]:
            yield "getProgramInvocationAttributes", {"pi": name}
        for name in self.scope.elements["Domain"]:
            yield "getDomainAttributes", {"domain": name}
        yield "read", {"variables": tuple(sorted(self.variables()))}
        yield "status", {}

    def _looked(self, request: Pending) -> Pdu:
        shown, invoke_id = self.shown(), request.invoke_id
        if request.service == "getProgramInvocationAttributes":
            return messages.attributes(invoke_id, request.asked["pi"], shown)
        if request.service == "getDomainAttributes":
            programs = messages.programs(shown)
            return domain_messages.attributes(invoke_id, request.asked["domain"], shown, programs)
        if request.service == "read":
            known = self.variables()
            return messages.values(invoke_id, [known[name] for name in request.asked["variables"]])
        return messages.answer(invoke_id, request.service, {}, PLUS, shown)

    def variables(self) -> dict[str, tuple[str, Any]]:
        """The standardized variables that show something of the state, with their values now."""
        facts = self.scope.facts.items()
        calibrated = [args[0] for (name, args), held in facts if name == "needs_calibration" and held]
        return messages.variables(self.shown(), calibrated)

    def shown(self) -> dict[str, Any]:
        """The state in the words of results."""
        if self._shown is None or self._shown[0] is not self.state:
            self._shown = self.state, readable_state(self.model, self.scope, self.state)
        return self._shown[1]

    # The recording.

    def _id(self, user: str) -> int:
        self._ids[user] = self._ids.get(user, 0) + 1
        return self._ids[user]

    def _say(self, association: str, sender: Sender, pdu: Pdu) -> None:
        self.messages.append(Said(association, sender, pdu))

    def profile(self) -> dict[str, str]:
        """What the recording says of the robot."""
        shown = readable_state(self.model, self.scope, self._start, rigid=True)
        return profile_of(PathStep("initially", {}, (), shown))

    def write(self, path: Path) -> Path:
        """The recording."""
        return write(path, self.profile(), self.messages[: self.lost_from])


def row_name(row: Row) -> str:
    """A row's name in acts: rows of one step may answer differently."""
    return f"{row.id} {row.answer}".strip()
