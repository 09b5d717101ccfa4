"""A machine with commands of its own: proved where its table fits the framework, else refuted by name."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import pytest

from mmsverify.checking import check_models
from mmsverify.results import Verdict

FAULTY = {
    "an origin action in DbgRdy": (
        'number = 301, name = "load job", sub_mode = 3, allowed = ["DbgRdy", "OrgRdy"]',
        {"homed-before-moving": 2, "new-home-after-serious-error": 3, "origin-action-from-origin": 2},
        "load_job_301",
    ),
    "a home action in DbgRdy": (
        'number = 201, name = "teach", sub_mode = 1, allowed = ["DbgRdy"]',
        {"homed-before-moving": 2, "new-home-after-serious-error": 3, "home-action-from-homed": 2},
        "teach_201",
    ),
    "a debug action in Run": (
        'number = 101, name = "servo on", sub_mode = 1, allowed = ["Run"]',
        {"debug-action-from-waiting": 7, "only-the-flow-is-held": 8},
        "servo_on_101",
    ),
    "a run action in OrgRdy": (
        'number = 499, name = "eject", sub_mode = 1, allowed = ["Run", "OrgRdy"]',
        {"run-action-from-run": 6},
        "eject_499",
    ),
    "a home action that loses homing": (
        'number = 202, name = "free axes", sub_mode = 1, homing = "loses"',
        {"homed-before-moving": 5},
        "free_axes_202",
    ),
    "an origin action that loses homing": (
        'number = 303, name = "伺服断电", sub_mode = 1, homing = "loses"',
        {"homed-before-moving": 7},
        "伺服断电_303",
    ),
}
"""By what is wrong: an entry; the properties that fall, with the steps of the shortest run; who is blamed."""


def verdicts(profile: Path, variant: str = "repaired") -> dict[str, Verdict]:
    (check,) = check_models(["vr-template"], variant=variant, profile=profile)
    return {verdict.name: verdict for verdict in check.verdicts}


def written(folder: Path, *entries: str) -> Path:
    path = folder / "machine.toml"
    listed = ", ".join(f"{{{entry}}}" for entry in entries)
    path.write_text(f"[vr-template]\ncommands = [{listed}]\n", encoding="utf-8")
    return path


def broken(found: Mapping[str, Verdict]) -> dict[str, Any]:
    return {name: verdict.depth for name, verdict in found.items() if verdict.result != "proved"}


@pytest.mark.exercises("V-SUBD-[123]", "V-SUBH-[123]", "V-SUBO-[123]", "V-DO-[1234]01")
def test_every_property_is_proved_of_the_shipped_press_and_each_of_its_commands_can_be_given() -> None:
    found = verdicts(Path("press"))
    assert broken(found) == {}
    possible = [name for name, verdict in found.items() if name.endswith("-is-possible")]
    assert len(possible) == 6
    assert all(found[name].witness for name in possible)


@pytest.mark.parametrize("fault", FAULTY)
def test_a_table_that_goes_beyond_the_framework_is_refuted_by_its_command(fault: str, tmp_path: Path) -> None:
    entry, falls, command = FAULTY[fault]
    found = verdicts(written(tmp_path, entry))
    assert broken(found) == falls
    for name in falls:
        run = found[name].counterexample
        assert run is not None
        assert command in run[-1].action


@pytest.mark.exercises("V-SUBD-1", "V-SUBD-3", "V-FUN-2")
def test_an_action_of_debugging_may_lose_the_homing_for_it_ends_where_none_is_needed(tmp_path: Path) -> None:
    found = verdicts(written(tmp_path, 'number = 101, name = "free", sub_mode = 1, homing = "loses"'))
    assert broken(found) == {}


def test_an_action_that_homes_the_machine_ends_a_serious_error_like_a_home(tmp_path: Path) -> None:
    entry = 'number = 101, name = "home by hand", sub_mode = 1, homing = "homes"'
    assert broken(verdicts(written(tmp_path, entry))) == {}


def test_as_written_the_same_machine_breaks_what_the_text_breaks_of_any_machine() -> None:
    plain, press = verdicts(Path("single-arm"), "as-written"), verdicts(Path("press"), "as-written")
    assert set(broken(press)) == set(broken(plain))
