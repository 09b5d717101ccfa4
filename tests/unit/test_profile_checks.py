"""A profile is judged itself: each check finds its breach, cites its statements, and lets what is right alone."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mmsverify import cli
from mmsverify.errors import ProfileError
from mmsverify.profiles import CHECKS, ROBOT_TABLE, complete, judge, load_profile, shipped, stated, words
from mmsverify.resources import asn1_dir

ARM = {"name": "R_ARM"}
CAL = {"name": "R_CAL"}
TASK = {"name": "TASK", "control": "CONTROLLING"}
OTHER = {"name": "OTHER", "control": "CONTROLLING"}
SAFE = {"name": "stop", "kind": "safety", "domain": "R_SAFE"}
ONE = {"name": "arm", "kind": "arm", "domain": "R_ARM", "program": "R_ARM"}
LEFT = {"name": "R_ARM-1", "control": "CONTROLLED", "domains": ["R_ARM-1"]}
RIGHT = {"name": "R_ARM-2", "control": "CONTROLLED", "domains": ["R_ARM-2"]}
ARMS = [{"name": n, "kind": "arm", "domain": n, "program": n} for n in ("R_ARM-1", "R_ARM-2")]
BASE = ["conclude", "identify", "cancel", "status", "unsolicitedStatus", "getDomainAttributes", "deleteDomain",
        "createProgramInvocation", "deleteProgramInvocation", "start", "stop", "resume", "reset",
        "getProgramInvocationAttributes", "read", "write", "informationReport"]  # fmt: skip
LOADING = ["initiateDownloadSequence", "downloadSegment", "terminateDownloadSequence", "initiateUploadSequence",
           "uploadSegment", "terminateUploadSequence", "requestDomainDownload", "requestDomainUpload"]  # fmt: skip


def robot(**table: Any) -> dict[str, Any]:
    return complete({ROBOT_TABLE: table}, "a.toml")[ROBOT_TABLE]


def without(*services: str) -> dict[str, Any]:
    return {"services": [s for s in (*BASE, *LOADING) if s not in services]}


REFUSED = [
    ("R-8.3.1-6", {"predefined": [{**ARM, "control": "NORMAL"}]}, 'R_ARM must have control = "CONTROLLED"'),
    ("R-8.3.1-3", {"predefined": [{**ARM, "deletable": True}]}, "R_ARM must have deletable = false"),
    ("R-8.3.1-4", {"predefined": [{**ARM, "reusable": False}]}, "R_ARM must have reusable = true"),
    ("R-8.3.2-3", {"predefined": [{**CAL, "control": "CONTROLLING"}]}, 'R_CAL must have control = "NORMAL"'),
    ("R-6.3.6-7", {"predefined": [{**CAL, "control": "CONTROLLED"}]}, 'R_CAL must have control = "NORMAL"'),
    ("R-8.3.2-2", {"predefined": [{**CAL, "deletable": True}]}, "R_CAL must have deletable = false"),
    ("R-8.3.2-2", {"predefined": [{**CAL, "reusable": False}]}, "R_CAL must have reusable = true"),
    ("R-6.3.5.4-2", {"predefined": [ARM], "selected_at_power_on": "R_ARM"}, "not a predefined CONTROLLING"),
    ("R-6.3.2.3-1", {"predefined": [ARM, {**CAL, "controlled": ["R_ARM"]}]}, "R_CAL is NORMAL and has no list"),
    ("R-6.3.2.3-2", {"predefined": [{**TASK, "controlled": ["R_CAL"]}, CAL]}, "TASK controls R_CAL"),
    ("R-6.3.2.3-2", {"predefined": [{**TASK, "controlled": ["GONE"]}]}, "TASK controls GONE"),
    ("R-6.3.1-3", {"predefined": [ARM, {**TASK, "controlled": ["R_ARM", "R_ARM"]}]}, "R_ARM is controlled twice"),
    ("R-6.3.1-3", {"predefined": [ARM, {**TASK, "controlled": ["R_ARM"]}, {**OTHER, "controlled": ["R_ARM"]}]},
     "R_ARM is controlled twice"),
    ("R-5.3.1.3.3.4-2", {"predefined": [TASK, OTHER], "single_task": True}, "TASK and OTHER are predefined"),
]  # fmt: skip

BREACHES: list[tuple[str, str, dict[str, Any]]] = [
    ("profile.bound", "R-8.3.1-2", {"predefined": [{**ARM, "domains": ["X"]}]}),
    ("profile.bound", "R-8.3.1-1", {"predefined": [{**ARM, "domains": ["R_ARM", "X"]}]}),
    ("profile.bound", "R-8.3.2-1", {"predefined": [{**CAL, "domains": []}]}),
    ("profile.device-domain", "R-6.1.1-3", {"devices": [SAFE, {"name": "gripper"}]}),
    ("profile.device-domain", "R-6.2.1-1", {"devices": [SAFE, {"name": "arm", "kind": "arm"}]}),
    ("profile.own-domain", "R-6.2.1-4", {"devices": [ONE, {**SAFE, "domain": "R_ARM"}]}),
    ("profile.own-domain", "R-6.2.1-3", {"devices": [ONE, {**ONE, "name": "second"}, SAFE]}),
    ("profile.interlocks", "R-6.3.4.1-1", {"devices": [ONE]}),
    ("profile.interlocks", "R-T15-2", {"devices": [ONE, {"name": "belt", "domain": "BELT"}]}),
    ("profile.interlock-name", "R-8.2.3-1", {"devices": [ONE, {**SAFE, "domain": "FENCE"}]}),
    ("profile.arm-name", "R-8.2.1-1", {"devices": [{**ONE, "domain": "ARM"}, SAFE]}),
    ("profile.arm-name", "R-8.2.1-2", {"devices": [ARMS[0], {**ARMS[1], "domain": "RIGHT"}, SAFE]}),
    ("profile.arm-program", "R-6.1.2.1-1", {"predefined": [{**LEFT, "domains": ["X"]}], "arms": ["R_ARM-1"],
                                            "devices": [ONE, SAFE]}),
    ("profile.arm-program", "R-6.3.2.2-N", {"predefined": [{**TASK, "domains": ["R_ARM"]}], "arms": ["TASK"]}),
    ("profile.arm-programs-named", "R-6.1.2.1-1", {"arms": [], "devices": [ONE, SAFE]}),
    ("profile.without-arm-program", "R-6.3.2.2-N", {"predefined": [CAL], "devices": [ONE, SAFE]}),
    ("profile.one-intelligence", "R-6.1.2.2-1", {"predefined": [LEFT, RIGHT, {**TASK, "controlled": ["R_ARM-1"]}],
                                                 "arms": ["R_ARM-1", "R_ARM-2"], "devices": [*ARMS, SAFE]}),
    ("profile.one-intelligence", "R-6.1.2.3-1", {"predefined": [LEFT, RIGHT, {**TASK, "controlled": ["R_ARM-2"]}],
                                                 "arms": ["R_ARM-1", "R_ARM-2"], "selected_at_power_on": "TASK"}),
    ("profile.device-program", "R-6.1.2.4-1", {"devices": [ONE, SAFE, {"name": "belt", "domain": "B", "program": "R_CAL"}]}),
    ("profile.device-program", "R-6.3.7-1", {"devices": [ONE, SAFE, {"name": "belt", "domain": "B", "program": "R_ARM"}]}),
    ("profile.device-attributes", "R-6.2.1-2", {"devices": [{**ONE, "power": False}, SAFE]}),
    ("profile.device-attributes", "R-6.3.7-2", {"devices": [{**ONE, "local_control": False}, SAFE]}),
    ("profile.calibration-program", "R-6.3.6-2", {"predefined": [ARM]}),
    ("profile.standard-name", "R-8.1-3", {"predefined": [ARM, CAL, {"name": "R_WELD"}]}),
    ("profile.standard-name", "R-8.1-2", {"devices": [ONE, SAFE, {"name": "belt", "domain": "R_BELT"}]}),
    ("profile.list-unselected", "R-7.4.4.2-i", {"predefined": [ARM, CAL, {**TASK, "controlled": ["R_ARM"]}]}),
    ("profile.ready-without-arm", "R-6.3.4.4-1", {"predefined": [ARM, CAL, TASK], "selected_at_power_on": "TASK"}),
    ("profile.base-class", "R-9.2.2.1-1", {"classes": ["upload-download"]}),
    ("profile.base-class", "R-9.2.3.1-1", {"classes": []}),
    ("profile.loading-class", "R-9.2.2.2.1-9", {"classes": ["base"]}),
    ("profile.services", "R-9.2.1-1", without("identify")),
    ("profile.services", "R-9.2.2.2.1-1", without("cancel")),
    ("profile.services", "R-9.2.2.2.1-2", without("unsolicitedStatus")),
    ("profile.services", "R-9.2.2.2.1-3", without("deleteDomain")),
    ("profile.services", "R-9.2.2.2.1-4", without("deleteProgramInvocation")),
    ("profile.services", "R-9.2.2.2.1-5", without("resume")),
    ("profile.services", "R-9.2.2.2.1-6", without("getProgramInvocationAttributes")),
    ("profile.services", "R-9.2.2.2.1-7", without("informationReport")),
    ("profile.services", "R-9.2.2.2.2.1-1", without("downloadSegment")),
    ("profile.services", "R-9.2.2.2.2.1-2", without("uploadSegment")),
    ("profile.services", "R-9.2.2.2.2.1-3", without("requestDomainUpload")),
    ("profile.services", "R-9.2.2.2.2.2-1", {**without(), "classes": ["base", "secondary-storage"]}),
    ("profile.select", "R-9.2.2.2.1-8", {"additional_services": {"select": "client"}}),
    ("profile.semaphore-services", "R-5.1.3-2", {**without(), "associations": "multiple"}),
    ("profile.parameters", "R-9.2.2.3-1", {"parameters": ["STR1", "VNAM"]}),
    ("profile.parameters", "R-9.2.2.3-1", {"nest": 1}),
    ("profile.third-party", "R-9.2.2.2.2.2-2", {"classes": ["base", "secondary-storage"]}),
    ("profile.not-told", "R-T15-3", {}),
    ("profile.not-told", "R-T15-4", {}),
    ("profile.not-told", "R-T15-5", {}),
]  # fmt: skip

FITTING = [
    ("profile.interlocks", {"devices": [ONE, SAFE]}),
    ("profile.own-domain", {"devices": [ONE, SAFE, {**SAFE, "name": "light curtain"}]}),
    ("profile.arm-program", {"predefined": [{"name": "P", "domains": ["R_ARM"]}], "arms": ["P"]}),
    ("profile.services", {}),
    ("profile.services", without()),
    ("profile.semaphore-services", without()),
    ("profile.semaphore-services", {"services": [*BASE, *words.SEMAPHORE_SERVICES], "associations": "multiple"}),
    ("profile.third-party", {"classes": ["base", "secondary-storage"], "parameters": ["STR1", "STR2", "VNAM", "TPY"]}),
    ("profile.select", {"additional_services": {"select": "both"}}),
    ("profile.calibration-program", {"predefined": [ARM], "devices": [{**ONE, "calibration": False}, {**SAFE, "calibration": False}]}),
    ("profile.ready-without-arm", {"predefined": [ARM, {**TASK, "controlled": ["R_ARM"]}], "selected_at_power_on": "TASK"}),
    ("profile.list-unselected", {"predefined": [ARM, {**TASK, "controlled": ["R_ARM"]}], "selected_at_power_on": "TASK"}),
]  # fmt: skip


@pytest.mark.parametrize(("clause", "table", "told"), REFUSED)
def test_what_no_robot_can_be_is_refused_with_the_clause(
    clause: str, table: dict[str, Any], told: str
) -> None:
    with pytest.raises(ProfileError) as caught:
        robot(**table)
    assert all(part in str(caught.value) for part in (told, clause, "a.toml [mms-robot]"))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(("rule", "clause", "table"), BREACHES)
def test_a_breach_is_found_by_its_check_with_its_clause(
    rule: str, clause: str, table: dict[str, Any]
) -> None:
    found = [finding for finding in judge(robot(**table)) if finding.rule == rule]
    assert any(clause in finding.clauses for finding in found)


@pytest.mark.parametrize(("rule", "table"), FITTING)
def test_what_is_right_is_let_alone(rule: str, table: dict[str, Any]) -> None:
    assert [finding for finding in judge(robot(**table)) if finding.rule == rule] == []


def test_every_check_has_a_breach_that_it_finds() -> None:
    tables = [table for _, _, table in BREACHES]
    left = [
        (each.rule, each.clauses)
        for each in CHECKS
        if each.level != "refused" and not any(list(each.find(robot(**table))) for table in tables)
    ]
    assert left == []


@pytest.mark.exercises("R-9.4.1-1", "R-T15-1", "R-T14-1", "R-6.3.2.5-5")
def test_the_keys_of_the_pics_that_are_not_stated_are_told() -> None:
    told = [
        finding for finding in judge(robot(), frozenset({"devices"})) if finding.rule == "profile.not-stated"
    ]
    assert [finding.message.split()[0] for finding in told] == [
        "step_limited", "first_step", "orientation", "program_location", "additional_services",
    ]  # fmt: skip
    assert "R-6.3.2.5-5" in told[0].clauses
    assert all(finding.severity == "note" for finding in told)


@pytest.mark.parametrize("name", shipped(ROBOT_TABLE))
def test_a_shipped_profile_has_no_error_and_leaves_nothing_of_the_pics_out(name: str) -> None:
    found = judge(load_profile(name)[ROBOT_TABLE], stated(name, ROBOT_TABLE))
    wanted = ["profile.without-arm-program"] if name == "no-controlled" else []
    assert [finding.rule for finding in found] == wanted


def test_the_services_of_the_keys_are_those_of_the_syntax() -> None:
    text = (asn1_dir() / "mms-association.asn").read_text(encoding="utf-8")
    assert [service for service in words.SERVICES if f"{service}(" not in text] == []


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ('arms = "seven"', "give a list of names"),
        ('services = ["reed"]', "did you mean read?"),
        ('classes = ["basic"]', "did you mean base?"),
        ('parameters = ["STR3"]', "did you mean STR"),
        ('additional_services = {select = "clients"}', "did you mean client?"),
        ("additional_services = {selekt = 1}", "did you mean select?"),
        ("additional_services = 1", "give a table"),
        ('devices = [{name = "a", kind = "arms"}]', "did you mean arm?"),
        ('devices = [{name = "a", power = 1}]', "give true or false"),
        ('devices = [{kind = "arm"}]', "an entry of devices is not a table with a name"),
        ('devices = [{name = ""}]', "give a name"),
        ('single_task = "no"', "give true or false"),
        ("nest = -1", "give an integer from 0"),
        ("first_step = 1", "give a string"),
    ],
)
def test_a_value_that_is_not_allowed_is_one_line_and_exit_status_2(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], text: str, told: str
) -> None:
    path = tmp_path / "a.toml"
    path.write_text(f"[mms-robot]\n{text}\n", encoding="utf-8")
    assert cli.main(["check", "mms-robot", "--profile", str(path)]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert told in error
    assert str(path) in error


def test_a_name_that_is_not_shipped_is_told_with_the_one_that_was_meant(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert cli.main(["check", "mms-robot", "--profile", "one-programm"]) == 2
    assert "did you mean one-program?" in capsys.readouterr().err


def test_a_profile_that_contradicts_the_repaired_text_proves_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a.toml"
    path.write_text(
        '[mms-robot]\npredefined = [{name = "R_ARM"}, '
        '{name = "T", control = "CONTROLLING", controlled = ["R_ARM"]}]\n',
        encoding="utf-8",
    )
    asked = ["check", "mms-robot", "--profile", str(path), "--property", "one-selected", "-q"]
    assert cli.main(asked) == 2
    assert "R-7.4.4.2-i" in capsys.readouterr().err


@pytest.mark.slow
def test_a_check_tells_what_the_profile_breaks_and_ends_with_1(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "a.toml"
    path.write_text('[mms-robot]\nclasses = ["base"]\n', encoding="utf-8")
    asked = ["check", "mms-robot", "--profile", str(path), "--property", "one-selected", "-q"]
    assert cli.main(asked) == 1
    assert "profile error: profile.loading-class" in capsys.readouterr().out
