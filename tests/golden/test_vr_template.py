"""The model of the VR template framework: its numbers, what is proved of it, what the text itself breaks."""

from __future__ import annotations

from functools import cache
from typing import Any

import pytest

from mmsverify.checking import check_models
from mmsverify.model import load
from mmsverify.model.rows import MINUS
from mmsverify.resources import models_dir
from mmsverify.results import Verdict

STATUSES = (
    "Idle", "DbgRdy", "Home", "HomeRdy", "Org", "OrgRdy", "RunAuto", "Stop", "ErrB_Pause", "ErrS_Pause",
    "RunPause", "Dbg_SubActions", "Home_SubActions", "Org_SubActions", "Run_SubActions",
)  # fmt: skip
COMMANDS = "home", "org", "run", "stop", "pause", "step", "resume", "onErrB", "onErrS", "resetErr"
BROKEN_AS_WRITTEN = {
    "new-home-after-serious-error": 2,
    "serious-error-waits": 2,
    "general-error-waits": 2,
    "serious-error-ends-in-debugging": 2,
    "general-error-like-stop": 2,
    "debug-action-returns": 3,
    "home-action-returns": 4,
    "origin-action-returns": 4,
    "waits-for-commands": 4,
    "shows-pause": None,
}
"""By property, the steps of the shortest run that breaks it; none where no run does what it asks."""


@cache
def verdicts(variant: str) -> dict[str, Verdict]:
    (check,) = check_models(["vr-template"], variant=variant)
    return {verdict.name: verdict for verdict in check.verdicts}


def numbers(table: str) -> Any:
    return load("vr-template", models_dir(), "repaired").options["numbers"][table]


def test_every_property_of_the_repaired_reading_is_proved() -> None:
    assert {v.result for v in verdicts("repaired").values()} == {"proved"}


def test_the_text_as_it_stands_breaks_exactly_these_properties() -> None:
    broken = {name: v.depth for name, v in verdicts("as-written").items() if v.result != "proved"}
    assert broken == BROKEN_AS_WRITTEN


@pytest.mark.parametrize(("number", "status"), list(enumerate(STATUSES)))
@pytest.mark.exercises("V-STA-[01]*")
def test_a_status_has_the_number_of_the_table_of_statuses(number: int, status: str) -> None:
    assert list(map(str, numbers("status")("11-14")[number])) == [status]


@pytest.mark.exercises("V-PRE-1*")
def test_set_pre_mode_gives_other_numbers_to_the_statuses_of_users_actions() -> None:
    as_set = numbers("status")("13-16")
    assert sorted(as_set) == [*range(11), *range(13, 17)]
    assert [str(as_set[n][0]) for n in range(13, 17)] == [
        str(numbers("status")("11-14")[n][0]) for n in range(11, 15)
    ]


def test_without_a_profile_either_table_of_statuses_may_be_right() -> None:
    meant = {n: list(map(str, words)) for n, words in numbers("status")("either").items() if n in (12, 13)}
    assert meant == {12: ["Home_SubActions"], 13: ["Org_SubActions", "Dbg_SubActions"]}


@pytest.mark.parametrize(("number", "command"), list(enumerate(COMMANDS, 1)))
@pytest.mark.exercises("V-CMD-0[1-9]", "V-CMD-10", "V-ACT-2")
def test_a_basic_command_has_a_number_up_to_ten(number: int, command: str) -> None:
    assert numbers("command")[number] == command


@pytest.mark.parametrize(
    ("first", "command"), [(101, "dbgSub"), (201, "homeSub"), (301, "orgSub"), (401, "runSub")]
)
@pytest.mark.exercises("V-CMD-[1-4]01")
def test_an_action_of_the_users_has_a_number_of_its_hundred(first: int, command: str) -> None:
    assert [n for n, word in numbers("command").items() if word == command] == list(range(first, first + 99))


@pytest.mark.parametrize("number", [0, 11, 100, 200, 300, 400, 500])
@pytest.mark.exercises("V-CMD-00", "V-CHK-T")
def test_any_other_number_is_no_command(number: int) -> None:
    assert number not in numbers("command")


@pytest.mark.parametrize(
    ("command", "reading"),
    [("step", "VR-05"), ("resume", "VR-05"), ("reset_error", "VR-06"), ("run_action", "VR-04")],
)
def test_what_only_a_reading_forbids_is_a_warning(command: str, reading: str) -> None:
    model = load("vr-template", models_dir(), "repaired")
    refusals = [row.guard[-1] for row in model.actions if row.name == command and row.answer == MINUS]
    assert [(r.level, r.clause.readings) for r in refusals] == [("warning", (reading,))]
