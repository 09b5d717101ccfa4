"""Search: what it counts, what it finds, when it says that it has not seen everything."""

from __future__ import annotations

from dataclasses import replace

import pytest
from small_models import Counter, Lamps

from mmsverify.concrete import (
    Machine,
    NotAPathError,
    Scope,
    SearchResult,
    Taken,
    generic_scope,
    path_steps,
    replay,
    search,
)
from mmsverify.model import Claim, ModelData, assemble

LAMPS = assemble(Lamps)
COUNTER = assemble(Counter)
THREE = generic_scope(LAMPS, {"L": 3})
HOLDING = {"green_is_lit", "refusal_has_no_effect", "lit_stays_lit", "only_press_lights"}


def lamps(**options: object) -> SearchResult:
    return search(LAMPS, THREE, **options)  # type: ignore[arg-type]


def test_it_reaches_every_state_once() -> None:
    result = lamps(claims=())
    assert (result.states, result.depth, result.exhausted, result.reason) == (27, 6, True, "")


def test_like_elements_count_once_with_symmetry() -> None:
    # Three lamps, each dark, red or green: the multisets of size 3 over 3 kinds.
    assert lamps(claims=(), symmetry=True).states == 10


def test_a_fact_that_tells_elements_apart_is_respected_by_symmetry() -> None:
    told = Scope(THREE.elements, {("lit", ("L1",)): False})
    # Every lamp is dark at first, but only of L1 it is said: L2 and L3 remain alike.
    assert search(LAMPS, told, claims=(), symmetry=True).states == 18


@pytest.mark.parametrize("symmetry", [False, True])
def test_it_tells_what_is_violated_and_what_is_not(symmetry: bool) -> None:
    result = lamps(symmetry=symmetry)
    assert result.exhausted
    assert set(result.violations) == {"one_lit", "nothing_ripens"}
    assert set(result.witnesses) == {"all_green"}
    assert not HOLDING & set(result.violations)


@pytest.mark.parametrize("symmetry", [False, True])
@pytest.mark.parametrize(("claim", "steps"), [("one_lit", 2), ("nothing_ripens", 2), ("all_green", 6)])
def test_paths_are_shortest_and_replay(claim: str, steps: int, symmetry: bool) -> None:
    result = lamps(symmetry=symmetry)
    path = (result.violations | result.witnesses)[claim]
    assert len(path) - 1 == steps
    replay(LAMPS, THREE, path, named(LAMPS, claim))


def named(model: ModelData, claim: str) -> Claim:
    return next(c for c in model.claims if c.name == claim)


def test_it_ends_once_every_claim_is_settled() -> None:
    result = lamps(claims=[named(LAMPS, "one_lit")])
    assert not result.exhausted
    assert result.reason == "every claim is settled"
    assert result.states < 27


@pytest.mark.parametrize(
    ("limit", "reason"),
    [
        ({"max_depth": 2}, "the limit of 2 steps"),
        ({"max_states": 5}, "the limit of 5 states"),
        ({"max_seconds": 0.0}, "the limit of 0 s"),
    ],
)
def test_a_limit_that_is_reached_is_told(limit: dict[str, float], reason: str) -> None:
    result = lamps(claims=(), **limit)
    assert not result.exhausted
    assert result.reason == reason


def test_a_depth_that_is_not_reached_is_no_limit() -> None:
    assert lamps(claims=(), max_depth=7).exhausted


def test_an_integer_that_leaves_its_bounds_is_told() -> None:
    result = search(COUNTER, Scope({}, int_bounds=(0, 2)))
    assert (result.states, result.cut, result.exhausted) == (3, True, False)
    assert "small" not in result.violations
    assert result.reason == "an integer left its bounds"


def test_a_violation_inside_the_bounds_is_found() -> None:
    result = search(COUNTER, Scope({}, int_bounds=(0, 9)))
    assert [taken.state["n", ()] for taken in result.violations["small"]] == [0, 1, 2, 3]


def test_integers_beyond_an_octet_are_counted_right() -> None:
    machine = Machine(COUNTER, Scope({}, int_bounds=(0, 300)))
    assert not machine.layout.in_octets
    assert search(COUNTER, machine.scope, claims=(), machine=machine).states == 301


def test_open_cells_give_many_initial_states() -> None:
    unlit = replace(LAMPS, initial=())
    machine = Machine(unlit, THREE)
    assert len(machine.start.states) == 64
    assert machine.start.complete


def test_a_path_prints_rows_arguments_clauses_and_states() -> None:
    first, second = path_steps(LAMPS, THREE, lamps().violations["one_lit"])[:2]
    assert (first.action, first.clauses) == ("initially", ("L-0",))
    assert (second.action, second.arguments) == ("press result(+)", {"a": "L1"})
    assert second.clauses == ("L-1-a", "L-1-b", "L-1-m")
    assert second.state["lit[L1]"] is True
    assert second.state["colour[L2]"] == "RED"
    assert "lights" not in second.state  # it only repeats what the cells say


def test_a_false_initial_state_is_not_replayed() -> None:
    path = lamps().violations["one_lit"]
    lit = {**path[0].state, ("lit", ("L2",)): True}
    with pytest.raises(NotAPathError, match="no initial state"):
        replay(LAMPS, THREE, (Taken(None, {}, lit), *path[1:]))


def test_a_step_that_no_row_makes_is_not_replayed() -> None:
    path = lamps().violations["one_lit"]
    with pytest.raises(NotAPathError, match="leads to another state"):
        replay(LAMPS, THREE, (*path[:2], replace(path[2], state=path[0].state)))
    with pytest.raises(NotAPathError, match="the guard of press/m refuses"):
        replay(LAMPS, THREE, (*path[:2], path[1]))
    with pytest.raises(NotAPathError, match="cannot have these parameters"):
        replay(LAMPS, THREE, (path[0], replace(path[1], bindings={"a": "L9"})))


def test_a_path_that_shows_something_else_is_not_replayed() -> None:
    path = lamps().violations["one_lit"]
    with pytest.raises(NotAPathError, match="does not show what is claimed of one-lit"):
        replay(LAMPS, THREE, path[:2], named(LAMPS, "one_lit"))
