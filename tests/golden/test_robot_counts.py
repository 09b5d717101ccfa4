"""How many states the robot model has in small scopes: known numbers, found in two ways that share no code.

A search of compiled rows finds them, and Z3 enumerates them from the formulas that proofs use. Where a change
of the model rightly changes the numbers, ``python tests/golden/robot_counts.py`` writes them anew.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from robot_counts import COUNTED, VARIANTS, counted, part, table

from mmsverify.concrete import Machine, Scope, scope_for
from mmsverify.model import ModelData, load
from mmsverify.symbolic.states import ClosedWorld, Enumerator

BENCH = Path(__file__).parents[2] / "bench"
QUICK = [key for key in COUNTED if key[1] in ("token", "tokens", "panel")]
MANY = [key for key in COUNTED if key[1] == "arm"]
CORES = ("as-written", "repaired", "repaired-motion")


def searched(model: ModelData, scope: Scope) -> set[frozenset[Any]]:
    """Every state that compiled rows reach: the values of its cells."""
    machine = Machine(model, scope)
    found = set(machine.start.states)
    waiting = list(found)
    while waiting:
        for _, later in machine.successors(waiting.pop()):
            if later is not None and later not in found:
                found.add(later)
                waiting.append(later)
    return {frozenset(machine.layout.read(state).items()) for state in found}


def enumerator(model: ModelData, scope: Scope) -> Enumerator:
    return Enumerator(model, ClosedWorld(scope.elements, scope.facts, scope.int_bounds, scope.tried))


def enumerated(model: ModelData, scope: Scope) -> set[frozenset[Any]]:
    """Every state that Z3 reaches."""
    made = enumerator(model, scope)
    return {frozenset(zip(made.keys, state, strict=True)) for state in made.reachable()}


@pytest.mark.parametrize(("variant", "name"), COUNTED)
def test_the_number_of_states_is_known(variant: str, name: str) -> None:
    assert counted(variant, name) == table()[variant, name], "see the top of this file"


def test_the_table_has_no_other_numbers() -> None:
    assert table().keys() == set(COUNTED)


@pytest.mark.parametrize(("variant", "name"), QUICK)
def test_z3_reaches_the_same_states(variant: str, name: str) -> None:
    found = enumerated(*part(variant, name))
    assert found == searched(*part(variant, name))
    assert len(found) == table()[variant, name][0]


@pytest.mark.slow
@pytest.mark.parametrize(("variant", "name"), MANY)
def test_z3_reaches_the_same_states_where_there_are_many(variant: str, name: str) -> None:
    test_z3_reaches_the_same_states(variant, name)


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_z3_takes_the_same_steps_from_states_of_a_world_too_large_to_count(variant: str) -> None:
    model, scope = part(variant, "pair")
    machine, made = Machine(model, scope), enumerator(model, scope)
    states = [machine.layout.read(state) for state in some_states(machine, 4_000)[::200]]
    steps = made.successors(tuple(state[key] for key in made.keys) for state in states)
    for (_, found), state in zip(steps, states, strict=True):
        later = [after for _, after in machine.successors(machine.layout.write(state)) if after is not None]
        assert found == {tuple(machine.layout.read(after)[key] for key in made.keys) for after in later}


def some_states(machine: Machine, count: int) -> list[Any]:
    """The first states that a search meets."""
    found = dict.fromkeys(machine.start.states)
    for state in (waiting := list(found)):
        new = [a for _, a in machine.successors(state) if a is not None and a not in found]
        found |= dict.fromkeys(new)
        waiting += dict.fromkeys(new)
        if len(found) >= count:
            break
    return list(found)


@pytest.mark.parametrize("variant", CORES)
def test_z3_reaches_the_same_states_of_the_benchmark_core(variant: str) -> None:
    model = load(str(BENCH / "core_model.py"), BENCH, variant)
    scope = scope_for(model, {"PI": 2})
    assert enumerated(model, scope) == searched(model, scope)


def test_what_an_enumeration_finds_depends_on_the_facts() -> None:
    model, scope = part("repaired", "tokens")
    single = {**scope.facts, ("single_association", ()): True}
    assert enumerated(model, Scope(scope.elements, single, scope.int_bounds, scope.tried)) != searched(
        model, scope
    )
