"""How long an audit takes a message, beside what it takes to read and decode it only.

    python bench/replay_speed.py [MESSAGES [SEED]]

Audited are the shipped samples and a varied conversation with a robot that keeps the rules, made here from
the model's own rows: requests that are granted and refused, programs that end and fail unseen, an emergency
stop, local control. Times are CPU seconds of this process; a first audit warms up, so that importing and
reading the model files is left out.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random
from typing import Any

from mmsverify.auditing import audit_traces
from mmsverify.checking import robot_messages as messages
from mmsverify.concrete import Scope, scope_for
from mmsverify.concrete.evaluate import step, within_bounds
from mmsverify.concrete.formulas import Formulas
from mmsverify.concrete.ground import Grounding
from mmsverify.concrete.initial import initial_states
from mmsverify.concrete.layout import Layout
from mmsverify.concrete.trace_path import readable, readable_state
from mmsverify.formats import mms
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mms import Pdu
from mmsverify.formats.trace import Sender
from mmsverify.model import ModelData, Row, load
from mmsverify.model.rows import PLUS
from mmsverify.resources import models_dir
from mmsverify.samples.recording import Recording

PROGRAMS = 6
SERVICES = (
    "createProgramInvocation", "deleteProgramInvocation", "select", "select", "start", "start", "start",
    "stop", "resume", "reset", "alterPI", "kill", "vMDStop", "vMDReset",
)  # fmt: skip
SELDOM = {"kill": 0.1, "vMDStop": 0.1, "vMDReset": 0.1, "deleteProgramInvocation": 0.3}
HIDDEN = frozenset({"destructive", "panel"})
CLIENT = "client1"


class Robot:
    """A robot that keeps the rules, and the recording of what is said to it; ``random`` throws the dice."""

    def __init__(self, seed: int) -> None:
        self.random = Random(seed)
        self.model: ModelData = load("mms-robot", models_dir(), "repaired")
        made = scope_for(self.model, {"PI": PROGRAMS, "Client": 1, "Request": 1}, {"associations": "single"})
        self.scope = Scope(made.elements, made.facts, (0, 9))
        layout = Layout(self.model, self.scope)
        self.state = dict(layout.read(initial_states(Grounding(layout, Formulas()), limit=1).states[0]))
        self.recording = Recording("robot")
        self.count = 0
        self.say("client", messages.initiation("Request"))
        self.say("server", messages.initiation("Response"))
        self.taken(self.rows("response", "initiate"), {"user": CLIENT})

    def rows(self, phase: str, service: str | None = None) -> list[Row]:
        """The rows of one phase, of all services or of one."""
        return [r for r in self.model.rows if r.on.phase == phase and service in (None, r.on.service)]

    def say(self, sender: Sender, pdu: Pdu) -> None:
        """One message."""
        self.recording.say(CLIENT, sender, pdu)
        self.count += 1

    def shown(self) -> dict[str, Any]:
        """The state in the words of the messages."""
        return readable_state(self.model, self.scope, self.state)

    def bindings(self, row: Row, given: dict[str, Any]) -> dict[str, Any]:
        """The parameters of a row: those that are given, any values for the others."""
        found = {}
        for parameter in row.parameters:
            values = self.scope.parameter_values(row, parameter)
            found[parameter.name] = given.get(parameter.name, self.random.choice(values) if values else None)
        return found

    def taken(
        self, rows: list[Row], given: dict[str, Any], tries: int = 60
    ) -> tuple[Row, dict[str, Any]] | None:
        """A step of one of the rows, if one is found."""
        for _ in range(tries if rows else 0):
            row = self.random.choice(rows)
            bindings = self.bindings(row, given)
            after = step(row, bindings, self.state, self.scope)
            if after is not None and within_bounds(self.model, self.scope, after):
                self.state = after
                return row, bindings
        return None

    def exchange(self) -> None:
        """A request and its answer, mostly one that is granted."""
        service = self.random.choice(SERVICES)
        if self.random.random() > SELDOM.get(service, 1):
            return
        before = self.state
        given: dict[str, Any] = {"request": "request1", "user": CLIENT, **dict.fromkeys(HIDDEN, False)}
        hoped = self.rows("response", service)
        if self.random.random() < 0.8:
            hoped = [row for row in hoped if row.answer == PLUS]
        for _ in range(40):
            asked = self.taken(self.rows("indication", service), given, tries=5)
            said = {**given, **({} if asked is None else asked[1]), **self.limits(service)}
            answered = self.taken(hoped, said, tries=5)
            if answered is not None:
                break
            self.state = before
        else:
            return
        row, bindings = answered
        words = {name: readable(held) for name, held in {**said, **bindings}.items()}
        self.say("client", messages.request(self.count, service, words))
        self.say("server", messages.answer(self.count - 1, service, words, row.answer, self.shown()))

    def limits(self, service: str) -> dict[str, Any]:
        """A running mode as a request can say it: alterPI always gives one, resume as a kind of resuming."""
        row = next(r for r in self.rows("response", service))
        if "limit" not in {p.name for p in row.parameters}:
            return {}
        parameter = next(p for p in row.parameters if p.name == "limit")
        values = self.scope.parameter_values(row, parameter)
        limit = self.random.choice(values if service != "alterPI" else [v for v in values if v is not None])
        return {"limit": limit, "type_given": limit is not None}

    def status(self) -> None:
        """The status is asked for, or told."""
        if self.random.random() < 0.5:
            self.say("server", messages.unsolicited_status(self.shown()))
        else:
            self.say("client", messages.request(self.count, "status", {}))
            self.say("server", messages.answer(self.count - 1, "status", {}, PLUS, self.shown()))

    def attributes(self, name: str | None = None) -> None:
        """The attributes of a program invocation are asked for."""
        asked = name or self.random.choice(self.scope.elements["PI"])
        self.say("client", messages.request(self.count, "getProgramInvocationAttributes", {"pi": asked}))
        self.say("server", messages.attributes(self.count - 1, asked, self.shown()))

    def unseen(self) -> None:
        """Something happens inside; what explains an observed state only is observed at once."""
        wanted = "any" if self.random.random() < 0.9 else "observation"
        rows = [row for row in self.rows("internal") if row.explains == wanted]
        if self.taken(rows, {"taken": False}, tries=20) and wanted == "observation":
            self.say("server", messages.unsolicited_status(self.shown()))
            for name in self.scope.elements["PI"]:
                self.attributes(name)

    def talk(self, count: int) -> None:
        """As many messages."""
        acts: list[Callable[[], None]] = [self.exchange] * 6 + [self.unseen] * 3
        acts += [self.status, self.attributes]
        while self.count < count:
            self.random.choice(acts)()


def seconds(work: Callable[[], object]) -> float:
    """CPU time."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def decode(path: Path) -> None:
    """Read and decode only."""
    for message in read_trace(path):
        if message.message_encoding == "mms-ber":
            mms.decode(message.data)


def line(path: Path) -> str:
    """One row of the table."""
    found: list[Any] = []
    audited = seconds(lambda: found.append(audit_traces([path], profile=None, model=None)))
    decoded = seconds(lambda: decode(path))
    count = found[0].inputs[0].messages
    return (
        f"{path.name:24} {count:8} {1000 * audited / count:10.2f} {1000 * decoded / count:10.2f}"
        f" {audited / decoded:8.1f} {len(found[0].findings):9}"
    )


def recordings(folder: Path, count: int, seed: int) -> Iterator[Path]:
    """The samples, and the conversation that is made."""
    yield from sorted((Path(__file__).parent.parent / "traces").glob("*.mcap"))
    robot = Robot(seed)
    robot.talk(count)
    robot.recording.write(folder / f"varied-{seed}.mcap", {"model": "mms-robot", "associations": "single"})
    yield folder / f"varied-{seed}.mcap"


def main() -> None:
    """Print the table."""
    count, seed = (*map(int, sys.argv[1:3]), *(1000, 1)[len(sys.argv[1:3]) :])
    sample = Path(__file__).parent.parent / "traces" / "annex-a.mcap"
    audit_traces([sample], profile=None, model=None)
    print(f"{'recording':24} {'messages':>8} {'audit ms':>10} {'decode ms':>10} {'ratio':>8} {'findings':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for path in recordings(Path(folder), count, seed):
            print(line(path), flush=True)


if __name__ == "__main__":
    main()
