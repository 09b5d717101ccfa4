"""Event notifications: each needs a cause since its enrollment, or since the last notification."""

from __future__ import annotations

from collections.abc import Iterator

from mmsverify.audit.rules import Breach
from mmsverify.concrete.belief import Belief
from mmsverify.formats.mms import Pdu


class Notifications:
    """The event conditions that somebody has enrolled for, and whether their causes may have come to hold."""

    def __init__(self, belief: Belief) -> None:
        self._belief = belief
        self._founded: dict[str, bool] = {}

    def enrolled(self, request: Pdu) -> None:
        """DefineEventEnrollment has been answered positively."""
        condition = request.body["eventConditionName"][1]
        if isinstance(condition, str):
            self._founded[condition] = self._possible(condition)

    def _possible(self, condition: str) -> bool:
        """Whether the state from which the condition's transition leads may hold now.

        Of an unknown condition nothing is known, so that it always may.
        """
        if condition == "R_RVS":
            return self._belief.may_be("robot_state", (), "ROBOT-EXECUTING")
        if condition == "R_ARM":
            return any(self._belief.may_be("state", ("R_ARM",), state) for state in ("RUNNING", "STOPPING"))
        return True

    def note(self) -> None:
        """After every message: a cause that was impossible until now may have become possible."""
        for condition, founded in self._founded.items():
            if not founded:
                self._founded[condition] = self._possible(condition)

    def notified(self, pdu: Pdu) -> Iterator[Breach]:
        """EventNotification of the robot."""
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
