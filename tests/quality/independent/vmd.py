"""The robot's own services, clause 7.4: Select, AlterPI, VMD Stop, VMD Reset; and the semaphore R_CTRL."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from independent.controller import EXECUTING, Controller
from independent.objects import CONFLICT, CONSTRAINT, CONTROLLED, CONTROLLING, DENIED, Program, Refusal
from independent.programs import count


def _selectable(program: Program) -> None:
    """Steps b and c."""
    if program.control != CONTROLLING:
        raise Refusal("not-controlling", CONSTRAINT)
    if program.state != "idle":
        raise Refusal("not-idle", CONFLICT)


def _controllable(robot: Controller, member: Program) -> None:
    """Step d."""
    if member.control != CONTROLLED:
        raise Refusal("not-controlled", CONSTRAINT)
    if member.controller not in (None, robot.selected):
        raise Refusal("elsewhere", CONFLICT)
    if member.state == "unrunnable":
        raise Refusal("member-unrunnable", CONFLICT)


def select(robot: Controller, body: Mapping[str, Any]) -> None:
    """7.4.4.2."""
    name, listed = body.get("controlling"), list(body.get("controlled") or ())
    if name is None and listed:
        raise Refusal("list-alone", CONSTRAINT)
    if name is not None:
        _selectable(robot.program(name))
    if len(set(listed)) != len(listed):
        raise Refusal("twice", CONSTRAINT)
    for member in map(robot.program, listed):
        _controllable(robot, member)
    chosen = robot.chosen()
    if chosen is not None and chosen.state != "idle":
        raise Refusal("selected-busy", CONFLICT)
    if name is not None and name != robot.selected and robot.programs[name].controlled:
        raise Refusal("list-not-empty", CONFLICT)
    robot.deselect()
    if name is not None:
        robot.selected = name
        robot.programs[name].controlled = listed
        for member in listed:
            robot.programs[member].controller = name


def alter(robot: Controller, body: Mapping[str, Any]) -> None:
    """7.4.5.2."""
    program = robot.program(body["programInvocation"])
    if program.control != CONTROLLING:
        raise Refusal("not-controlling", CONSTRAINT)
    program.mode = count(robot, body.get("startCount", ("cycleCount", 1)))


def vmd_stop(robot: Controller) -> None:
    """7.4.2.2."""
    robot.emergency(logical=1)


def vmd_reset(robot: Controller) -> None:
    """7.4.3.2 with the selection cleared (RP-08)."""
    if robot.state() == EXECUTING:
        raise Refusal("executing", CONFLICT)
    for program in list(robot.programs.values()):
        if program.deletable:
            robot.halt(program)
            robot.vanish(program)
    robot.deselect()
    for domain in list(robot.domains.values()):
        if domain.deletable:
            del robot.domains[domain.name]


def take(robot: Controller, who: str) -> bool:
    """TakeControl of R_CTRL: whether it is granted now."""
    if robot.owner is None:
        robot.owner = who
        return True
    return False


def relinquish(robot: Controller, who: str) -> None:
    """RelinquishControl of R_CTRL."""
    if robot.owner != who:
        raise Refusal("not-owner", DENIED)
    robot.owner = None
