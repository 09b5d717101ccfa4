"""What happens in a conversation with a robot, and what is under way meanwhile."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.checking import robot_messages as messages
from mmsverify.concrete.trace_path import readable
from mmsverify.formats.mms import Pdu

LOOKS = {
    "status": ("status",),
    "getProgramInvocationAttributes": (
        "getProgramInvocationAttributes",
        "noProgramInvocationAttributes",
        "listOfDomainNames",
    ),
    "getDomainAttributes": ("getDomainAttributes", "noDomainAttributes"),
    "read": (*messages.OF_VMD, *messages.OF_DEVICE, "R_DCAL", "readTogether"),
    "reportSemaphoreStatus": ("ownedTokens", "hungTokens"),
}
"""Services that show state, with the observations of the model that their answers are."""

IN_REFUSALS = ("stateAfterFailure", "uploadRefused")
"""Observations that stand in the answers of other services."""

IN_REQUESTS = ("downloadSegmentAsked", "terminateDownloadSequenceAsked")
"""Observations that are requests of the robot."""


@dataclass(frozen=True, slots=True)
class Act:
    """One thing that happens.

    ``kind`` is ``open``, ``close``, ``reset``, ``ask``, ``serve``, ``perform``, ``answer``, ``happen``,
    ``tell``, ``notify``, ``look``, ``gap`` or ``late``; ``who`` an association or a request, ``what`` a
    service or a row.
    """

    kind: str
    who: str = ""
    what: str = ""
    given: Mapping[str, Any] = field(default_factory=dict)

    def __str__(self) -> str:
        shown = " ".join(f"{k}={readable(v)}" for k, v in self.given.items() if v is not None)
        return " ".join(part for part in (self.kind, self.who, self.what, shown) if part)


@dataclass
class Pending:
    """A request on its way, and its answer once the robot has decided.

    ``missed``: messages have been lost since. If it is performed, its answer is not lost (RP-31).
    """

    user: str
    invoke_id: int
    service: str
    asked: Mapping[str, Any]
    answer: Pdu | None = None
    missed: bool = False

    @property
    def owed(self) -> bool:
        """Whether the answer must stand in the recording."""
        return self.missed and self.answer is not None
