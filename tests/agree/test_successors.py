"""Every reader of a model sees the same steps: the judge, the compiled code, the graph, the solver.

This property is what licenses all of them: each is written on its own, and they share nothing but the rows.
"""

from __future__ import annotations

from typing import Any

from closed_world import solver_steps
from hypothesis import HealthCheck, given, settings
from random_models import situations

from mmsverify.concrete import Machine, Scope
from mmsverify.concrete.evaluate import successors, within_bounds
from mmsverify.graph import explore
from mmsverify.model import ModelData

CALM = settings(deadline=None, max_examples=100, suppress_health_check=list(HealthCheck))

Step = tuple[str, str, frozenset[Any], frozenset[Any] | None]
"""Row, answer, parameters, state after; no state where an integer leaves its bounds."""


def step(row: Any, bindings: Any, state: Any) -> Step:
    return (
        row.id,
        row.answer,
        frozenset(bindings.items()),
        None if state is None else frozenset(state.items()),
    )


def judged(model: ModelData, scope: Scope, state: Any) -> set[Step]:
    return {
        step(row, bindings, after if within_bounds(model, scope, after) else None)
        for row, bindings, after in successors(model, scope, state)
    }


def compiled(machine: Machine) -> set[Step]:
    (start,) = machine.start.states
    found = set()
    for number, after in machine.successors(start):
        instance = machine.instances[number]
        bindings = machine.grounding.bindings(instance)
        found.add(step(instance.row, bindings, None if after is None else machine.layout.read(after)))
    return found


@CALM
@given(situations())
def test_compiled_code_takes_the_steps_that_the_judge_takes(situation: tuple[ModelData, Scope]) -> None:
    machine = Machine(*situation)
    (start,) = machine.start.states
    assert compiled(machine) == judged(*situation, machine.layout.read(start))


@CALM
@given(situations())
def test_the_graph_has_an_edge_for_each_step(situation: tuple[ModelData, Scope]) -> None:
    machine = Machine(*situation)
    (start,) = machine.start.states
    graph = explore(machine, max_states=1)
    found = {
        step(data["row"], machine.grounding.bindings(machine.instances[number]), machine.layout.read(after))
        for _, after, number, data in graph.out_edges(start, keys=True, data=True)
    }
    assert found == {taken for taken in compiled(machine) if taken[3] is not None}


@settings(CALM, max_examples=15)
@given(situations())
def test_the_solver_finds_the_steps_that_the_judge_takes(situation: tuple[ModelData, Scope]) -> None:
    model, scope = situation
    machine = Machine(model, scope)
    state = machine.layout.read(machine.start.states[0])
    found = {
        step(row, bindings, after if within_bounds(model, scope, after) else None)
        for row, bindings, after in solver_steps(model, scope, state)
    }
    assert found == judged(model, scope, state)
