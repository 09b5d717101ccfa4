"""Event notifications: each needs a cause, and each cause that is enrolled for needs one (6.3.9, 8.7, 8.8).

Which causes there are is told by the model. That a notification is missing is told at the cause, and only
where every run has it: when the same cause has certainly occurred again, when the association is concluded,
or when ``PATIENCE`` messages of the association have gone by. Where the recording ends earlier or has a gap,
nothing is missing.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit import words
from mmsverify.audit.enrollments import Cause, Enrollment
from mmsverify.audit.exchange import Asked
from mmsverify.audit.robot import plain_name
from mmsverify.audit.rules import Breach
from mmsverify.audit.showing import Showing
from mmsverify.concrete.belief import Belief
from mmsverify.formats.mms import Pdu, bits
from mmsverify.formats.trace import TraceMessage
from mmsverify.results import Finding

PATIENCE = 100
ENROLLING = frozenset({
    "defineEventEnrollment", "deleteEventEnrollment", "alterEventEnrollment", "alterEventConditionMonitoring",
})  # fmt: skip
"""Services that say what is notified from then on."""

Told = Iterator[Finding | Breach]


class Notifications:
    """The event enrollments of one device, and what is notified of them.

    ``_unsettled``: requests about enrollments that wait, with their associations; ``_mingled``: those of them
    that waited beside another one, which may have been performed before or after.
    """

    def __init__(self, belief: Belief, showing: Showing) -> None:
        self._belief = belief
        self._showing = showing
        self._enrolled: dict[str, Enrollment] = {}
        self._deleted: dict[str, str] = {}
        self._disabled: set[str] = set()
        self._unsettled: dict[str, str] = {}
        self._mingled: set[str] = set()

    # What is enrolled.

    def requested(self, association: str, asked: Asked) -> None:
        """A client asks for something: it may be performed long before the answer."""
        if asked.pdu.service in ENROLLING:
            self._belief.watch(asked.slot)
            self._mingled.discard(asked.slot)
            self._unsettled[asked.slot] = association
            if len(self._unsettled) > 1:
                self._mingled |= self._unsettled.keys()

    def answered(self, association: str, asked: Asked, pdu: Pdu, *, listens: bool, disturbed: bool) -> None:
        """The robot answers; ``listens``: the client takes notifications.

        ``disturbed``: other things have been told since the request, so the event may have occurred before
        the answer and not be told of any more, or have occurred before the service was performed.
        """
        if self._unsettled.pop(asked.slot, None) is None:
            return
        if pdu.kind == "confirmed-ResponsePDU":
            self._performed(association, asked, pdu, listens)
        if disturbed:
            self.doubt()

    def doubt(self) -> None:
        """Something is not known that may have been the cause of a notification, or not."""
        for enrollment in self._enrolled.values():
            enrollment.doubt()
            self._belief.unwatch(enrollment.slot)

    def _performed(self, association: str, asked: Asked, answer: Pdu, listens: bool) -> None:
        body = asked.pdu.body
        match asked.pdu.service:
            case "defineEventEnrollment":
                self._define(association, body, listens)
            case "deleteEventEnrollment":
                self._delete(association, body, certain=answer.body == 0 and asked.slot not in self._mingled)
            case "alterEventEnrollment" if "eventConditionTransitions" in body:
                known = self._enrolled.get(plain_name(body["eventEnrollmentName"]))
                if known is not None:
                    known.transitions = bits("Transitions", body["eventConditionTransitions"])
                    known.begin(self._belief)
            case "alterEventConditionMonitoring" if "enabled" in body:
                (self._disabled.discard if body["enabled"] else self._disabled.add)(
                    plain_name(body["eventConditionName"])
                )

    def _define(self, association: str, body: Mapping[str, Any], listens: bool) -> None:
        name, condition = plain_name(body["eventEnrollmentName"]), plain_name(body["eventConditionName"])
        causes = [Cause(o) for o in self._belief.model.occurrences if o.condition == condition]
        self._deleted.pop(name, None)
        if not causes:
            self._enrolled.pop(name, None)
            return
        made = Enrollment(
            name, association, condition, bits("Transitions", body["eventConditionTransitions"]),
            "clientApplication" in body or not listens, causes,
        )  # fmt: skip
        self._enrolled[name] = made
        made.begin(self._belief)

    def _delete(self, association: str, body: tuple[str, Any], *, certain: bool) -> None:
        """Which are deleted is certain only where they are named, none is left and none made meanwhile."""
        kind, content = body
        named = {plain_name(name) for name in content} if kind == "specific" else set(self._enrolled)
        for name in named:
            self._enrolled.pop(name, None)
            if kind == "specific" and certain:
                self._deleted[name] = association

    def lose(self) -> None:
        """Messages may be missing: anything may have been notified, enrolled, altered or deleted."""
        self._deleted.clear()
        self._enrolled.clear()
        self._unsettled.clear()

    # What occurs.

    def note(self, association: str, message: TraceMessage) -> Iterator[Breach]:
        """After every message."""
        for enrollment in self._enrolled.values():
            if enrollment.due is not None and enrollment.association == association:
                enrollment.waited += 1
                if enrollment.waited > PATIENCE:
                    yield from self._missing(enrollment, message)
                    enrollment.due = None
            if enrollment.note(self._belief, message):
                yield from self._missing(enrollment, message)
                enrollment.due, enrollment.waited = message, 0

    def concluded(self, association: str, message: TraceMessage) -> Iterator[Breach]:
        """The association has been concluded: what is due on it will not come any more."""
        for enrollment in self._enrolled.values():
            if enrollment.association == association:
                yield from self._missing(enrollment, message)
        self.ended(association)

    def ended(self, association: str) -> None:
        """The association is over, and with it what was enrolled on it."""
        self._enrolled = {n: e for n, e in self._enrolled.items() if e.association != association}
        self._deleted = {n: a for n, a in self._deleted.items() if a != association}
        self._unsettled = {s: a for s, a in self._unsettled.items() if a != association}

    def _missing(self, enrollment: Enrollment, message: TraceMessage) -> Iterator[Breach]:
        told = enrollment.must_be_told and enrollment.condition not in self._disabled
        if enrollment.due is None or not told or self._unsettled:
            return
        said = {"condition": enrollment.condition, "enrollment": enrollment.name}
        clause = enrollment.causes[0].occurrence.clause
        related = () if message.index == enrollment.due.index else (message.index,)
        yield Breach("event.missing", said, related, clause, enrollment.due)

    # What is notified.

    def notified(self, association: str, pdu: Pdu, message: TraceMessage) -> Told:
        """EventNotification of the robot."""
        body = pdu.body
        name, condition = plain_name(body["eventEnrollmentName"]), plain_name(body["eventConditionName"])
        enrollment = self._enrolled.get(name)
        if self._deleted.get(name) == association:
            yield Breach("event.deleted", {"enrollment": name})
            return
        answer = _action_result(body)
        leaving = enrollment is None or enrollment.about_causes_only
        if condition == words.ARM and answer is not None and leaving and _runs(answer):
            yield Breach("event.arm-running")
        elif enrollment is not None and self._unfounded(enrollment, condition):
            yield Breach(
                "event.unfounded", {"condition": condition}, (), enrollment.causes[0].occurrence.clause
            )
        elif answer is not None:
            yield from self._shown(answer, enrollment, message)
        if enrollment is not None:
            enrollment.begin(self._belief)

    def _unfounded(self, enrollment: Enrollment, condition: str) -> bool:
        """Of another transition than those of the causes, nothing is known."""
        if condition != enrollment.condition or not enrollment.about_causes_only:
            return False
        return not enrollment.founded(self._belief)

    def _shown(self, answer: Pdu, enrollment: Enrollment | None, message: TraceMessage) -> Told:
        """An action's result shows the state at the event; where that was long ago, it is not judged."""
        if enrollment is None or self._belief.watched(enrollment.slot) is None:
            return
        if answer.service == "status":
            yield from self._showing.status(answer.body, answer.detail, message, enrollment.slot)
        elif _of_arm(answer):
            yield from self._showing.attributes(words.ARM, answer, message, enrollment.slot)


def _action_result(body: Mapping[str, Any]) -> Pdu | None:
    """The answer that the event's action has given, if it has."""
    kind, result = (body.get("actionResult") or {}).get("eventActionResult", ("none", None))
    if kind != "success":
        return None
    service, content = result["response"]
    return Pdu("confirmed-ResponsePDU", None, service, content, result.get("detail"))


def _runs(answer: Pdu) -> bool:
    """Whether the arm's own program is shown RUNNING; the attributes do not say of which program they are."""
    return _of_arm(answer) and bool(answer.body["state"] == words.STATE.index("RUNNING"))


def _of_arm(answer: Pdu) -> bool:
    wanted = answer.service == "getProgramInvocationAttributes"
    return wanted and bool(answer.body["listOfDomainNames"] == [words.ARM])
