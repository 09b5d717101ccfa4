"""The benchmark core: how many states it has, which properties hold, how short counterexamples are."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest
from core_by_hand import reached

from mmsverify.concrete import SearchResult, replay, scope_for, search
from mmsverify.model import ModelData, load

BENCH = Path(__file__).parents[2] / "bench"

# variant, number of program invocations: states, steps that change the state, depth
COUNTS = {
    ("as-written", 2): (140, 693, 8),
    ("as-written", 3): (2795, 21624, 11),
    ("as-written", 4): (49990, 530549, 14),
    ("repaired", 2): (95, 468, 6),
    ("repaired", 3): (1805, 14094, 9),
    ("repaired", 4): (33655, 363014, 12),
    ("repaired-motion", 2): (76, 374, 6),
    ("repaired-motion", 3): (1444, 11264, 9),
    ("repaired-motion", 4): (26924, 290176, 12),
}
LIKE_COUNTS = {
    ("as-written", 3): 1425,
    ("as-written", 4): 9200,
    ("repaired", 3): 930,
    ("repaired", 4): 6230,
    ("repaired-motion", 3): 744,
    ("repaired-motion", 4): 4984,
}
HOLDING = ("p1", "p2", "p3", "p4", "p5", "one_selected", "creation_keeps_selection")


@cache
def core(variant: str) -> ModelData:
    return load(str(BENCH / "core_model.py"), BENCH, variant)


def found(variant: str, count: int, symmetry: bool = False) -> SearchResult:
    model = core(variant)
    return search(model, scope_for(model, {"PI": count}), symmetry=symmetry)


def actions(result: SearchResult, claim: str) -> list[str]:
    path = (result.violations | result.witnesses)[claim]
    return [taken.row.name for taken in path if taken.row is not None]


@pytest.mark.parametrize(("variant", "count"), COUNTS)
def test_the_number_of_states_is_known(variant: str, count: int) -> None:
    result = found(variant, count)
    assert (result.states, result.transitions, result.depth) == COUNTS[variant, count]
    assert result.exhausted


@pytest.mark.parametrize(("variant", "count"), LIKE_COUNTS)
def test_the_number_of_states_up_to_exchange_is_known(variant: str, count: int) -> None:
    result = found(variant, count, symmetry=True)
    assert result.states == LIKE_COUNTS[variant, count]
    assert result.exhausted


@pytest.mark.parametrize("count", [2, 3])
@pytest.mark.parametrize(
    ("variant", "repaired", "end_stops_motion"),
    [("as-written", False, False), ("repaired", True, False), ("repaired-motion", True, True)],
)
def test_a_program_written_by_hand_reaches_as_many_states(
    variant: str, repaired: bool, end_stops_motion: bool, count: int
) -> None:
    assert found(variant, count).states == len(reached(count, repaired, end_stops_motion))


@pytest.mark.parametrize("symmetry", [False, True])
def test_the_repaired_core_keeps_its_properties_with_four_program_invocations(symmetry: bool) -> None:
    result = found("repaired", 4, symmetry)
    assert result.exhausted
    assert not result.violations.keys() & set(HOLDING)


@pytest.mark.parametrize("symmetry", [False, True])
def test_the_core_as_written_selects_what_was_deleted_after_three_steps(symmetry: bool) -> None:
    assert actions(found("as-written", 3, symmetry), "p2") == ["create", "select", "delete"]


def test_the_core_as_written_breaks_nothing_else_of_the_five() -> None:
    assert found("as-written", 3).violations.keys() == {"p2", "p6"}


def test_motion_outlives_the_end_of_its_program_until_that_is_repaired() -> None:
    assert actions(found("repaired", 3), "p6") == ["start", "end"]
    assert found("repaired-motion", 3).violations == {}


@pytest.mark.parametrize("variant", ["as-written", "repaired", "repaired-motion"])
def test_every_path_that_a_search_reports_can_be_replayed(variant: str) -> None:
    model, result = core(variant), found(variant, 3, symmetry=True)
    claims = {claim.name: claim for claim in model.claims}
    for name, path in {**result.violations, **result.witnesses}.items():
        replay(model, scope_for(model, {"PI": 3}), path, claims[name])
    assert result.witnesses.keys() == {"controlled_runs", "something_moves"}
