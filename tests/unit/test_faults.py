"""The survey of a text: every property against every procedure, on a small text with known faults."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from mmsverify.cli import main
from mmsverify.faults import find_faults
from mmsverify.results import Fault, Survey

DOOR = """
from mmsverify.model import *


class Light(Enumeration):
    RED = "RED"
    GREEN = "GREEN"


class Door(Model):
    D = Each("Door")
    a, b = D.elements("a b")
    opened = Relation(D)
    light = Variable(Light)
    shut = Initially("D-0", for_all(a)(~opened[a]) & (light() == Light.RED))
    one_open = Always("D-1", for_all(a, b)((opened[a] & opened[b]) >> (a == b)),
                      says="one door is open at most")
    red_stays = Step("D-2", (light() == Light.RED) >> (light().next == Light.RED))
    close_is_harmless = Step("D-3", service_is("close") >> (light().next == light()))
    alarm = Sometimes("D-4", for_some(a)(opened[a]) & (light() == Light.RED) & (light() == Light.GREEN))
    close = Procedure("D-20", on=response("close", a), steps=[
        refuse("a", unless=opened[a], says="{a} is not open"),
        do("b", opened[a].becomes(False)),
        refuse("c", when=opened[a], says="{a} is still open"),
        accept("d"),
    ])


class AsWritten(Door, name="door", variant="as-written", standard="DOOR 1", views={"light": "light"},
                consequences={"one_open": "Both doors stand open: the air escapes."}):
    open_ = Procedure("D-10", on=response("open", a), steps=[
        do("a", opened[a].becomes(True)),
        may("b", light().becomes(Light.GREEN)),
        accept("c"),
    ])


class Repaired(Door, name="door", variant="repaired"):
    open_ = Procedure("D-10", on=response("open", a), steps=[
        refuse("R-2", "RP-2", when=light() == Light.GREEN, says="the light is green"),
        refuse("R-1", when=for_some(b)(opened[b]), says="a door is open before {a}"),
        do("a", opened[a].becomes(True)),
        accept("c"),
    ], repairs=repaired("RP-1", "D-10-a", because="the doors of a lock exclude each other"))
"""


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("models") / "door.py"
    file.write_text(DOOR, encoding="utf-8")
    return file


@pytest.fixture(scope="module")
def survey(path: Path) -> Survey:
    return find_faults(str(path))


@pytest.fixture(scope="module")
def faults(survey: Survey) -> dict[str, Fault]:
    return {fault.name: fault for fault in survey.faults}


def test_what_holds_is_no_fault_and_what_does_not_is_one(faults: dict[str, Fault]) -> None:
    assert sorted(faults) == ["one-open", "red-stays"]


def test_a_fault_has_the_shortest_run_that_breaks_it(faults: dict[str, Fault]) -> None:
    (breach,) = faults["one-open"].breaches
    assert breach.procedure == "open_"
    assert [step.action for step in breach.steps] == ["initially", "open_ result(+)", "open_ result(+)"]


def test_a_property_of_one_attribute_is_told_by_its_changes(faults: dict[str, Fault]) -> None:
    assert [b.change for b in faults["red-stays"].breaches] == ["RED -> GREEN"]


def test_a_fault_names_the_step_that_mends_it_and_no_other_and_what_is_proved_there(
    faults: dict[str, Fault],
) -> None:
    (mending,) = faults["one-open"].mendings
    assert (mending.declaration, mending.reading, mending.clauses) == ("open_/R-1", "RP-1", ("R-1",))
    assert mending.because == "refuses: a door is open before D2"
    assert faults["one-open"].mended == "proved in repaired, for any number of elements"


def test_an_effect_that_is_dropped_is_mended_by_the_whole_procedure(faults: dict[str, Fault]) -> None:
    (mending,) = faults["red-stays"].mendings
    assert (mending.declaration, mending.reading, mending.clauses) == ("open_", "RP-1", ("D-10-a",))
    assert mending.because == "leads to light = RED: the doors of a lock exclude each other"


def test_a_fault_says_what_it_means_for_a_plant(faults: dict[str, Fault]) -> None:
    assert faults["one-open"].consequence == "Both doors stand open: the air escapes."


def test_a_step_that_no_state_reaches_is_told(survey: Survey) -> None:
    assert [o.name for o in survey.oddities if o.kind == "unreachable"] == ["alarm", "close/c"]


def test_a_free_choice_of_the_text_is_told(survey: Survey) -> None:
    assert [o.name for o in survey.oddities if o.kind == "choice"] == ["open_, step b"]


def test_a_repaired_text_without_faults_ends_with_status_0(path: Path) -> None:
    assert main(["findings", str(path), "--variant", "repaired", "-o", str(path.with_suffix(".md"))]) == 0


def test_the_document_tells_clause_consequence_run_and_repair(path: Path, tmp_path: Path) -> None:
    assert main(["findings", str(path), "-o", str(tmp_path / "out.md")]) == 1
    text = (tmp_path / "out.md").read_text(encoding="utf-8")
    for part in (
        "# Where DOOR 1 breaks its own rules",
        "*one door is open at most* (D-1)",
        "**For a plant:** Both doors stand open: the air escapes.",
        "The shortest run, by `open_` (2 steps; nothing predefined):",
        "opened[D2]: false -> true",
        "- `open_/R-1` (RP-1; R-1): refuses: a door is open before D2",
        "## What the text says in vain",
    ):
        assert part in text


def test_the_survey_says_once_that_it_may_take_long_unless_it_shall_be_quiet(
    path: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["findings", str(path), "-o", str(tmp_path / "out.md")]) == 1
    assert capsys.readouterr().err == (
        "door: proving what holds, then property by property: a large model takes minutes\n"
    )
    assert main(["findings", str(path), "--quiet", "-o", str(tmp_path / "out.md")]) == 1
    assert capsys.readouterr().err == ""


def test_the_faults_as_json_keep_every_step(path: Path, tmp_path: Path) -> None:
    assert main(["findings", str(path), "--format", "json", "-o", str(tmp_path / "out.json")]) == 1
    found = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert found["schema"] == "mmsverify.findings/1"
    assert [len(fault["breaches"][0]["steps"]) for fault in found["faults"]] == [3, 2]
