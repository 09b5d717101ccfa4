"""One kind of fault: a conversation in which exactly one message is wrong, and what may be cited."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from independent.controller import Controller
from independent.desk import Desk
from independent.tape import Tape
from mmsverify.formats.mms import Pdu, number

Run = Callable[[Desk], None]


@dataclass(frozen=True)
class Fault:
    """``level`` is ``error``, or ``any`` where a warning will do; ``back`` and ``ahead``: so many
    messages earlier or later will do, where the fault may be the request's, or where only what is seen next
    rules out that the program had just ended by itself."""

    name: str
    run: Run
    clauses: tuple[str, ...]
    level: str = "error"
    back: int = 0
    ahead: int = 0
    robot: Mapping[str, Any] | None = None
    ends: bool = False

    def places(self, tape: Tape) -> range:
        """Where a finding may stand."""
        return range(tape.faults[0] - self.back, tape.faults[0] + self.ahead + 1)

    @property
    def profile(self) -> dict[str, str]:
        given = self.robot or {}
        return {
            "associations": "multiple" if given.get("several") else "single",
            "step_limited": "true" if given.get("steps", True) else "false",
        }

    def tape(self, vmd: str = "cell") -> Tape:
        """The conversation; afterwards the robot tells the truth again."""
        tape = Tape(vmd)
        desk = Desk(tape, Controller(**(self.robot or {})))
        desk.open()
        if desk.robot.several:
            desk.look()
        self.run(desk)
        if not self.ends:
            desk.status()
            desk.look()
        assert len(tape.faults) == 1, self.name
        return tape


CATALOGUE: dict[str, Fault] = {}


def add(name: str, run: Run, *clauses: str, **more: Any) -> None:
    assert name not in CATALOGUE, name
    CATALOGUE[name] = Fault(name, run, clauses, **more)


def fault(*clauses: str, **more: Any) -> Callable[[Run], Run]:
    """The decorated conversation is a fault, called as the function."""

    def register(run: Run) -> Run:
        add(run.__name__, run, *clauses, **more)
        return run

    return register


# Changes of an answer.


def detailed(**fields: Any) -> Callable[[Pdu], Pdu]:
    """The robot's part says something else."""
    return lambda pdu: replace(pdu, detail={**pdu.detail, **fields})


def bodied(**fields: Any) -> Callable[[Pdu], Pdu]:
    """The body says something else."""
    return lambda pdu: replace(pdu, body={**pdu.body, **fields})


def both(*changes: Callable[[Pdu], Pdu]) -> Callable[[Pdu], Pdu]:
    def change(pdu: Pdu) -> Pdu:
        for one in changes:
            pdu = one(pdu)
        return pdu

    return change


def robot_state(name: str) -> Callable[[Pdu], Pdu]:
    return detailed(robotVMDState=number("RobotVMDState", name))


def chosen(name: str | None) -> Callable[[Pdu], Pdu]:
    return detailed(selectedProgramInvocation=("programInvocation", name) if name else ("noneSelected", None))


def flipped(bit: int) -> Callable[[Pdu], Pdu]:
    """One status bit is told the other way round."""

    def change(pdu: Pdu) -> Pdu:
        bits: str = pdu.detail["robotSpecificStatus"]
        other = bits[:bit] + "10"[int(bits[bit])] + bits[bit + 1 :]
        return replace(pdu, detail={**pdu.detail, "robotSpecificStatus": other})

    return change


def program_state(name: str) -> Callable[[Pdu], Pdu]:
    return bodied(state=number("ProgramInvocationState", name))


def value(kind: str, given: Any) -> Callable[[Pdu], Pdu]:
    """The first variable that was read has another value."""

    def change(pdu: Pdu) -> Pdu:
        rest = pdu.body["listOfAccessResult"][1:]
        return replace(pdu, body={"listOfAccessResult": [("success", (kind, given)), *rest]})

    return change
