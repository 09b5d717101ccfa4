"""Scopes: what they name, what is said of one that does not fit the model; rows that cannot be grounded."""

from __future__ import annotations

from typing import Any

import pytest
from small_models import Colour, Lamps

from mmsverify.concrete import Machine, Scope, generic_scope, scope_for
from mmsverify.errors import ModelError, UsageError
from mmsverify.model import (
    Each,
    Initially,
    Model,
    Relation,
    Transition,
    Variable,
    assemble,
    for_all,
    internal,
    optional,
)

LAMPS = assemble(Lamps)


def test_elements_are_named_after_their_sort() -> None:
    scope = generic_scope(LAMPS, {"L": 2})
    assert scope.elements == {"L": ("L1", "L2")}
    assert str(scope) == "L=2"


def test_the_scope_of_a_model_without_elements_is_one_machine() -> None:
    assert str(Scope({})) == "one machine"


def test_the_scenario_of_a_model_gives_names_and_facts() -> None:
    def scenario(sizes: Any, profile: Any) -> Any:
        return {"T": tuple(profile["names"][: sizes["T"]])}, {("known", ("x",)): True}

    class Named(Model, name="named", scenario=scenario):
        T = Each("Thing")
        known = Relation(T, rigid=True)

    scope = scope_for(assemble(Named), {"T": 2}, {"names": ["x", "y", "z"]})
    assert scope.elements == {"T": ("x", "y")}
    assert scope.facts == {("known", ("x",)): True}


def test_a_word_stands_for_the_member_that_prints_it() -> None:
    scope = Scope({"L": ("one",)}, {("colour", ("one",)): "GREEN"})
    machine = Machine(assemble(Unsettled), scope)
    assert [machine.layout.read(s)["colour", ("one",)] for s in machine.start.states] == [Colour.GREEN]


class Unsettled(Model, name="unsettled"):
    L = Each("Lamp")
    colour = Variable(Colour, L)


@pytest.mark.parametrize(
    ("facts", "cause"),
    [
        ({("glow", ("L1",)): True}, "no cell of lamps"),
        ({("lit", ("L9",)): True}, "a fact about lit[L9], which is no cell"),
        ({("lit", ("L1",)): 1}, "1 is not a value of lit[L1]"),
        ({("colour", ("L1",)): "BLUE"}, "BLUE is not a value of colour[L1]"),
    ],
)
def test_a_fact_that_does_not_fit_is_refused(facts: Any, cause: str) -> None:
    with pytest.raises(UsageError) as caught:
        Machine(LAMPS, Scope({"L": ("L1",)}, facts))
    assert cause in str(caught.value)


def test_a_scope_without_elements_is_refused() -> None:
    with pytest.raises(UsageError, match="the scope has no L"):
        Machine(LAMPS, Scope({}))


def test_an_unknown_sort_is_refused() -> None:
    with pytest.raises(UsageError, match="the model lamps has no sort M"):
        scope_for(LAMPS, {"M": 2})


def test_rigid_cells_that_are_settled_are_not_part_of_a_state() -> None:
    class Wired(Model, name="wired"):
        T = Each("Thing")
        a = T.element("a")
        on = Relation(T)
        wired = Relation(T, rigid=True)
        free = Relation(T, rigid=True)
        all_wired = Initially("W-1", for_all(a)(wired[a]))

    layout = Machine(assemble(Wired), Scope({"T": ("t", "u")}, {("free", ("t",)): True})).layout
    assert set(layout.fixed) == {("wired", ("t",)), ("wired", ("u",)), ("free", ("t",))}
    assert set(layout.keys) == {("on", ("t",)), ("on", ("u",)), ("free", ("u",))}


def test_contradicting_conditions_leave_no_initial_state() -> None:
    class Impossible(Model, name="impossible"):
        flag = Relation()
        on = Initially("I-1", flag())
        off = Initially("I-2", ~flag())

    assert Machine(assemble(Impossible), Scope({})).start.states == ()


def test_a_row_that_uses_an_unknown_name_is_refused() -> None:
    class Loose(Model, name="loose"):
        T = Each("Thing")
        a, b = T.elements("a b")
        on = Relation(T)
        go = Transition("L-1", on=internal("go", a), when=[on[b]])

    with pytest.raises(ModelError, match=r"guard (in|of) row go uses b") as caught:
        Machine(assemble(Loose), Scope({"T": ("t",)}))
    assert __file__ in caught.value.place


def test_an_update_to_an_absent_value_is_refused() -> None:
    class Careless(Model, name="careless"):
        T = Each("Thing")
        a = T.element("a")
        tint = optional("tint", Colour)
        colour = Variable(Colour, T)
        paint = Transition("C-1", on=internal("paint", a, tint), then=[colour[a].becomes(tint)])

    with pytest.raises(ModelError, match="an optional parameter that is absent") as caught:
        Machine(assemble(Careless), Scope({"T": ("t",)}))
    assert ".when(x.present)" in caught.value.cure
