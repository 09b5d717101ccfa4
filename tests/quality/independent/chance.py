"""Conversations at random: several clients, requests outstanding, answers out of order, a robot at work."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from random import Random

from independent import programs, vmd
from independent.controller import EXECUTING, Controller
from independent.desk import Desk, starting
from independent.objects import ARM, CALIBRATION, CONTROLLING, NORMAL, Refusal
from independent.server import Outcome, negative, positive
from independent.tape import Tape
from independent.wishes import counted, members, unsettled, wish
from mmsverify.formats.mms import Pdu


@dataclass
class Line:
    """An association with what is under way on it."""

    desk: Desk
    open: bool = False
    waiting: list[Pdu] = field(default_factory=list)
    ready: list[Pdu] = field(default_factory=list)
    loading: str = ""
    of_robot: Pdu | None = None


class Talk:
    """A robot among its clients."""

    def __init__(self, seed: int, name: str = "cell") -> None:
        self.chance = Random(seed)
        several = self.chance.random() < 0.4
        self.robot = Controller(
            several=several, steps=self.chance.random() < 0.8, task=self.chance.random() < 0.25
        )
        self.tape = Tape(name)
        count = self.chance.randint(2, 3) if several else 1
        outstanding = self.chance.choice([1, 1, 1, 2, 2, 4])
        self.lines = [Line(Desk(self.tape, self.robot, f"a{i}", outstanding)) for i in range(count)]
        self.calm = self.chance.random() < 0.3

    @property
    def profile(self) -> dict[str, str]:
        """What the file says of this robot."""
        predefined = [
            '{"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": false}',
            '{"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": false}',
        ]
        if "TASK" in self.robot.domains:
            predefined.append(
                '{"name": "TASK", "control": "CONTROLLING", "domains": ["TASK"], "deletable": false}'
            )
        return {
            "associations": "multiple" if self.robot.several else "single",
            "step_limited": "true" if self.robot.steps else "false",
            "predefined": f"[{', '.join(predefined)}]",
        }

    def hold(self, count: int) -> Tape:
        """Speak until there are about ``count`` messages."""
        while len(self.tape.messages) < count:
            self.chance.choices(
                [self.client, self.serve, self.answer, self.load, self.happen, self.link],
                [5, 8, 8, 5, 1 if self.calm else 2, 0.1],
            )[0]()
        return self.tape

    # What the sides do.

    def lines_where(self, test: Callable[[Line], bool]) -> Line | None:
        found = [line for line in self.lines if line.open and test(line)]
        return self.chance.choice(found) if found else None

    def client(self) -> None:
        """A client asks, or opens its association."""
        line = self.chance.choice(self.lines)
        if not line.open:
            line.desk.open(link=self.chance.random() < 0.9)
            line.open = True
        elif len(line.waiting) + len(line.ready) < line.desk.outstanding:
            line.waiting.append(line.desk.request(*wish(self.robot, self.chance)))

    def serve(self) -> None:
        """The robot performs a request."""
        line = self.lines_where(lambda line: bool(line.waiting))
        if line is None:
            return
        asked = line.waiting[0]
        busy = bool(line.loading) and asked.service == "initiateDownloadSequence"
        if busy or unsettled(self.robot, asked):
            self.happen()
            return
        line.waiting.pop(0)
        self.stumble(asked)
        outcome = line.desk.perform(asked)
        self.note(line, asked, outcome)
        line.ready.append(outcome.pdu)

    def note(self, line: Line, asked: Pdu, outcome: Outcome) -> None:
        """A download begins; the robot asks for no two at a time on one association."""
        if asked.service == "initiateDownloadSequence" and not outcome.why:
            line.loading = asked.body["domainName"]

    def answer(self) -> None:
        """The robot says what came of a request."""
        line = self.lines_where(lambda line: bool(line.ready))
        if line is not None:
            pdu = line.ready.pop(self.chance.randrange(len(line.ready)))
            line.desk.say("server", pdu)

    def load(self) -> None:
        """A download goes on by a message: the robot's request, or what the client gives."""
        line = self.lines_where(lambda line: bool(line.loading) and not line.ready)
        if line is None or any(asked.service == "initiateDownloadSequence" for asked in line.waiting):
            return
        domain, desk = self.robot.domains[line.loading], line.desk
        if line.of_robot is None:
            desk.of_robot += 1
            last = domain.left == 0
            body = {"domainName": domain.name} if last else domain.name
            service = "terminateDownloadSequence" if last else "downloadSegment"
            line.of_robot = Pdu("confirmed-RequestPDU", desk.of_robot, service, body)
            desk.say("server", line.of_robot)
            return
        asked, line.of_robot = line.of_robot, None
        if asked.service == "terminateDownloadSequence":
            desk.say("client", positive(asked))
            domain.state, domain.link, line.loading = "ready", "", ""
            return
        domain.left -= 1
        domain.state = "loading" if domain.left else "complete"
        desk.say(
            "client", positive(asked, {"loadData": ("non-coded", b"GO"), "moreFollows": domain.left > 0})
        )

    def link(self) -> None:
        """An association ends, in order or not."""
        line = self.lines_where(lambda line: not line.waiting and not line.ready and not line.loading)
        if line is not None:
            line.desk.close()
            line.open = False
            return
        line = self.lines_where(lambda _: self.chance.random() < 0.3)
        if line is not None:
            line.desk.abort()
            line.open, line.loading, line.of_robot = False, "", None
            line.waiting.clear()
            line.ready.clear()

    # What happens.

    def happen(self) -> None:
        """Something happens inside the robot or at its panel; what must be shown is shown at once."""
        robot, chance = self.robot, self.chance
        if robot.intervention:
            if chance.random() < 0.15 and self.shown():
                robot.recover(keep=chance.random() < 0.6)
                self.show()
            return
        if chance.random() < 0.04 and self.shown():
            robot.violated = robot.violated or chance.random() < 0.5
            robot.emergency(chance.choice([1, 1, 2, 3]), leaving=chance.random() < 0.8)
            self.show()
        elif chance.random() < (0.3 if robot.local else 0.05) and self.shown() and not self.loading():
            robot.local = not robot.local
            robot.logical = chance.choice([1, 1, 2, 3]) if robot.local else 0
            self.show()
        elif robot.local and not self.loading() and chance.random() < 0.6:
            self.panel()
        else:
            chance.choices([self.go_on, self.devices, self.tell], [4, 1, 1])[0]()

    def loading(self) -> bool:
        return any(line.loading for line in self.lines)

    def shown(self) -> bool:
        """Whether somebody is there to be told."""
        return any(line.open for line in self.lines)

    def show(self) -> None:
        for line in self.lines:
            if line.open:
                line.desk.unasked()

    def tell(self) -> None:
        line = self.lines_where(lambda _: True)
        if line is not None:
            line.desk.unasked()

    def go_on(self) -> None:
        """Programs go on and come to their ends."""
        robot, chance = self.robot, self.chance
        chosen = robot.chosen()
        if robot.state() == EXECUTING and chosen is not None:
            if chosen.state == "running":
                robot.tick()
            else:
                robot.rest()
        for program in list(robot.programs.values()):
            if program.control == NORMAL and program.state == "running" and chance.random() < 0.4:
                robot.finish(program.name)
                if program.name == CALIBRATION:
                    robot.joints = [chance.random() < 0.95 for _ in robot.joints]

    def devices(self) -> None:
        """Power, calibration and interlocks change."""
        robot, chance = self.robot, self.chance
        if robot.state() == EXECUTING or robot.calibrating():
            return
        robot.power = chance.random() < 0.8
        robot.violated = chance.random() < 0.2
        if chance.random() < 0.3:
            robot.joints[chance.randrange(len(robot.joints))] = chance.random() < 0.5

    def stumble(self, asked: Pdu) -> None:
        """A program that is looked at has just stopped on its own error."""
        program = self.robot.programs.get(asked.body if isinstance(asked.body, str) else "")
        if asked.service != "getProgramInvocationAttributes" or program is None or self.robot.local:
            return
        if program.state == "running" and program.name != CALIBRATION and self.chance.random() < 0.1:
            self.robot.stumble(program.name, self.chance.randint(1, 9))

    def panel(self) -> None:
        """The operator does something to a program."""
        robot, chance = self.robot, self.chance
        program = chance.choice(list(robot.programs.values()))
        detail = starting(*counted(robot, chance)) if program.control == CONTROLLING else None
        acts: list[Callable[[], None]] = [
            lambda: programs.start(robot, program.name, detail),
            lambda: programs.stop(robot, program.name),
            lambda: programs.resume(robot, program.name, None),
            lambda: programs.reset(robot, program.name),
            lambda: programs.delete(robot, program.name),
            lambda: vmd.select(robot, {"controlling": program.name, "controlled": members(robot, chance)}),
        ]
        body = {"programInvocationName": program.name}
        doing, service = chance.choice(list(zip(acts, ["start", "", "resume", "reset", "", ""], strict=True)))
        if service and unsettled(robot, Pdu("confirmed-RequestPDU", 1, service, body)):
            return
        try:
            doing()
        except Refusal:
            return


__all__ = ["ARM", "Line", "Talk", "negative"]
