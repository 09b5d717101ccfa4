"""What the robot is made of: program invocations, domains, an arm with joints; why a request is refused."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

NORMAL, CONTROLLING, CONTROLLED = "normal", "controlling", "controlled"
ARM, CALIBRATION, SAFETY = "R_ARM", "R_CAL", "R_SAFE"
JOINTS = 6

FREE: tuple[str, int | None] = ("freeRunning", None)


@dataclass
class Program:
    """A program invocation with what 6.3.2 adds to it."""

    name: str
    control: str
    domains: list[str]
    deletable: bool = True
    reusable: bool = True
    state: str = "idle"
    error: int = 0
    controlled: list[str] = field(default_factory=list)
    controller: str | None = None
    mode: tuple[str, int | None] = FREE


@dataclass
class Domain:
    """A domain; ``left`` are the segments that its download wants, ``link`` the association that loads."""

    name: str
    sharable: bool = False
    deletable: bool = True
    state: str = "ready"
    link: str = ""
    left: int = 0
    uploads: int = 0


class Refusal(Exception):  # noqa: N818 - a refusal is an answer, not an error
    """A negative answer: error class and code, why in a word, and the state that the program was left in."""

    def __init__(self, why: str, cause: tuple[str, str], info: tuple[str, str] | None = None) -> None:
        super().__init__(why)
        self.why, self.cause, self.info = why, cause, info


CONFLICT = ("service", "object-state-conflict")
CONSTRAINT = ("service", "object-constraint-conflict")
STATUS_CONFLICT = ("vmd-state", "vmd-state-conflict")
UNKNOWN = ("access", "object-non-existent")
DENIED = ("access", "object-access-denied")
EXISTS = ("definition", "object-exists")

Answer = tuple[Any, Any]
"""Body and robot detail of a positive answer."""
