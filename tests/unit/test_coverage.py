"""What counts as exercised by a recording: what must have been taken, what could have been broken."""

from __future__ import annotations

from mmsverify.concrete.belief import Belief
from mmsverify.model import (
    BOOL,
    MINUS,
    PLUS,
    Model,
    Observation,
    Procedure,
    Relation,
    accept,
    assemble,
    do,
    needs,
    parameter,
    refuse,
    response,
    shown,
)


class Door(Model, name="door"):
    """It opens unless it is locked or open; a look at it shows whether it is open, or nothing."""

    locked = Relation()
    open = Relation()
    seen, clear = parameter("seen", BOOL), parameter("clear", BOOL)

    push = Procedure("D-1", on=response("push"), steps=[
        refuse("a", when=locked()),
        refuse("b", when=open()),
        do("c", open().becomes(True)),
        accept("d"),
    ])  # fmt: skip
    look = Observation(
        "D-2", on=shown("look", clear, seen), shows=[needs("D-3", that=clear >> (open() == seen))]
    )


def belief() -> Belief:
    return Belief(assemble(Door))


def covered(belief: Belief) -> set[str]:
    return {name for clause in belief.coverage.clauses for name in clause.ids}


def push(belief: Belief, answer: str) -> None:
    belief.indicate("1", "push", {})
    belief.respond("1", "push", {}, answer)


def test_an_accepted_service_exercises_every_step_on_the_way() -> None:
    door = belief()
    push(door, PLUS)
    assert covered(door) == {"D-1-a", "D-1-b", "D-1-c", "D-1-d"}


def test_a_refusal_that_two_steps_explain_exercises_neither() -> None:
    door = belief()
    push(door, MINUS)
    assert covered(door) == set()


def test_a_refusal_that_one_step_explains_exercises_it() -> None:
    door = belief()
    push(door, PLUS)
    before = covered(door)
    push(door, MINUS)
    assert covered(door) - before == set()
    assert any(clause.ids == ("D-1-b",) for clause in door.coverage.clauses)


def test_an_observation_exercises_what_it_could_have_broken() -> None:
    door = belief()
    door.show("look", {"clear": False, "seen": True})
    assert covered(door) == {"D-2"}
    door.show("look", {"clear": True, "seen": True})
    assert covered(door) == {"D-2", "D-3"}


def test_what_is_contradicted_is_not_exercised_by_the_rows() -> None:
    door = belief()
    push(door, PLUS)
    door.show("look", {"clear": True, "seen": False})
    assert "D-3" not in covered(door)
