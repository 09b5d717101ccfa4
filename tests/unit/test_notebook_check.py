"""Verdicts, runs and models in a notebook."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

import mmsverify as mv
from mmsverify.errors import UsageError
from mmsverify.notebook import NotebookCheck
from mmsverify.results import ModelCheck, PathStep, Verdict

LAMPS = """
from mmsverify.model import *


class Lamps(Model, name="lamps"):
    Lamp = Each("Lamp")
    a, b = Lamp.elements("a b")
    lit = Relation(Lamp)

    dark = Initially("L-0", for_all(a)(~lit[a]))
    press = Procedure("L-1", on=response("press", a), steps=[do("b", lit[a].becomes(True)), accept("c")])
    at_most_one = Always("L-2", for_all(a, b)((lit[a] & lit[b]) >> (a == b)))
    one_is_lit = Sometimes("L-3", for_some(a)(lit[a]))
"""


@pytest.fixture(scope="module")
def lamps(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("models") / "lamps.py"
    path.write_text(LAMPS, encoding="utf-8")
    return path


@cache
def checked(path: Path) -> NotebookCheck:
    return mv.check(path)


def test_a_violation_shows_the_run_that_breaks_it(lamps: Path) -> None:
    check = checked(lamps)
    assert not check.holds
    (verdict,) = check.violated
    assert verdict.name == "at-most-one"
    assert verdict.counterexample is not None
    assert [step.action for step in verdict.counterexample.steps][1:] == ["press result(+)"] * 2
    assert "press result(+)" in verdict._repr_html_()
    assert "at-most-one" in check._repr_html_()


def test_a_run_is_a_frame_of_what_each_step_changes(lamps: Path) -> None:
    run = checked(lamps)["at_most_one"].counterexample
    assert run is not None
    assert run.frame["changes"].tolist()[1:] == [{f"lit[Lamp{n}]": "false -> true"} for n in (1, 2)] or all(
        "false -> true" in str(changes) for changes in run.frame["changes"].tolist()[1:]
    )
    assert len(run.frame) == len(run) == 3


def test_a_witness_is_a_run_too(lamps: Path) -> None:
    verdict = checked(lamps)["one-is-lit"]
    assert verdict.result == "proved"
    assert verdict.witness is not None
    assert verdict.counterexample is None


def test_verdicts_are_a_frame(lamps: Path) -> None:
    frame = checked(lamps).frame
    assert frame.set_index("name")["result"].to_dict() == {"at-most-one": "violated", "one-is-lit": "proved"}
    assert str(frame["depth"].dtype) == "Int64"


def test_one_property_may_be_asked_for(lamps: Path) -> None:
    check = mv.check(lamps, properties="one-is-lit")
    assert [verdict.name for verdict in check] == ["one-is-lit"]
    with pytest.raises(UsageError, match="no verdict"):
        check["at-most-one"]


def test_an_unknown_property_is_refused_with_the_one_that_was_meant(lamps: Path) -> None:
    with pytest.raises(UsageError, match="did you mean one-is-lit"):
        mv.check(lamps, properties=["one-is-lid"])


def test_a_model_is_checked_in_its_own_variant() -> None:
    model = mv.model("vr-template", variant="repaired")
    check = model.check(properties=["homed-before-moving"])
    assert (check.result.variant, check.holds) == ("repaired", True)
    assert "72" in model._repr_html_()
    assert "homed-before-moving" in set(model.properties["name"])


def test_a_diagram_shows_itself_as_svg(lamps: Path, tmp_path: Path) -> None:
    drawing = mv.model(lamps).diagram()
    assert ET.fromstring(drawing._repr_svg_()).tag.endswith("svg")
    assert drawing.save(tmp_path / "d.svg").read_text(encoding="utf-8") == drawing.svg()


def test_no_name_of_a_model_becomes_markup() -> None:
    bad = "<img src=x onerror=alert(1)>"
    step = PathStep(bad, {bad: bad}, (bad,), {bad: bad})
    verdict = Verdict(bad, "always", (bad,), "violated", "bmc", bad, 0.0, 1, (step, step), None, bad, bad)
    shown = NotebookCheck(ModelCheck(bad, bad, [verdict], notes=[bad]))._repr_html_()
    assert "<img" not in shown
    assert "&lt;img" in shown
