"""Profiles: defaults, what a file or a recording says instead, and one line for each mistake."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify.errors import ProfileError
from mmsverify.profiles import KEYS, from_metadata, load_profile, within_framework


def written(folder: Path, text: str) -> Path:
    path = folder / "profile.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_without_a_file_every_model_has_its_defaults() -> None:
    tables = load_profile(None)
    assert set(tables) == {"mms-robot", "vr-template", "modbus-signals"}
    assert all(set(tables[model]) == set(KEYS[model]) for model in tables)


def test_the_default_robot_has_an_arm_and_a_calibration_program() -> None:
    robot = load_profile(None)["mms-robot"]
    assert [(e["name"], e["control"], e["deletable"], e["reusable"]) for e in robot["predefined"]] == [
        ("R_ARM", "CONTROLLED", False, True),
        ("R_CAL", "NORMAL", False, True),
    ]
    assert robot["associations"] == "single"


def test_a_file_says_what_differs_and_the_rest_stays(tmp_path: Path) -> None:
    path = written(tmp_path, '[mms-robot]\nassociations = "multiple"\n')
    robot = load_profile(path)["mms-robot"]
    assert robot["associations"] == "multiple"
    assert robot["step_limited"] is True


def test_an_entry_of_predefined_is_completed(tmp_path: Path) -> None:
    path = written(tmp_path, '[mms-robot]\npredefined = [{name = "TASK", control = "CONTROLLING"}]\n')
    (entry,) = load_profile(path)["mms-robot"]["predefined"]
    assert entry == {
        "name": "TASK", "control": "CONTROLLING", "domains": [], "deletable": True, "reusable": True,
        "controlled": [],
    }  # fmt: skip


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("[mms_robot]\n", ["unknown table [mms_robot]", "did you mean mms-robot?"]),
        ("[mms-robot]\nassociation = 1\n", ["unknown key association", "did you mean associations?"]),
        ('[mms-robot]\nassociations = "two"\n', ["'two' is not allowed", '"single"', '"multiple"']),
        ("[modbus-signals]\nmax_clients = 0\n", ["max_clients = 0 is not allowed", "an integer from 1"]),
        ("[modbus-signals]\nmax_clients = true\n", ["is not allowed"]),
        ("[modbus-signals]\noutputs = [9, 1]\n", ["two integers [first, last]"]),
        ("[mms-robot]\npredefined = [1]\n", ["not a table with a name"]),
        ('[mms-robot]\npredefined = [{name = "A", kind = 1}]\n', ["predefined A", "unknown key kind"]),
        ('[mms-robot]\npredefined = [{name = "A"}, {name = "A"}]\n', ["A is predefined twice"]),
        ('[mms-robot]\nselected_at_power_on = "R_CAL"\n', ["not a predefined CONTROLLING"]),
        ("mms-robot = 3\n", ["is not a table"]),
        ("[mms-robot\n", ["not valid TOML"]),
    ],
)
def test_a_mistake_is_told_with_place_and_cure(tmp_path: Path, text: str, told: list[str]) -> None:
    path = written(tmp_path, text)
    with pytest.raises(ProfileError) as caught:
        load_profile(path)
    assert all(part in str(caught.value) for part in [*told, str(path)])


def test_a_file_that_is_not_there_is_told(tmp_path: Path) -> None:
    with pytest.raises(ProfileError, match="cannot be read"):
        load_profile(tmp_path / "none.toml")


def test_a_recording_carries_its_profile_as_strings() -> None:
    tables = from_metadata(
        {
            "model": "mms-robot",
            "associations": "multiple",
            "step_limited": "false",
            "predefined": '[{"name": "TASK", "control": "CONTROLLING", "deletable": false}]',
            "selected_at_power_on": "TASK",
        },
        "a.mcap",
    )
    robot = tables["mms-robot"]
    assert set(tables) == {"mms-robot"}
    assert (robot["associations"], robot["step_limited"], robot["selected_at_power_on"]) == (
        "multiple",
        False,
        "TASK",
    )
    assert robot["predefined"][0]["name"] == "TASK"


def test_a_recording_without_a_model_carries_no_profile() -> None:
    assert from_metadata({"associations": "multiple"}, "a.mcap") == {}


def test_a_mistake_in_a_recording_names_the_recording() -> None:
    with pytest.raises(ProfileError, match=r"a\.mcap"):
        from_metadata({"model": "mms-robot", "arms": "seven"}, "a.mcap")


def command(rest: str) -> str:
    return f'[[vr-template.commands]]\nname = "a"\n{rest}\n'


def test_a_command_is_allowed_where_the_framework_has_it_unless_it_says_otherwise(tmp_path: Path) -> None:
    numbers = (101, 201, 301, 401)
    entries = ", ".join(f'{{number = {n}, name = "{n}", sub_mode = 0}}' for n in numbers)
    table = load_profile(written(tmp_path, f"[vr-template]\ncommands = [{entries}]\n"))["vr-template"]
    assert [entry["allowed"] for entry in table["commands"]] == [
        ["DbgRdy", "HomeRdy", "OrgRdy"], ["HomeRdy", "OrgRdy"], ["OrgRdy"], ["Run"],
    ]  # fmt: skip
    assert {entry["homing"] for entry in table["commands"]} == {"keeps"}


def test_a_machine_is_held_to_what_both_its_table_and_the_framework_allow(tmp_path: Path) -> None:
    path = written(tmp_path, command('number = 201\nsub_mode = 1\nallowed = ["DbgRdy", "OrgRdy"]'))
    tables = load_profile(path)
    assert tables["vr-template"]["commands"][0]["allowed"] == ["DbgRdy", "OrgRdy"]
    assert within_framework(tables)["vr-template"]["commands"][0]["allowed"] == ["OrgRdy"]


@pytest.mark.parametrize(
    ("text", "told"),
    [
        (command("number = 200\nsub_mode = 1"), ["commands a", "number = 200 is not allowed", "201-299"]),
        (command("number = 100\nsub_mode = 1"), ["number = 100 is not allowed"]),
        (command("number = 500\nsub_mode = 1"), ["number = 500 is not allowed"]),
        (command("number = 10\nsub_mode = 1"), ["number = 10 is not allowed"]),
        (command('number = "101"\nsub_mode = 1'), ["number = '101' is not allowed"]),
        (command("number = 101"), ["sub_mode is missing", "an integer from 0"]),
        (command("number = 101\nsub_mode = -1"), ["sub_mode = -1 is not allowed"]),
        (command("sub_mode = 1"), ["number is missing"]),
        (command("number = 101\nsub_mod = 1"), ["unknown key sub_mod", "did you mean sub_mode?"]),
        (command('number = 101\nsub_mode = 1\nallowed = ["HomRdy"]'), ["did you mean HomeRdy?"]),
        (command('number = 101\nsub_mode = 1\nallowed = ["Home"]'), ["is not allowed", '"OrgRdy"']),
        (command('number = 101\nsub_mode = 1\nhoming = "lose"'), ["did you mean loses?"]),
        ("[[vr-template.commands]]\nnumber = 101\n", ["not a table with a name"]),
        ("[vr-template]\ncommands = 3\n", ["commands = 3 is not allowed"]),
        (command("number = 101\nsub_mode = 1") * 2, ["two commands have the number 101"]),
        (command("number = 101\nsub_mode = 1") + command("number = 102\nsub_mode = 2"), ["have the name a"]),
        (
            command("number = 101\nsub_mode = 1").replace('"a"', '"b"')
            + command('number = 102\nsub_mode = 1\nhoming = "loses"'),
            ["b and a are one action", "sub_mode = 1", "two sub-modes"],
        ),
    ],
)
def test_a_mistake_in_a_command_is_told_with_the_command_and_the_cure(
    tmp_path: Path, text: str, told: list[str]
) -> None:
    with pytest.raises(ProfileError) as caught:
        load_profile(written(tmp_path, text))
    assert all(words in str(caught.value) for words in told), str(caught.value)
    assert "\n" not in str(caught.value)


def test_commands_of_two_hundreds_may_have_one_sub_mode_and_do_different_things(tmp_path: Path) -> None:
    text = command("number = 201\nsub_mode = 1") + command(
        'number = 101\nsub_mode = 1\nhoming = "loses"'
    ).replace('"a"', '"b"')
    assert len(load_profile(written(tmp_path, text))["vr-template"]["commands"]) == 2


def test_a_recording_carries_its_commands_too() -> None:
    listed = '[{"number": 101, "name": "jog", "sub_mode": 1}]'
    tables = from_metadata({"model": "vr-template", "commands": listed}, "a.mcap")
    assert [entry["number"] for entry in tables["vr-template"]["commands"]] == [101]
