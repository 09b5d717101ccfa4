"""Where a robot stands when a fault is told of it."""

from __future__ import annotations

from collections.abc import Callable

from independent.desk import Desk
from independent.objects import ARM, CALIBRATION


def normal(state: str) -> Callable[[Desk], None]:
    """A NORMAL program COUNT in a state."""

    def come(d: Desk) -> None:
        d.create("COUNT", 0)
        d.attributes("COUNT")
        if state in ("running", "stopped"):
            d.run("start", "COUNT")
        if state == "stopped":
            d.run("stop", "COUNT")
        if state == "unrunnable":
            d.run("kill", "COUNT")
        d.status()
        d.attributes("COUNT")

    return come


def two(d: Desk) -> None:
    """PAINT selected with the arm, WELD beside it."""
    d.create("WELD")
    d.create("TOOL", 2)
    d.ready("PAINT")
    d.absent("NEW", "NONE")


def running(d: Desk) -> None:
    d.create("WELD")
    d.create("TOOL", 2)
    d.executing("PAINT")


def calibrating(d: Desk) -> None:
    two(d)
    d.run("start", CALIBRATION)
    d.attributes(CALIBRATION)


def dead_arm(d: Desk) -> None:
    two(d)
    d.run("kill", ARM)
    d.look()


def exhausted(d: Desk) -> None:
    """PAINT has made its steps; the arm stands."""
    d.executing("PAINT", "stepCount", 1)
    d.robot.tick()
    d.look()
    d.robot.rest()
    d.look()


def coasting(d: Desk) -> None:
    """PAINT was stopped, the arm moves on."""
    running(d)
    d.run("stop", "PAINT")
    d.look()


def fresh(d: Desk) -> None:
    """A domain without a program."""
    d.absent("NEW")
    d.download("NEW")
    d.refused("getProgramInvocationAttributes", "NEW")
    d.status()
