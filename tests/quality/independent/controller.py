"""The robot as a whole: its state by 6.3.4 as RP-12 reads it, who may do what, what happens at the panel."""

from __future__ import annotations

from collections.abc import Iterator

from independent.objects import (
    ARM,
    CALIBRATION,
    CONFLICT,
    CONTROLLED,
    CONTROLLING,
    DENIED,
    JOINTS,
    NORMAL,
    SAFETY,
    STATUS_CONFLICT,
    UNKNOWN,
    Domain,
    Program,
    Refusal,
)

IDLE, LOADED, READY, EXECUTING, PAUSED, INTERVENTION = (
    "robot-idle", "robot-loaded", "robot-ready", "robot-executing", "robot-motion-paused",
    "manualInterventionRequired",
)  # fmt: skip

GUARDED = frozenset({
    "start", "stop", "resume", "reset", "kill", "deleteProgramInvocation", "select", "alterPI", "vMDStop",
    "vMDReset",
})  # fmt: skip
"""Services that only the holder of R_CTRL may use."""
CHANGING = GUARDED | {
    "createProgramInvocation", "write", "initiateDownloadSequence", "deleteDomain", "loadDomainContent",
}  # fmt: skip
"""Services that local control shuts out (RP-10)."""
RUNNERS = frozenset({"start", "stop", "resume", "reset", "kill"})
NEVER_IN_INTERVENTION = frozenset({"select", "start", "resume", "vMDReset"})
ALWAYS = frozenset({"status", "identify", "vMDStop"})


class Controller:
    """The state of one robot. Whoever asks is named by the association."""

    def __init__(self, *, several: bool = False, steps: bool = True, task: bool = False) -> None:
        self.several, self.steps = several, steps
        self.programs = {
            ARM: Program(ARM, CONTROLLED, [ARM], deletable=False),
            CALIBRATION: Program(CALIBRATION, NORMAL, [CALIBRATION], deletable=False),
        }
        self.domains = {
            ARM: Domain(ARM, sharable=True, deletable=False),
            CALIBRATION: Domain(CALIBRATION, deletable=False),
            SAFETY: Domain(SAFETY, deletable=False),
        }
        if task:
            self.programs["TASK"] = Program("TASK", CONTROLLING, ["TASK"], deletable=False)
            self.domains["TASK"] = Domain("TASK", deletable=False)
        self.selected: str | None = None
        self.motion = self.intervention = self.local = self.violated = False
        self.power = True
        self.joints = [True] * JOINTS
        self.logical = self.physical = 0
        self.owner: str | None = None
        self.variables = {"Part_Count": 25}

    # What it is.

    def state(self) -> str:
        """The robot VMD state."""
        if self.intervention:
            return INTERVENTION
        if not any(p.control == CONTROLLING for p in self.programs.values()):
            return IDLE
        chosen = self.chosen()
        if chosen is None:
            return LOADED
        if chosen.state == "idle":
            return READY
        return EXECUTING if self.motion else PAUSED

    def chosen(self) -> Program | None:
        """The selected program invocation."""
        return self.programs[self.selected] if self.selected else None

    def calibrating(self) -> bool:
        return self.programs[CALIBRATION].state == "running"

    def calibrated(self) -> bool:
        return all(self.joints) and not self.calibrating()

    def users(self, domain: str) -> list[str]:
        """The program invocations that a domain is bound to."""
        return [p.name for p in self.programs.values() if domain in p.domains]

    def team(self, program: Program) -> Iterator[Program]:
        """The controlled program invocations of a controlling one."""
        return (self.programs[name] for name in program.controlled)

    def program(self, name: str) -> Program:
        if name not in self.programs:
            raise Refusal("unknown", UNKNOWN)
        return self.programs[name]

    # Who may do what.

    def admit(self, who: str, service: str) -> None:
        """What stands before every procedure: logical status, local control, intervention, R_CTRL."""
        if self.logical == 2 and service not in ALWAYS:
            raise Refusal("logical-2", STATUS_CONFLICT)
        if self.logical == 1 and service in CHANGING and service != "vMDStop":
            raise Refusal("logical-1", STATUS_CONFLICT)
        if self.logical == 3 and service in RUNNERS:
            raise Refusal("logical-3", STATUS_CONFLICT)
        if self.local and service in CHANGING:
            raise Refusal("local", DENIED)
        if self.intervention and service in NEVER_IN_INTERVENTION:
            raise Refusal("intervention", STATUS_CONFLICT)
        if service in GUARDED and self.several and self.owner != who:
            raise Refusal("control", DENIED)

    # What happens to its programs.

    def deselect(self) -> None:
        """Nothing is selected; what the selected one controlled is nobody's."""
        chosen = self.chosen()
        if chosen is not None:
            self.release(chosen)
        self.selected = None

    def release(self, program: Program) -> None:
        for member in self.team(program):
            member.controller = None
        program.controlled = []

    def halt(self, program: Program) -> None:
        """A program leaves RUNNING and stands still."""
        if program.state == "running":
            program.state = "stopped"
            if program.name == ARM:
                self.motion = False

    def fail(self, program: Program) -> None:
        """A program becomes UNRUNNABLE; if it was the selected one, that is undone first (RP-04)."""
        if self.selected == program.name:
            for member in self.team(program):
                self.halt(member)
            self.deselect()
            self.motion = False
        self.halt(program)
        program.state = "unrunnable"

    def vanish(self, program: Program) -> None:
        """A program is no more."""
        if self.selected == program.name:
            self.fail(program)
        self.release(program)
        if program.controller is not None:
            self.programs[program.controller].controlled.remove(program.name)
        del self.programs[program.name]

    # What happens by itself or at the panel.

    def emergency(self, logical: int, *, leaving: bool = True) -> None:
        """An emergency stop (5.3.1.3.3.13)."""
        if leaving:
            for program in self.programs.values():
                self.halt(program)
        self.motion, self.intervention = False, True
        self.logical, self.physical = logical, 3

    def recover(self, *, keep: bool) -> None:
        """The operator's way out; the selection is kept or cleared."""
        if not keep:
            chosen = self.chosen()
            if chosen is not None:
                for member in self.team(chosen):
                    member.state = "idle" if member.state != "unrunnable" else member.state
                chosen.state = "idle"
            self.deselect()
        self.intervention = False
        self.physical, self.logical = 0, 1 if self.local else 0

    def tick(self) -> None:
        """One cycle or step of the selected program is over; the last one ends it (6.3.2.5)."""
        chosen = self.chosen()
        if chosen is None or chosen.state != "running" or chosen.mode[1] is None:
            return
        kind, left = chosen.mode[0], chosen.mode[1] - 1
        chosen.mode = kind, left
        if left == 0 and kind == "stepLimited":
            chosen.state = "stopped"
        elif left == 0:
            self.end()

    def end(self) -> None:
        """End of execution of the selected program (RP-05)."""
        chosen = self.chosen()
        assert chosen is not None
        for member in self.team(chosen):
            member.state = "idle" if member.state != "unrunnable" else member.state
        self.motion = False
        chosen.state = "idle"
        self.deselect()

    def rest(self) -> None:
        """The arm comes to rest after its controlling program was stopped (RP-07)."""
        self.motion = False

    def finish(self, name: str) -> None:
        """A program that stands for itself is through."""
        program = self.programs[name]
        program.state = "idle" if program.reusable else "unrunnable"

    def stumble(self, name: str, error: int) -> None:
        """A program stops on its own error."""
        self.halt(self.programs[name])
        self.programs[name].error = error

    def conflict(self, program: Program, service: str) -> Refusal:
        return Refusal(f"state-{program.state}", CONFLICT, (service, program.state))
