"""The event enrollments of a robot that keeps the rules: what it is asked for, and when it tells of what.

A cause has occurred once ``before`` held and a step made ``after`` hold. It is notified with what the action
showed then: at once or some messages later, but before it occurs again.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.audit import words
from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Moment, Valuation, holds
from mmsverify.formats.mms import Pdu, bit_string
from mmsverify.model import ModelData, Occurrence
from mmsverify.samples import pdus

DEFINE, DELETE = "defineEventEnrollment", "deleteEventEnrollment"
ENROLLING = frozenset({DEFINE, DELETE})
PATIENCE = 40
"""So many messages later an event is told at the latest."""

STATUS_ACTION = "R_STC"
BOTH = ("active-to-idle", "idle-to-active")


@dataclass
class Enrolled:
    """Who wants to be told of what; ``due``: the action's answer where it is still to be told."""

    user: str
    condition: str
    due: Pdu | None = None
    since: int = 0


class Events:
    """The enrollments of one robot, by name."""

    def __init__(self, model: ModelData, scope: Scope) -> None:
        self.scope = scope
        self.occurrences: dict[str, list[Occurrence]] = {}
        for occurrence in model.occurrences:
            self.occurrences.setdefault(occurrence.condition, []).append(occurrence)
        self.enrolled: dict[str, Enrolled] = {}

    def perform(self, service: str, asked: Mapping[str, Any], invoke_id: int) -> Pdu:
        """Something is enrolled or is no longer; the answer."""
        name = asked["enrollment"]
        if service == DEFINE and name not in self.enrolled:
            self.enrolled[name] = Enrolled(asked["user"], asked["condition"])
            return pdus.response(invoke_id, service)
        if service == DELETE and self.enrolled.pop(name, None) is not None:
            return pdus.response(invoke_id, service, 0)
        cause = "object-undefined" if service == DELETE else "object-exists"
        return pdus.failure(invoke_id, ("definition", cause))

    def released(self, user: str) -> None:
        """An association is over, and with it what was enrolled on it."""
        self.enrolled = {name: each for name, each in self.enrolled.items() if each.user != user}

    def occurring(self, state: Valuation, after: Valuation) -> list[str]:
        """The enrollments for which a cause occurs in a step."""
        return [name for name, each in self.enrolled.items() if self._occurs(each.condition, state, after)]

    def _occurs(self, condition: str, state: Valuation, after: Valuation) -> bool:
        then, now = (Moment(self.scope, each, {}) for each in (state, after))
        return any(holds(o.before, then) and holds(o.after, now) for o in self.occurrences[condition])

    def due(self, user: str | None = None) -> Iterator[str]:
        """Those of which something is still to be told."""
        for name, each in self.enrolled.items():
            if each.due is not None and user in (None, each.user):
                yield name

    def told(self, name: str) -> tuple[str, Pdu]:
        """The client, and what it is told."""
        each = self.enrolled[name]
        assert each.due is not None
        answer, each.due = each.due, None
        result = (str(answer.service), answer.body)
        action = acting(each.condition)
        body = pdus.notification(name, each.condition, action, result, answer.detail)
        return each.user, Pdu("unconfirmed-PDU", None, "eventNotification", body)

    def act(self, names: list[str], now: int, look: Callable[[str], Pdu]) -> None:
        """The actions of these are executed; ``look`` gives the answer to a service."""
        for name in names:
            each = self.enrolled[name]
            each.due, each.since = look(acting(each.condition)), now


def acting(condition: str) -> str:
    """The action that goes with a condition."""
    return words.ARM if condition == words.ARM else STATUS_ACTION


def request(invoke_id: int, service: str, asked: Mapping[str, Any]) -> Pdu:
    """The request of a client."""
    name = asked["enrollment"]
    if service == DELETE:
        return pdus.request(invoke_id, service, ("specific", [pdus.vmd(name)]))
    body = pdus.enrollment(name, asked["condition"], acting(asked["condition"]))
    if asked["both"]:
        body["eventConditionTransitions"] = bit_string("Transitions", BOTH, 7)
    return pdus.request(invoke_id, service, body)
