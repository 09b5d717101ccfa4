"""Which program invocations a recording has made known (reading RP-21).

ROBOT-IDLE means that no task program is available (5.3.1.3.2.1), as after power-on. Where a recording shows
that from its first connection on, what acts without having been predefined, created or shown is not there.
Elsewhere it may be one that is no task program and older than the recording: that is worth a note. Nothing
is said before ROBOT-IDLE is seen, nor after local control or a gap.
"""

from __future__ import annotations

from collections.abc import Iterable

from mmsverify.audit.robot import Call

ACTING = frozenset({"start", "stop", "resume", "reset", "kill", "deleteProgramInvocation", "alterPI"})
CREATING = "createProgramInvocation"
NAMING = ("pi", "selected_is", "controller_is", "controlling")


class Acquaintance:
    """The names known, and whether any other can be excluded: ``closed``."""

    def __init__(self, predefined: Iterable[str]) -> None:
        self._known = set(predefined)
        self._expected: list[str] = []
        self.closed = False
        self._whole: bool | None = None

    def begin(self, *, opening: bool) -> None:
        """Something is recorded; if it opens a connection and comes first, the recording lacks nothing."""
        if self._whole is None:
            self._whole = opening

    def expect(self, call: Call, *, settled: bool = False) -> None:
        """What is asked for may be created before the answer says so; once that is there, it tells."""
        if call.service == CREATING and settled and call.bindings["pi"] in self._expected:
            self._expected.remove(call.bindings["pi"])
        elif call.service == CREATING and not settled:
            self._expected.append(call.bindings["pi"])

    def meet(self, call: Call) -> None:
        """A message has shown or created what it names; Status says whether any other can be there."""
        for key in NAMING:
            if isinstance(call.bindings.get(key), str):
                self._known.add(call.bindings[key])
        for key in ("listed", "controlled"):
            self._known |= call.bindings.get(key, frozenset())
        if call.bindings.get("shown_local"):
            self.lose()
        elif call.bindings.get("shown_robot") == "ROBOT-IDLE":
            self.closed = True

    def lose(self) -> None:
        """Something may have been created unseen."""
        self.closed = self._whole = False

    def stranger(self, call: Call) -> str:
        """The rule that is broken where the service acts on a program invocation that nothing has shown."""
        known = {*self._known, *self._expected}
        if not self.closed or call.service not in ACTING or call.bindings.get("pi") in known:
            return ""
        return "program.never-shown" if self._whole else "program.not-shown-yet"
