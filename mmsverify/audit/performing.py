"""Services that change the robot's state: their indication and their answer, told to the belief."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from mmsverify.audit import robot, variables
from mmsverify.audit.acquaintance import Acquaintance
from mmsverify.audit.exchange import Asked
from mmsverify.audit.rules import Breach
from mmsverify.audit.telling import Telling
from mmsverify.audit.words import title
from mmsverify.concrete.belief import Belief
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import MINUS, PLUS
from mmsverify.results import Finding


class Performing:
    """The services of one device; ``arms`` are the domains of its arms."""

    def __init__(
        self, belief: Belief, telling: Telling, acquaintance: Acquaintance, arms: frozenset[str]
    ) -> None:
        self._belief = belief
        self._telling = telling
        self._acquaintance = acquaintance
        self._arms = arms

    def call(self, asked: Asked) -> robot.Call | None:
        """What the model is asked for; ``None`` for a service that changes nothing in it."""
        return robot.performed(asked.pdu, self._arms)

    def requested(self, association: str, asked: Asked) -> Iterator[Breach]:
        """A request of the client on that association."""
        body = asked.pdu.body
        if asked.pdu.service == "select" and "controlled" in body and "controlling" not in body:
            yield Breach("select.controlled-alone")
        if asked.pdu.service in robot.OBSERVING:
            self._belief.watch(asked.slot)
        call = self.call(asked)
        if call is not None:
            self._belief.indicate(asked.slot, call.service, _bindings(association, asked, call))
            self._belief.watch(asked.slot)
            self._acquaintance.expect(call)

    def answered(
        self, association: str, asked: Asked, call: robot.Call, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Finding | Breach]:
        """The robot has performed the service, or says why it has not.

        A state that stands in the answer is that of the decision: it is judged only if nothing else has been
        told since the request.
        """
        self._acquaintance.expect(call, settled=True)
        if call.service == "write" and pdu.kind == "confirmed-ResponsePDU":
            yield from self._written(association, asked, call, pdu, message)
        elif pdu.kind == "confirmed-ResponsePDU":
            yield from self._accepted(association, asked, call, message)
        else:
            yield from self._refused(association, asked, call, pdu, message)

    def _accepted(
        self, association: str, asked: Asked, call: robot.Call, message: TraceMessage
    ) -> Iterator[Finding | Breach]:
        bindings = _bindings(association, asked, call)
        outcome = self._belief.respond(asked.slot, call.service, bindings, PLUS)
        yield from self._telling.outcome(message, call.service, PLUS, outcome, (asked.index,))
        rule = self._acquaintance.stranger(call)
        if outcome.blame is None and rule:
            words = {"service": title(call.service), "pi": call.bindings["pi"]}
            yield Breach(rule, words, (asked.index,))
        self._acquaintance.meet(call)

    def _written(
        self, association: str, asked: Asked, call: robot.Call, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Finding | Breach]:
        """The answer to Write tells of each variable by itself; none written is a refusal."""
        if any(result == "success" for result, _ in pdu.body):
            yield from self._accepted(association, asked, call, message)
        else:
            self._belief.drop(asked.slot)
        yield from variables.written(asked.pdu.body, pdu.body)

    def _refused(
        self, association: str, asked: Asked, call: robot.Call, pdu: Pdu, message: TraceMessage
    ) -> Iterator[Finding]:
        rejected = pdu.kind == "rejectPDU"
        why = robot.Failure(True, False, None) if rejected else robot.failure(pdu)
        bindings = {**_bindings(association, asked, call), "destructive": why.state == "UNRUNNABLE"}
        left = None
        if self._belief.undisturbed(asked.slot) and why.state is not None:
            left = "stateAfterFailure", {"pi": bindings["pi"], "shown_state": why.state}
        outcome = self._belief.respond(
            asked.slot, call.service, bindings, MINUS, local=why.local, beside=left
        )
        yield from self._telling.outcome(message, call.service, MINUS, outcome, (asked.index,))
        if left is not None and outcome.blame is None:
            shown = self._belief.show(*left)
            yield from self._telling.outcome(message, call.service, MINUS, shown, (asked.index,))


def _bindings(association: str, asked: Asked, call: robot.Call) -> dict[str, Any]:
    return {"request": asked.slot, "user": association, **call.bindings}
