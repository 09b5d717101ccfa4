"""What a request asks for, by the plan of signals in a profile, and which step of the model refuses it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mmsverify.concrete.evaluate import Moment, holds
from mmsverify.concrete.scope import Binding, Scope
from mmsverify.formats.modbus import BITS, Request
from mmsverify.model import MINUS, ModelData, Row
from mmsverify.model.rows import Conjunct
from mmsverify.model.sorts import Enumeration, EnumSort

CLASSES = {"outputs": "external outputs", "inputs": "external inputs", "internals": "internal signals"}
REGISTERS, DEDICATED, BEYOND = "registers", "dedicated signals", "beyond the numbers of a class"


@dataclass(frozen=True, slots=True)
class Plan:
    """The plan of signals: which numbers are of which class, by profile."""

    profile: Mapping[str, Any]

    def points(self, request: Request) -> str:
        """What all numbers of a request are, as the model calls it."""
        first, count = request.address, max(request.quantity, 1)
        if request.function not in BITS:
            low, high = self.profile["registers"]
            return REGISTERS if low <= first and first + count - 1 <= high else BEYOND
        first += self.profile["address_offset"]
        last = first + count - 1
        for key, word in CLASSES.items():
            low, high = self.profile[key]
            if low <= first and last <= high:
                return DEDICATED if any(first <= n <= last for n in self.profile["dedicated"]) else word
        return BEYOND


class Access:
    """The refusing steps of the model's procedure for requests."""

    def __init__(self, model: ModelData, scope: Scope) -> None:
        self._scope = scope
        self._refusing: list[Row] = [
            row for row in model.actions if row.on.service == "request" and row.answer == MINUS
        ]
        self._found: dict[tuple[int, str, bool], Conjunct | None] = {}
        # The text as written refuses nothing: there, these are empty.
        sorts = {p.name: p.of for row in self._refusing for p in row.on.parameters}
        self._functions, self._points = (_by_word(sorts.get(name)) for name in ("function", "points"))

    def refusal(self, request: Request, points: str) -> Conjunct | None:
        """The condition by which a request must be refused, if any."""
        kind = request.function, points, not request.amiss
        if kind not in self._found:
            self._found[kind] = self._refusal(*kind) if self._refusing else None
        return self._found[kind]

    def _refusal(self, function: int, points: str, sound: bool) -> Conjunct | None:
        given: dict[str, Binding] = {
            "function": self._functions[f"0x{function:02X}"],
            "points": self._points[points],
            "sound": sound,
        }
        at = Moment(self._scope, {}, given)
        refusing = (row.guard[-1] for row in self._refusing if holds(row.guard[-1].condition, at))
        return next(refusing, None)


def _by_word(sort: object) -> dict[str, Enumeration]:
    """The members of an enumeration by the words that they print."""
    return {str(member.value): member for member in sort.members} if isinstance(sort, EnumSort) else {}
