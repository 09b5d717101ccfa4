"""What a profile changes in the judgement of a recording."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.errors import ProfileError
from mmsverify.samples.cell import ARM, Cell
from mmsverify.samples.recording import Recording

IDLE, LOADED, READY = "robot-idle", "robot-loaded", "robot-ready"


def rules(folder: Path, cell: Cell, profile: str) -> list[str]:
    path = folder / "made.mcap"
    cell.recording.write(path, None)
    return [finding.rule for finding in audit_traces([path], profile=Path(profile), model=None).findings]


@pytest.fixture
def loading() -> Cell:
    """An idle robot gets a task program."""
    cell = Cell(Recording("cell"))
    cell.begin()
    cell.status(IDLE)
    cell.download("TASK", [b"code"])
    cell.create("TASK")
    return cell


def test_a_robot_with_one_task_program_is_ready_once_it_is_created(tmp_path: Path, loading: Cell) -> None:
    loading.status(READY, "TASK")
    loading.arm("idle", by="TASK")
    loading.start("TASK")
    assert rules(tmp_path, loading, "one-program") == []


def test_such_a_robot_is_not_loaded_only(tmp_path: Path, loading: Cell) -> None:
    loading.status(LOADED)
    assert rules(tmp_path, loading, "one-program") != []


def test_another_robot_is_loaded_and_not_ready(tmp_path: Path, loading: Cell) -> None:
    loading.status(LOADED)
    assert rules(tmp_path, loading, "single-arm") == []
    loading.status(READY, "TASK")
    assert rules(tmp_path, loading, "single-arm") != []


@pytest.mark.exercises("R-5.3.1.3.3.4-2")
def test_a_second_task_program_is_too_much_for_a_robot_that_holds_one(tmp_path: Path, loading: Cell) -> None:
    loading.download("OTHER", [b"code"])
    loading.create("OTHER")
    assert "create.second-task" in rules(tmp_path, loading, "one-program")
    assert rules(tmp_path, loading, "single-arm") == []


@pytest.mark.parametrize(
    ("profile", "expected"), [("no-step", ["start.steps-unsupported"]), ("single-arm", [])]
)
def test_steps_are_refused_by_a_robot_that_knows_none(
    tmp_path: Path, loading: Cell, profile: str, expected: list[str]
) -> None:
    loading.select("TASK", ARM)
    loading.start("TASK", steps=3)
    assert rules(tmp_path, loading, profile) == expected


def test_the_domain_of_each_arm_makes_a_program_move_it(tmp_path: Path) -> None:
    cell = Cell(Recording("cell"))
    cell.begin()
    cell.status(IDLE)
    cell.download("TASK", [b"code"])
    cell.create("TASK")
    cell.select("TASK", "R_ARM-2")
    cell.start("TASK")
    cell.status("robot-executing", "TASK")
    assert rules(tmp_path, cell, "two-arms") == []


def test_a_list_that_stands_for_ever_does_not_hinder_an_audit(tmp_path: Path, loading: Cell) -> None:
    path = tmp_path / "a.toml"
    path.write_text(
        '[mms-robot]\npredefined = [{name = "R_ARM"}, '
        '{name = "T", control = "CONTROLLING", controlled = ["R_ARM"]}]\n',
        encoding="utf-8",
    )
    assert rules(tmp_path, loading, str(path)) == []


@pytest.mark.exercises("R-8.3.1-2")
def test_a_profile_that_no_robot_can_have_is_refused(tmp_path: Path, loading: Cell) -> None:
    path = tmp_path / "a.toml"
    path.write_text(
        '[mms-robot]\npredefined = [{name = "R_ARM", domains = ["X"]}, {name = "T", domains = ["R_ARM"]}]\n',
        encoding="utf-8",
    )
    with pytest.raises(ProfileError, match="no robot can have"):
        rules(tmp_path, loading, str(path))
