"""A controller that keeps the rules is never blamed: random runs from the rows, and runs written by hand."""

from __future__ import annotations

from pathlib import Path

import pytest
from vr_by_hand import UNASKED, lawful
from vr_random import Run, framework
from vr_runs import KINDS, Sampling, blamed, recording
from vr_story import findings, marked

LONG = 2000
FEW, MANY = 4, 20


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(FEW))
def test_a_right_controller_is_not_blamed(seed: int, kind: Sampling, tmp_path: Path) -> None:
    recording(seed, LONG, kind, path := tmp_path / "made.mcap")
    assert blamed(path) == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", range(1000, 1000 + MANY))
def test_many_right_controllers_are_not_blamed(seed: int, kind: Sampling, tmp_path: Path) -> None:
    recording(seed, LONG, kind, path := tmp_path / "made.mcap")
    assert blamed(path) == []


def test_the_runs_take_every_row() -> None:
    """What is never taken proves nothing by not being blamed."""
    taken: set[str] = set()
    for seed in range(FEW):
        run = Run(seed)
        assert sum(1 for _ in run.samples(LONG)) == LONG
        taken |= run.taken
    assert {row.id for row in framework().actions if row.answer != "result(-)"} - taken == set()


def test_a_run_lags_leaves_cells_out_and_holds_floats(tmp_path: Path) -> None:
    told = recording(1, LONG, "scan", tmp_path / "made.mcap")
    assert any("C_RunMD" not in cells for cells in told)
    assert any(isinstance(cells.get("C_RunMD"), float) for cells in told)
    polled = recording(1, LONG, "polled", tmp_path / "made.mcap")
    assert len(polled) < len(told)


# Runs written by hand.


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("story", lawful())
def test_a_right_run_written_by_hand_is_not_blamed(story: str, kind: Sampling) -> None:
    assert findings(story, kind) == []


@pytest.mark.parametrize("story", UNASKED.strip().splitlines())
def test_an_unasked_way_to_the_origin_is_blamed(story: str) -> None:
    assert [found.index for found in findings(story, "scan")] == marked(story)
