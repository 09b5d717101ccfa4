"""What the messages of a robot show of its state, told to the belief: status, attributes, variables."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit import robot, variables
from mmsverify.audit.acquaintance import Acquaintance
from mmsverify.audit.exchange import Asked
from mmsverify.audit.rules import Breach
from mmsverify.audit.telling import Telling
from mmsverify.concrete.belief import Belief
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import MINUS
from mmsverify.results import Finding


class Showing:
    """Answers that show something, and what is shown unasked."""

    def __init__(
        self, belief: Belief, telling: Telling, acquaintance: Acquaintance, arms: frozenset[str]
    ) -> None:
        self._belief = belief
        self._telling = telling
        self._acquaintance = acquaintance
        self._arms = arms
        self._predefined = frozenset(belief.world.names["ProgramInvocation"])
        self._variables = variables.Variables()

    def answered(self, asked: Asked, pdu: Pdu, message: TraceMessage) -> Iterator[Finding | Breach]:
        """The positive answer to a service that changes nothing in the model."""
        match asked.pdu.service:
            case "status":
                yield from self.status(pdu.body, pdu.detail, message, asked.slot)
            case "getProgramInvocationAttributes":
                yield from self.attributes(asked.pdu.body, pdu, message, asked.slot)
            case "read":
                yield from self.values(asked.pdu, pdu, message, asked.slot)
            case "reportSemaphoreStatus" | "reportSemaphoreEntryStatus":
                for call in robot.shown_of_semaphore(asked.pdu, pdu):
                    yield from self._shown(message, str(asked.pdu.service), call, asked.slot)
                self._belief.drop(asked.slot)

    def refused(self, asked: Asked, pdu: Pdu, message: TraceMessage) -> Iterator[Finding]:
        """The negative answer to such a service: that an object is not there shows something, too."""
        if (
            pdu.kind == "confirmed-ErrorPDU"
            and asked.pdu.service == "getProgramInvocationAttributes"
            and robot.failure(pdu).unknown_object
        ):
            outcome = self._belief.show("noProgramInvocationAttributes", {"pi": asked.pdu.body}, asked.slot)
            yield from self._telling.outcome(message, str(asked.pdu.service), MINUS, outcome, (asked.index,))
        else:
            self._belief.drop(asked.slot)

    def attributes(self, name: str, pdu: Pdu, message: TraceMessage, slot: str) -> Iterator[Finding]:
        """The attributes of a program invocation, and the domains that it is bound to."""
        call = robot.shown_by_attributes(name, pdu.body, pdu.detail)
        if call is not None:
            self._acquaintance.meet(call)
            yield from self._shown(message, call.service, call, slot)
        domains = frozenset(pdu.body["listOfDomainNames"])
        # Which of its own program invocations move an arm, a profile says.
        moves = bool(self._arms & domains) if self._arms and name not in self._predefined else None
        bound = robot.Call("listOfDomainNames", {"pi": name, "domains": domains, "shown_arm": moves})
        yield from self._shown(message, str(pdu.service), bound, slot)

    def status(
        self, body: Mapping[str, Any], detail: Any, message: TraceMessage, slot: str | None = None
    ) -> Iterator[Finding]:
        """Status, UnsolicitedStatus, or the status that VMD Reset answers."""
        call = robot.shown_by_status(body, detail)
        if call is not None:
            self._acquaintance.meet(call)
            yield from self._shown(message, "status", call, slot)
        elif slot is not None:
            self._belief.drop(slot)

    def values(
        self, request: Pdu, response: Pdu, message: TraceMessage, slot: str | None = None
    ) -> Iterator[Finding | Breach]:
        """The values of a Read, or of an InformationReport, which is both request and response."""
        values = list(robot.read_values(request, response))
        yield from self._variables.judge(values, message.index)
        calls = [call for name, data in values if (call := variables.shows(name, data)) is not None]
        for call in calls:
            self._acquaintance.meet(call)
            yield from self._shown(message, "read", call, slot)
        both = variables.together(calls)
        if both is not None:
            yield from self._shown(message, "read", both, None)
        if slot is not None:
            self._belief.drop(slot)

    def _shown(
        self, message: TraceMessage, service: str, call: robot.Call, slot: str | None
    ) -> Iterator[Finding]:
        outcome = self._belief.show(call.service, call.bindings, slot)
        yield from self._telling.outcome(message, service, "", outcome)
