"""A controller that keeps the rules is never blamed: random runs from the rows, scan by scan and polled."""

from __future__ import annotations

from pathlib import Path

import pytest
from vr_random import Run, framework
from vr_runs import KINDS, Sampling, blamed, recording

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
