"""What a client may ask for, at random: mostly what makes sense now, at times what does not.

What the client's own side of the standard forbids, it does not ask for; `unsettled` tells what the text and
its readings leave open, so that the robot puts it off.
"""

from __future__ import annotations

from random import Random
from typing import Any

from independent import desk
from independent.controller import EXECUTING, PAUSED, RUNNERS, Controller
from independent.objects import ARM, CALIBRATION, CONTROLLED, CONTROLLING
from mmsverify.formats.mms import Pdu
from mmsverify.samples import pdus

NAMES = ("PAINT", "WELD", "TOOL", "COUNT")
KINDS = {"PAINT": 1, "WELD": 1, "TOOL": 2, "COUNT": 0}
ITEMS = (
    "R_VPWR", "R_VCAL", "R_VLOCAL", "R_VSAFEV", "R_ARM.R_DPWR", "R_ARM.R_DCAL", "R_ARM.R_DLOCAL",
    "R_ARM.R_NJ",
    "R_ARM.R_JT", "R_ARM.R_JCAL", "R_ARM.R_JBK", "R_ARM.R_JBD", "R_ARM.R_AJV", "R_ARM.R_SF", "R_ARM.R_TUB",
    "R_ARM.R_ATUP", "Part_Count", "No_Such",
)  # fmt: skip

Wish = tuple[str, Any, Any]


def wish(robot: Controller, chance: Random) -> Wish:
    """A request: service, body, detail."""
    return chance.choices([poll, forward, act, stray], [4, 8, 3, 1])[0](robot, chance)


def poll(robot: Controller, chance: Random) -> Wish:
    """Something is looked at."""
    kind = chance.randrange(10)
    if kind < 3:
        return "status", chance.random() < 0.3, None
    if kind < 7:
        return "getProgramInvocationAttributes", chance.choice([*robot.programs, "WELD"]), None
    if kind == 7:
        return "getDomainAttributes", chance.choice([*robot.domains, "TOOL"]), None
    if kind == 8 and robot.several:
        return "reportSemaphoreStatus", pdus.vmd("R_CTRL"), None
    items = chance.sample(ITEMS, chance.randint(1, 4))
    return "read", pdus.reading(*map(desk.name_of, items)), None


def forward(robot: Controller, chance: Random) -> Wish:
    """The next step of a working day, as far as the client can see."""
    if robot.several and robot.owner is None and chance.random() < 0.5:
        return "takeControl", desk.control(), None
    chosen = robot.chosen()
    missing = [name for name in NAMES if name not in robot.domains]
    if missing and chance.random() < 0.3:
        name = chance.choice(missing)
        if chance.random() < 0.3:
            return "loadDomainContent", desk.loading(name), None
        return "initiateDownloadSequence", desk.download(name), None
    unmade = [name for name in NAMES if name in robot.domains and name not in robot.programs]
    if unmade and chance.random() < 0.6:
        name = chance.choice(unmade)
        body = desk.creation(name, reusable=KINDS[name] != 0 or chance.random() < 0.5)
        return "createProgramInvocation", body, KINDS[name] or None
    able = [p for p in robot.programs.values() if p.control == CONTROLLING]
    if chosen is None and able:
        return "select", desk.selection(chance.choice(able).name, *members(robot, chance)), None
    if chosen is None:
        return poll(robot, chance)
    if chosen.state == "idle":
        return "start", desk.named(chosen.name), desk.starting(*counted(robot, chance))
    if robot.state() == PAUSED or chosen.state == "stopped":
        return going_on(robot, chance, chosen.name)
    return "stop", desk.named(chance.choice([ARM, chosen.name])), None


def going_on(robot: Controller, chance: Random, name: str) -> Wish:
    if chance.random() < 0.3:
        return "reset", desk.named(name), None
    if chance.random() < 0.3:
        return "resume", desk.named(ARM), None
    if chance.random() < 0.5:
        return "resume", desk.named(name), desk.resuming()
    return "resume", desk.named(name), desk.resuming(*counted(robot, chance))


def members(robot: Controller, chance: Random) -> list[str]:
    free = [p.name for p in robot.programs.values() if p.control == CONTROLLED]
    listed = [name for name in free if chance.random() < (0.9 if name == ARM else 0.5)]
    chance.shuffle(listed)
    return listed


def counted(robot: Controller, chance: Random) -> tuple[str, int | None]:
    kind = chance.choice(["noLimit", "cycleCount", "stepCount" if robot.steps else "cycleCount"])
    return kind, None if kind == "noLimit" else chance.randint(1, 3)


def act(robot: Controller, chance: Random) -> Wish:
    """Any service on any object that is there."""
    name = chance.choice([*robot.programs, "PAINT"])
    program = robot.programs.get(name)
    controlling = program is not None and program.control == CONTROLLING
    service = chance.choice(
        ["start", "stop", "resume", "reset", "deleteProgramInvocation", "alterPI", "select", "takeControl"]
    )
    if service == "deleteProgramInvocation":
        return service, name, None
    if service == "alterPI":
        return service, desk.altering(name, *counted(robot, chance)), None
    if service == "select":
        return service, desk.selection(chance.choice([name, None]), *[]), None
    if service == "takeControl":
        return semaphore(robot, chance)
    detail = None
    if controlling:
        starting, resuming = desk.starting(*counted(robot, chance)), desk.resuming()
        detail = {"start": starting, "resume": resuming}.get(service)
    return service, desk.named(name), detail


def semaphore(robot: Controller, chance: Random) -> Wish:
    if not robot.several:
        return poll(robot, chance)
    if chance.random() < 0.4:
        return "relinquishControl", {"semaphoreName": pdus.vmd("R_CTRL")}, None
    return "takeControl", desk.control(), None


def stray(robot: Controller, chance: Random) -> Wish:
    """What is seldom asked for."""
    kind = chance.randrange(8)
    if kind == 0:
        return "vMDStop", None, None
    if kind == 1:
        return "vMDReset", chance.random() < 0.5, None
    if kind == 2:
        return "deleteDomain", chance.choice([*robot.domains, "NONE"]), None
    if kind == 3:
        return "kill", desk.named(chance.choice([*(set(robot.programs) - {ARM, CALIBRATION}), "NONE"])), None
    if kind == 4:
        return "write", desk.writing("Part_Count", ("integer", chance.randrange(100))), None
    if kind == 5:
        return "identify", None, None
    if kind == 6:
        free = [name for name in robot.programs if name != robot.selected]
        listed = chance.sample(free, min(2, len(free)))
        return "select", desk.selection(chance.choice([*robot.programs, "NONE"]), *listed), None
    return "start", desk.named(CALIBRATION), None


def unsettled(robot: Controller, asked: Pdu) -> bool:
    """Whether the text leaves open what the robot must answer now."""
    service = asked.service
    name = asked.body.get("programInvocationName") if isinstance(asked.body, dict) else None
    chosen = robot.chosen()
    if service in RUNNERS and name == CALIBRATION and chosen is not None:
        return chosen.state == "stopped" or (robot.state() == EXECUTING and chosen.state != "running")
    if service in ("resume", "reset") and chosen is not None and name == chosen.name:
        team = [member.state for member in robot.team(chosen)]
        return chosen.state == "running" and "stopped" not in team and "idle" in team
    if service in ("takeControl", "relinquishControl"):
        return robot.logical != 0 or robot.local
    if service == "vMDReset":
        busy = [p for p in robot.programs.values() if not p.deletable and p.state != "idle"]
        return bool(busy) or any(d.state != "ready" for d in robot.domains.values())
    return False
