"""What recordings show of physical resources, error codes and program locations, and what contradicts it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding
from mmsverify.samples import pdus
from mmsverify.samples.cell import ARM, CALIBRATION, Cell
from mmsverify.samples.pdus import controlling, of_domain
from mmsverify.samples.recording import Recording

IDLE, LOADED, READY = "robot-idle", "robot-loaded", "robot-ready"
POWER, ALL = "anyPhysicalResourcePowerOn", "allPhysicalResourcesCalibrated"
CALIBRATED, NOT_CALIBRATED, CALIBRATING = (("integer", number) for number in (0, 1, 2))
Listen = Callable[[], Sequence[Finding]]


@pytest.fixture
def cell() -> Cell:
    """A robot that is seen at rest, not in local control."""
    made = Cell(Recording("cell"))
    made.begin()
    made.status(IDLE, flags=[POWER])
    return made


@pytest.fixture
def listen(cell: Cell, tmp_path: Path) -> Listen:
    def audited() -> Sequence[Finding]:
        path = tmp_path / "made.mcap"
        cell.recording.write(path)
        return audit_traces([path], profile=None, model=None).findings

    return audited


def dcal(value: tuple[str, Any]) -> tuple[Any, tuple[str, Any]]:
    return of_domain(ARM, "R_DCAL"), value


def calibrating(cell: Cell) -> None:
    """R_CAL is started, and seen RUNNING."""
    cell.start(CALIBRATION)
    cell.calibration("running")


@pytest.mark.exercises("R-6.3.6-3", "R-6.3.6-4", "R-6.3.6-5", "R-8.5.4.2-1")
def test_a_calibration_from_start_to_end_is_no_fault(cell: Cell, listen: Listen) -> None:
    cell.read(dcal(NOT_CALIBRATED), ("R_VCAL", ("boolean", False)))
    calibrating(cell)
    cell.read(dcal(CALIBRATING), ("R_VCAL", ("boolean", False)))
    cell.calibration("idle")
    cell.read(dcal(CALIBRATED), ("R_VCAL", ("boolean", True)))
    cell.status(IDLE)
    assert not listen()


@pytest.mark.exercises("R-6.3.6-3", "R-8.5.4.2-1")
@pytest.mark.parametrize("value", [CALIBRATED, NOT_CALIBRATED])
def test_an_arm_that_is_not_calibrating_while_r_cal_runs_is_a_fault(
    cell: Cell, listen: Listen, value: tuple[str, int]
) -> None:
    calibrating(cell)
    cell.read(dcal(value))
    cell.calibration("running")
    (found,) = listen()
    assert "R-6.3.6-3" in found.clauses or "R-6.3.6-4" in found.clauses


@pytest.mark.exercises("R-6.3.6-5", "R-6.3.6-4")
def test_an_arm_that_is_calibrating_when_r_cal_is_idle_is_a_fault(cell: Cell, listen: Listen) -> None:
    cell.calibration("idle")
    cell.read(dcal(CALIBRATING))
    (found,) = listen()
    assert (found.rule, found.severity) == ("variable.device-calibration", "error")
    assert "R-6.3.6-5" in found.clauses


@pytest.mark.exercises("R-6.1.3.2.4-1", "R-6.3.6-6", "R-8.5.3.2-1", "R-6.1.3.1-4")
def test_not_all_are_calibrated_while_r_cal_runs(cell: Cell, listen: Listen) -> None:
    calibrating(cell)
    cell.read(("R_VCAL", ("boolean", True)))
    cell.calibration("running")
    (found,) = listen()
    assert found.severity == "error"


@pytest.mark.exercises("R-7.3.2.1.1.2-1", "R-6.1.3.1-4")
def test_the_status_tells_of_calibration_too(cell: Cell, listen: Listen) -> None:
    calibrating(cell)
    cell.status(IDLE, flags=[POWER, ALL])
    cell.calibration("running")
    assert len(listen()) == 1


@pytest.mark.exercises("R-7.3.2.1.1.3-1")
def test_a_bit_that_the_mask_hides_tells_nothing(cell: Cell, listen: Listen) -> None:
    calibrating(cell)
    hidden = {
        **pdus.robot_status(IDLE, [POWER, ALL], ("noneSelected", None)),
        "robotSpecificStatusMask": "1101",
    }
    cell.call("status", False, gives=pdus.status(0, 0), extra=hidden)
    cell.calibration("running")
    assert not listen()


@pytest.mark.exercises("R-6.3.6-5")
def test_a_calibration_that_is_stopped_has_not_completed(cell: Cell, listen: Listen) -> None:
    calibrating(cell)
    cell.run("stop", CALIBRATION)
    cell.read(dcal(NOT_CALIBRATED))
    cell.calibration("stopped")
    assert not listen()


@pytest.mark.exercises("R-6.3.6-5")
def test_a_calibration_that_was_stopped_calibrates_nothing(cell: Cell, listen: Listen) -> None:
    calibrating(cell)
    cell.run("stop", CALIBRATION)
    cell.read(dcal(CALIBRATED))
    cell.calibration("stopped")
    assert len(listen()) == 1


@pytest.mark.exercises(
    "R-6.1.3.2.1-1", "R-6.1.3.2.3-1", "R-8.5.3.1-1", "R-8.5.3.4-1", "R-8.5.4.1-1", "R-6.2.3.3-1"
)
def test_power_and_interlocks_come_and_go_by_themselves(cell: Cell, listen: Listen) -> None:
    for flags, on in (([POWER, ALL], True), (["safetyInterlocksViolated", ALL], False), ([POWER, ALL], True)):
        cell.status(IDLE, flags=flags)
        cell.read(("R_VPWR", ("boolean", on)), (of_domain("R_SAFE", "R_DPWR"), ("boolean", on)))
        cell.read(("R_VSAFEV", ("boolean", not on)))
    assert not listen()


@pytest.mark.exercises("R-6.1.3.2.3-1", "R-6.1.3.2.4-1", "R-6.1.3.2.5-1", "R-8.5.4.1-1", "R-8.5.4.3-1")
@pytest.mark.parametrize(
    ("rule", "vmd", "device"),
    [
        ("read.power", ("R_VPWR", ("boolean", False)), ("R_DPWR", ("boolean", True))),
        ("read.calibrated", ("R_VCAL", ("boolean", True)), ("R_DCAL", NOT_CALIBRATED)),
        ("read.local-control", ("R_VLOCAL", ("boolean", False)), ("R_DLOCAL", ("boolean", True))),
    ],
)
def test_one_read_that_says_two_things_is_a_warning(
    cell: Cell, listen: Listen, rule: str, vmd: tuple[Any, Any], device: tuple[str, tuple[str, Any]]
) -> None:
    cell.read(vmd, (of_domain(ARM, device[0]), device[1]))
    (found,) = listen()
    assert (found.rule, found.severity, "RP-22" in found.readings) == (rule, "warning", True)


@pytest.mark.exercises("R-6.2.2.2-1", "R-8.5.4.3-1", "R-6.1.3.2.5-1")
def test_an_arm_in_local_control_explains_what_changes_at_the_panel(cell: Cell, listen: Listen) -> None:
    cell.create("TASK")
    cell.attributes("TASK", "idle", controlling([]))
    cell.read((of_domain(ARM, "R_DLOCAL"), ("boolean", True)))
    cell.attributes("TASK", "unrunnable", controlling([]))
    assert not listen()


@pytest.mark.exercises("R-7.3.3.9.2.1-1", "R-6.3.2.1-1", "R-7.3.3.2.3-0")
def test_what_was_created_and_never_started_has_no_error(cell: Cell, listen: Listen) -> None:
    cell.create("TASK")
    cell.attributes("TASK", "idle", {**controlling([]), "errorCode": 7})
    (found,) = listen()
    assert (found.rule, found.severity) == ("attributes.error-code", "error")
    assert "R-7.3.3.2.3-0" in found.clauses


@pytest.mark.exercises("R-6.3.2.1-1")
def test_what_was_started_may_have_any_error(cell: Cell, listen: Listen) -> None:
    cell.create("TASK")
    cell.select("TASK", ARM)
    cell.start("TASK", cycles=1)
    for code in (7, 0, -3):
        cell.attributes("TASK", "running", {**controlling([ARM], ("cycleLimited", 1)), "errorCode": code})
    assert not listen()


def located(where: str) -> dict[str, Any]:
    found = controlling([])
    return {**found, "control": ("controlling", {**found["control"][1], "programLocation": where})}


@pytest.mark.exercises("R-7.3.3.2.3-a", "R-7.3.3.9.2.5-1")
@pytest.mark.parametrize(("where", "count"), [("", 0), ("line 12", 1)])
def test_what_was_created_and_never_started_has_no_program_location(
    cell: Cell, listen: Listen, where: str, count: int
) -> None:
    cell.create("TASK")
    cell.attributes("TASK", "idle", located(where))
    assert [found.rule for found in listen()] == ["attributes.location"] * count
