"""Random runs of a controller that keeps the template framework's rules, made from the model's own rows.

Scan by scan: an operator's panel writes VR(C_Cmd), one scan later Cmd02 makes of it what the rows allow and
clears it; the action of a mode ends when it likes, and SetNextMode leads on; the status is set at the
beginning of a scan and, as the tasks happen to meet, at its end too. One change of the mode a scan.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

from mmsverify.concrete.automaton import Automaton
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.formats.vr import encode
from mmsverify.model import ModelData, load
from mmsverify.model.load import made_for
from mmsverify.profiles import load_profile
from mmsverify.resources import models_dir

NAME = "press"
BEGIN, SCAN = 1_764_000_000_000_000_000, 4_000_000
NUMBERINGS = ("11-14", "13-16")
UNKNOWN = (11, 100, 200, 300, 400, 500, -1)
BREAKING = {"stop", "onErrB", "onErrS"}
FLOW = ("pause", "step", "resume")
Cells = dict[str, float]


@cache
def framework(variant: str = "repaired", machine: str = "") -> ModelData:
    """The model; that of the machine of a shipped profile, with its own commands."""
    model = load("vr-template", models_dir(), variant)
    return made_for(model, load_profile(machine)["vr-template"]) if machine else model


@cache
def automaton(machine: str = "") -> Automaton:
    """All its states."""
    model = framework(machine=machine)
    return Automaton(Machine(model, scope_for(model, {}, {})))


class Run:
    """One controller at work; ``samples`` tells what its cells hold at the end of each scan."""

    def __init__(self, seed: int, numbering: str = "11-14", machine: str = "") -> None:
        self._random = Random(seed)
        self._automaton, self._machine = automaton(machine), machine
        numbers = framework(machine=machine).options["numbers"]
        self._modes = {str(mode): number for number, mode in numbers["mode"].items()}
        self._statuses = {str(s): n for n, (s, *_) in numbers["status"](numbering).items()}
        self._commands: Mapping[int, str] = numbers["command"]
        self._basic = sorted(n for n in self._commands if n <= 10)
        self._sub_modes: Mapping[str, int | None] = numbers["sub_mode"]
        self._users = sorted(n for n in self._commands if n > 100)
        start = sorted(self._automaton.machine.start.states)
        self.state = self._automaton.states.index(self._random.choice(start))
        self.taken: set[str] = set()
        self._pausing = False
        self._cells: Cells = {"C_Cmd": 0, "C_SubMD": 0, "CF_Pause": 0, "CS_RunStepCount": 0, "CS_ErrId": 0}

    def samples(self, count: int) -> Iterator[Cells]:
        """So many scans, the state at power-on first."""
        yield self._shown()
        for _ in range(count - 1):
            self._scan()
            yield self._shown()

    def _scan(self) -> None:
        self._try("set_pre_mode")
        command, self._cells["C_Cmd"] = int(self._cells["C_Cmd"]), 0
        if not self._cmd02(command) and self._random.random() < 0.3:
            self._try("set_next_mode")
        if self._random.random() < 0.02:
            self._try("auto_org_changes")
        if self._machine and self._random.random() < 0.5:
            self._try("action")
        if self._pausing and self._random.random() < 0.4:
            self._pausing = False
            self._try(self._random.choice(("pause", "step")))
        if self._random.random() < 0.7:
            self._try("set_pre_mode")
        self._cells["CS_RunStepCount"] = self._random.randrange(3)
        if self._random.random() < 0.3:
            self._cells["C_Cmd"] = self._given()

    def _given(self) -> int:
        """What the operator asks for: often what leads on from here, else anything, lawful or not."""
        open_here = {
            edge.row.on.service
            for edge in self._automaton.edges[self.state]
            if edge.row.answer == "result(+)"
        }
        onward = [n for n, command in self._commands.items() if command in open_here - BREAKING]
        if onward and self._random.random() < 0.6:
            basic = [n for n in onward if n <= 10]
            return self._random.choice(basic if basic and self._random.random() < 0.7 else onward)
        (numbers,) = self._random.choices((self._basic, self._users, UNKNOWN), (12, 6, 1))
        return int(self._random.choice(numbers))

    def _cmd02(self, number: int) -> bool:
        """Whether the mode was set. A pause takes effect where the user's code asks for it, maybe later."""
        command = self._commands.get(number)
        if command is None:
            return False
        if command in FLOW:
            self._pausing = self._holds("mode") == "Run" and command != "resume"
            if command != "pause":
                self._try("resume")
            self._cells["CF_Pause"] = int(self._pausing)
            return False
        if not self._try(command):
            self._cells["CS_ErrId"] = 2
            return False
        self._cells["CS_ErrId"] = 0
        if number > 100:
            set_to = self._sub_modes[command]
            self._cells["C_SubMD"] = number % 100 if set_to is None else set_to
        return True

    def _try(self, event: str) -> bool:
        """Take one of the steps of an event that are open and grant it, if there are any."""
        edges = self._automaton.edges[self.state]
        steps = [e for e in edges if e.row.on.service == event and e.row.answer != "result(-)"]
        if steps:
            step = self._random.choice(steps)
            self.taken.add(step.row.id)
            self.state = step.target
        return bool(steps)

    def _holds(self, name: str) -> str:
        return str(self._automaton.value(self.state, name))

    def _shown(self) -> Cells:
        flags = {"CF_Home": "homed", "CF_AutoOrg": "auto_org"}
        return {
            "C_RunMD": self._modes[self._holds("mode")],
            "CS_RunSTA": self._statuses[self._holds("status")],
            **{cell: int(self._holds(name) == "True") for cell, name in flags.items()},
            **self._cells,
        }


def run(seed: int, count: int, machine: str = "") -> list[Cells]:
    """A random run; its numbering goes by the seed, and every third recording begins in mid-operation."""
    late = seed % 97 if seed % 3 == 2 else 0
    return [*Run(seed, numbering(seed), machine).samples(count + late)][late:]


def numbering(seed: int) -> str:
    """The table of sub-action statuses that the controller of a seed goes by."""
    return NUMBERINGS[seed % 2]


def profile(seed: int) -> dict[str, str]:
    """What the recording says of it: of two runs with each numbering, one says it."""
    return {"sub_action_status": numbering(seed)} if seed % 4 < 2 else {}


def thinned(samples: Sequence[Cells], seed: int) -> list[Cells]:
    """What is left of a run where samples are taken now and then."""
    random = Random(seed)
    longest = random.choice((2, 5, 40))
    kept, at = [], random.randrange(longest)
    while at < len(samples):
        kept.append(samples[at])
        at += random.randint(1, longest)
    return kept


def sparse(samples: Sequence[Cells], seed: int) -> Iterator[Cells]:
    """The same, with cells that did not change left out at times, and numbers as controllers store them."""
    random, held = Random(seed), dict[str, float]()
    for cells in samples:
        told = {k: v for k, v in cells.items() if held.get(k) != v or random.random() < 0.2}
        held = cells
        yield {k: float(v) if random.random() < 0.5 else v for k, v in told.items()}


def write(
    path: Path, sampling: Any, samples: Sequence[Mapping[str, Any]], said: Mapping[str, str] | None = None
) -> Path:
    """Samples as a recording."""
    channel = Channel.vr(NAME, sampling)
    with TraceWriter(path) as trace:
        if said:
            trace.add_profile({"model": "vr-template", **said})
        for number, cells in enumerate(samples):
            trace.add(BEGIN + number * SCAN, channel, encode(cells))
    return path
