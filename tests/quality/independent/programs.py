"""The services of program invocations, clause 7.3.3, step by step; all checks come first (RP-01)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from independent.controller import EXECUTING, PAUSED, Controller
from independent.objects import (
    ARM,
    CALIBRATION,
    CONFLICT,
    CONSTRAINT,
    CONTROLLED,
    CONTROLLING,
    EXISTS,
    NORMAL,
    UNKNOWN,
    Program,
    Refusal,
)

MODES = {"noLimit": "freeRunning", "cycleCount": "cycleLimited", "stepCount": "stepLimited"}


def create(robot: Controller, body: Mapping[str, Any], kind: int | None) -> None:
    """7.3.3.2.3 with what part 1 asks of domains and names."""
    name, wanted = body["programInvocationName"], body["listOfDomainNames"]
    if name in robot.programs:
        raise Refusal("exists", EXISTS)
    if not wanted or any(domain not in robot.domains for domain in wanted):
        raise Refusal("no-domain", UNKNOWN)
    for domain in map(robot.domains.__getitem__, wanted):
        if domain.state != "ready":
            raise Refusal("domain-state", CONFLICT)
        if robot.users(domain.name) and not domain.sharable:
            raise Refusal("domain-used", CONSTRAINT)
    control = (NORMAL, CONTROLLING, CONTROLLED)[kind or 0]
    robot.programs[name] = Program(name, control, list(wanted), reusable=body.get("reusable", True))


def delete(robot: Controller, name: str) -> None:
    """7.3.3.8.1; the selected one not while motion is enabled (RP-04)."""
    program = robot.program(name)
    if program.state not in ("idle", "stopped", "unrunnable"):
        raise Refusal(f"state-{program.state}", CONFLICT)
    if not program.deletable:
        raise Refusal("not-deletable", CONSTRAINT)
    if program.controller and robot.programs[program.controller].state != "idle":
        raise Refusal("controller-busy", CONFLICT)
    if robot.selected == name and robot.motion:
        raise Refusal("motion", CONFLICT)
    robot.vanish(program)


def count(robot: Controller, chosen: tuple[str, int | None]) -> tuple[str, int | None]:
    """The running mode that a StartCount asks for (RP-14)."""
    kind, value = chosen
    if value is not None and value <= 0:
        raise Refusal("count", CONSTRAINT)
    if kind == "stepCount" and not robot.steps:
        raise Refusal("steps", CONSTRAINT)
    return MODES[kind], value


def start(robot: Controller, name: str, detail: tuple[str, Any] | None) -> None:
    """7.3.3.3.3."""
    program = robot.program(name)
    if program.state != "idle":
        raise robot.conflict(program, "start")
    given = detail[1] if detail and detail[0] == "controlling" else None
    _own(robot, program, "start", given)
    if program.control != CONTROLLING:
        program.state = "running"
        return
    if robot.selected != name:
        raise Refusal("not-selected", CONFLICT, ("start", "idle"))
    mode = count(robot, (given or {}).get("startCount", ("cycleCount", 1)))
    _rouse(robot, program, "start")
    program.mode, program.state = mode, "running"


def stop(robot: Controller, name: str) -> None:
    """7.3.3.4.1."""
    program = robot.program(name)
    if program.state != "running":
        raise robot.conflict(program, "stop")
    robot.halt(program)


def resume(robot: Controller, name: str, detail: tuple[str, Any] | None) -> None:
    """7.3.3.5.3; in MOTION-PAUSED also of the selected one that is RUNNING (RP-06)."""
    program = robot.program(name)
    if program.state != "stopped" and not _waits(robot, program):
        raise robot.conflict(program, "resume")
    given = detail[1]["modeType"] if detail and detail[0] == "controlling" else None
    _own(robot, program, "resume", given)
    if program.control != CONTROLLING:
        program.state = "running"
        return
    kind, value = given or ("continueMode", None)
    if kind == "continueMode" and program.mode[1] == 0:
        raise Refusal("count-zero", CONFLICT, ("resume", program.state))
    mode = program.mode if value is None else count(robot, value)
    _rouse(robot, program, "resume")
    program.mode, program.state = mode, "running"


def reset(robot: Controller, name: str) -> None:
    """7.3.3.6.1; of the selected one not while motion is enabled (RP-07)."""
    program = robot.program(name)
    if program.state != "stopped" and not _waits(robot, program):
        raise robot.conflict(program, "reset")
    if robot.selected == name:
        if robot.motion:
            raise Refusal("motion", CONFLICT, ("reset", program.state))
        for member in robot.team(program):
            member.state = member.state if member.state == "unrunnable" else "idle"
    program.state = "idle" if program.reusable else "unrunnable"


def kill(robot: Controller, name: str) -> None:
    """7.3.3.7.1."""
    robot.fail(robot.program(name))


def _waits(robot: Controller, program: Program) -> bool:
    """The selected program runs, and only what it controls was stopped."""
    if robot.selected != program.name or program.state != "running" or robot.state() != PAUSED:
        return False
    return any(member.state == "stopped" for member in robot.team(program))


def _own(robot: Controller, program: Program, service: str, given: Any) -> None:
    """What Start and Resume ask of programs that control nothing, and of the two that share the arm."""
    state = (service, program.state)
    if program.control != CONTROLLING and given is not None:
        raise Refusal("parameter", CONSTRAINT, state)
    if program.name == ARM:
        chosen = robot.chosen()
        if chosen is None or program.controller != chosen.name or chosen.state != "running":
            raise Refusal("direct", CONFLICT, state)
        robot.motion = True
    if program.name == CALIBRATION and (
        robot.state() == EXECUTING or any(c and c.state == "running" for c in [robot.chosen()])
    ):
        raise Refusal("arm-busy", CONFLICT, state)
    if program.name == robot.selected and robot.calibrating():
        raise Refusal("calibrating", CONFLICT, state)


def _rouse(robot: Controller, program: Program, service: str) -> None:
    """The controlled ones are brought to RUNNING, or none (steps d, RP-01, RP-02)."""
    if any(member.state == "unrunnable" for member in robot.team(program)):
        raise Refusal("member-unrunnable", CONFLICT, (service, program.state))
    for member in robot.team(program):
        member.state = "running"
        if member.name == ARM:
            robot.motion = True
