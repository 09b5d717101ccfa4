"""One robot: its associations and the belief about its state. Messages go in, findings come out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit import robot, variables
from mmsverify.audit.acquaintance import Acquaintance
from mmsverify.audit.exchange import Asked, Association, Breach
from mmsverify.audit.rules import RULES
from mmsverify.audit.words import title
from mmsverify.concrete.belief import Belief, Blame, Outcome
from mmsverify.concrete.belief.partial import Key
from mmsverify.errors import DecodeError
from mmsverify.formats import mms
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import MINUS, PLUS, Clause
from mmsverify.results import Finding

WINDOW = 200


@dataclass(frozen=True, slots=True)
class Place:
    """Where a finding belongs."""

    path: str
    vmd: str


class Device:
    """The replay of one robot's messages.

    ``arms`` are the domains of its arms; to associations in ``base_only`` the robot standard does not apply.
    """

    def __init__(
        self, place: Place, belief: Belief, arms: frozenset[str], base_only: frozenset[str] = frozenset()
    ) -> None:
        self.place = place
        self.belief = belief
        self.arms = arms
        self.base_only = base_only
        self._associations: dict[str, Association] = {}
        self._writers: dict[Key, tuple[int, tuple[str, ...]]] = {}
        self._founded: dict[str, bool] = {}
        self._acquaintance = Acquaintance(belief.world.names["ProgramInvocation"])
        self._recent: dict[tuple[Any, ...], int] = {}

    # Links.

    def link(self, connection: str, event: str) -> None:
        """A connection opens, closes, is reset, or has a gap: messages may be missing before this point."""
        association = self._association(connection)
        if event == "gap":
            lost = association.gap()
            if connection not in self.base_only:
                self.belief.lose_sight()
                self._acquaintance.lose()
        elif event in ("close", "reset"):
            lost = association.end()
            self._release(connection)
        else:
            association.concluded = False
            return
        self._drop(lost)

    def _drop(self, lost: list[Asked]) -> None:
        for asked in lost:
            self.belief.drop(asked.slot)

    def _release(self, name: str) -> None:
        if name not in self.base_only:
            self.belief.respond(name, "release", {"user": name}, "")

    def _association(self, name: str) -> Association:
        return self._associations.setdefault(name, Association(name))

    # Messages.

    def message(self, message: TraceMessage) -> Iterator[Finding]:
        """The findings of one MMS message."""
        name, side = message.metadata.get("association", ""), message.metadata.get("sender", "client")
        association = self._association(name)
        try:
            pdu = mms.decode(message.data)
        except DecodeError as error:
            yield self._breach(message, Breach("protocol.undecodable", {"cause": str(error)}))
            return
        for found in self._judge(association, side, pdu, message):
            if isinstance(found, Breach):
                yield self._breach(message, found)
            elif isinstance(found, variables.VariableBreach):
                yield self._breach(message, found.breach, found.clause)
            else:
                yield found
        self._note_foundations()

    def _judge(self, association: Association, side: str, pdu: Pdu, message: TraceMessage) -> Iterator[Any]:
        if association.concluded and not pdu.kind.startswith("initiate"):
            association.concluded = False
            yield Breach("protocol.after-conclude")
        match pdu.kind:
            case "initiate-RequestPDU":
                self._drop(list(association.asked.values()))
                association.propose(pdu)
            case "initiate-ResponsePDU":
                yield from association.agree(pdu)
                yield from self._initiated(association, message)
            case "confirmed-RequestPDU":
                asked, breaches = association.request(message.index, side, pdu)
                yield from breaches
                yield from self._requested(association, asked)
            case "confirmed-ResponsePDU" | "confirmed-ErrorPDU" | "rejectPDU":
                asked_for, breaches = association.answer(side, pdu)
                yield from breaches
                if asked_for is not None:
                    yield from self._answered(association, asked_for, pdu, message)
            case "unconfirmed-PDU":
                yield from self._unconfirmed(association, side, pdu, message)
            case "conclude-ResponsePDU":
                self._drop(association.end())
                association.concluded = True
                self._release(association.name)

    def _initiated(self, association: Association, message: TraceMessage) -> Iterator[Finding]:
        if self._is_robot(association):
            bindings = {"user": association.name}
            outcome = self.belief.respond(association.name, "initiate", bindings, PLUS)
            yield from self._told(message, "initiate", PLUS, outcome)

    def _is_robot(self, association: Association) -> bool:
        return association.name not in self.base_only

    def _requested(self, association: Association, asked: Asked) -> Iterator[Breach]:
        if not self._is_robot(association) or asked.side != "client":
            return
        if (
            asked.pdu.service == "select"
            and "controlled" in asked.pdu.body
            and "controlling" not in asked.pdu.body
        ):
            yield Breach("select.controlled-alone")
        if asked.pdu.service in robot.OBSERVING:
            self.belief.watch(asked.slot)
        call = robot.performed(asked.pdu, self.arms)
        if call is not None:
            self.belief.indicate(asked.slot, call.service, self._bindings(association, asked, call))

    def _bindings(self, association: Association, asked: Asked, call: robot.Call) -> Mapping[str, Any]:
        return {"request": asked.slot, "user": association.name, **call.bindings}

    def _answered(
        self, association: Association, asked: Asked, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Any]:
        if not self._is_robot(association) or asked.side != "client":
            return
        call = robot.performed(asked.pdu, self.arms)
        if call is not None:
            yield from self._decided(association, asked, call, pdu, message)
        elif pdu.kind == "confirmed-ResponsePDU":
            yield from self._shown(asked, pdu, message)
        elif (
            pdu.kind == "confirmed-ErrorPDU"
            and asked.pdu.service == "getProgramInvocationAttributes"
            and robot.failure(pdu).unknown_object
        ):
            outcome = self.belief.show("noProgramInvocationAttributes", {"pi": asked.pdu.body}, asked.slot)
            yield from self._told(message, str(asked.pdu.service), MINUS, outcome, (asked.index,))
        else:
            self.belief.drop(asked.slot)
        if pdu.kind == "confirmed-ResponsePDU" and asked.pdu.service == "defineEventEnrollment":
            self._enrolled(asked.pdu)

    def _decided(
        self, association: Association, asked: Asked, call: robot.Call, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Any]:
        """The robot has performed a service, or says why it has not."""
        bindings = dict(self._bindings(association, asked, call))
        if pdu.kind == "confirmed-ResponsePDU":
            outcome = self.belief.respond(asked.slot, call.service, bindings, PLUS)
            yield from self._told(message, call.service, PLUS, outcome, (asked.index,))
            if outcome.blame is None and self._acquaintance.stranger(call):
                yield Breach(
                    "program.never-shown",
                    {"service": title(call.service), "pi": call.bindings["pi"]},
                    (asked.index,),
                )
            self._acquaintance.meet(call)
            if call.service == "vMDReset":
                yield from self._status(pdu.body, pdu.detail, message, None)
            return
        rejected = pdu.kind == "rejectPDU"
        why = robot.Failure(True, False, None) if rejected else robot.failure(pdu)
        bindings["destructive"] = why.state == "UNRUNNABLE"
        outcome = self.belief.respond(asked.slot, call.service, bindings, MINUS, local=why.local)
        yield from self._told(message, call.service, MINUS, outcome, (asked.index,))
        if why.state is not None and outcome.blame is None:
            shown = self.belief.show("stateAfterFailure", {"pi": bindings["pi"], "shown_state": why.state})
            yield from self._told(message, call.service, MINUS, shown, (asked.index,))

    # What messages show.

    def _shown(self, asked: Asked, pdu: Pdu, message: TraceMessage) -> Iterator[Any]:
        match asked.pdu.service:
            case "status":
                yield from self._status(pdu.body, pdu.detail, message, asked.slot)
            case "getProgramInvocationAttributes":
                call = robot.shown_by_attributes(asked.pdu.body, pdu.body, pdu.detail)
                if call is not None:
                    self._acquaintance.meet(call)
                    outcome = self.belief.show(call.service, call.bindings, asked.slot)
                    yield from self._told(message, call.service, "", outcome)
            case "read":
                yield from self._values(asked.pdu, pdu, message, asked.slot)

    def _status(
        self, body: Mapping[str, Any], detail: Any, message: TraceMessage, slot: str | None
    ) -> Iterator[Finding]:
        call = robot.shown_by_status(body, detail)
        if call is not None:
            self._acquaintance.meet(call)
            yield from self._told(message, "status", "", self.belief.show(call.service, call.bindings, slot))

    def _values(self, request: Pdu, response: Pdu, message: TraceMessage, slot: str | None) -> Iterator[Any]:
        for name, data in robot.read_values(request, response):
            yield from variables.judge(name, data)
            call = variables.shows(name, data)
            if call is not None:
                yield from self._told(
                    message, "read", "", self.belief.show(call.service, call.bindings, slot)
                )
        if slot is not None:
            self.belief.drop(slot)

    def _unconfirmed(
        self, association: Association, side: str, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Any]:
        if not self._is_robot(association) or side != "server":
            return
        if pdu.service == "unsolicitedStatus":
            yield from self._status(pdu.body, pdu.detail, message, None)
        elif pdu.service == "informationReport":
            yield from self._values(pdu, pdu, message, None)
        elif pdu.service == "eventNotification":
            yield from self._notified(pdu)

    # Events: a notification needs a cause since its enrollment, or since the last one.

    def _enrolled(self, request: Pdu) -> None:
        condition = request.body["eventConditionName"][1]
        if isinstance(condition, str):
            self._founded[condition] = self._possible(condition)

    def _possible(self, condition: str) -> bool:
        """Whether the state from which the condition's transition leads may hold now.

        Of an unknown condition nothing is known, so that it always may.
        """
        if condition == "R_RVS":
            return self.belief.may_be("robot_state", (), "ROBOT-EXECUTING")
        if condition == "R_ARM":
            return any(self.belief.may_be("state", ("R_ARM",), state) for state in ("RUNNING", "STOPPING"))
        return True

    def _note_foundations(self) -> None:
        for condition, founded in self._founded.items():
            if not founded:
                self._founded[condition] = self._possible(condition)

    def _notified(self, pdu: Pdu) -> Iterator[Breach]:
        condition = pdu.body["eventConditionName"][1]
        kind, result = (pdu.body.get("actionResult") or {}).get("eventActionResult", ("none", None))
        if (
            condition == "R_ARM"
            and kind == "success"
            and result["response"][0] == "getProgramInvocationAttributes"
        ):
            shown = result["response"][1]
            if shown["state"] == 3 and shown["listOfDomainNames"] == ["R_ARM"]:
                yield Breach("event.arm-running")
                return
        if not self._founded.get(condition, True):
            yield Breach("event.unfounded", {"condition": condition})
        elif condition in self._founded:
            self._founded[condition] = self._possible(condition)

    # Findings.

    def _told(
        self,
        message: TraceMessage,
        service: str,
        answer: str,
        outcome: Outcome,
        related: tuple[int, ...] = (),
    ) -> Iterator[Finding]:
        if outcome.blame is not None and not self._repeated(
            message, outcome.blame, service if not answer else None
        ):
            yield self._finding(message, service, answer, outcome.blame, related)
        for key in outcome.written:
            made = outcome.clauses.get(key[0]) or self._writers.get(key, (0, ()))[1]
            self._writers[key] = (message.index, made)

    def _repeated(self, message: TraceMessage, blame: Blame, shown: str | None) -> bool:
        """Whether it was told shortly before: a contradiction that every poll repeats is one finding."""
        key = (blame.rule, blame.says, blame.clause, shown)
        last = self._recent.get(key)
        self._recent[key] = message.index
        return shown is not None and last is not None and message.index - last <= WINDOW

    def _finding(
        self, message: TraceMessage, service: str, answer: str, blame: Blame, related: tuple[int, ...]
    ) -> Finding:
        wrote = [self._writers[key] for key in sorted(blame.reads) if key in self._writers]
        writers = {index for index, _ in wrote}
        # What a message contradicts was established by the step that last wrote it: that step is cited, too.
        made = () if answer else tuple(clause for _, clauses in wrote for clause in clauses)
        observed = f"{title(service)} answered {answer}" if answer else f"{title(service)} shows"
        says = f"{observed}, but {blame.says}" if answer else f"{title(service)}: {blame.says}"
        return Finding(
            path=self.place.path, vmd=self.place.vmd,
            index=message.index, time=message.time, topic=message.topic,
            severity="error" if blame.level == "error" else "warning", rule=blame.rule,
            clauses=tuple(dict.fromkeys((*blame.clause.ids, *made))), message=says,
            expected=blame.expected, observed=answer or "shown", before=blame.before,
            related=tuple(sorted(({*related, *writers}) - {message.index})), readings=blame.clause.readings,
        )  # fmt: skip

    def _breach(self, message: TraceMessage, breach: Breach, clause: Clause | None = None) -> Finding:
        rule = RULES[breach.rule]
        cited = clause + rule.clause if clause is not None else rule.clause
        return Finding(
            path=self.place.path, vmd=self.place.vmd,
            index=message.index, time=message.time, topic=message.topic,
            severity=rule.severity, rule=rule.id, clauses=cited.ids,
            message=rule.says.format(**breach.words), expected=(), observed="",
            related=breach.related, readings=cited.readings,
        )  # fmt: skip
