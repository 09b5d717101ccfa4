"""What the robot model claims of itself: repaired keeps all of it, as written breaks what is known."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot import VARIANTS, look, robot
from robot_broken import BROKEN

from mmsverify.checking import check_models
from mmsverify.checking.certificates import write_certificates
from mmsverify.checking.runs import alike
from mmsverify.checking.worlds import World
from mmsverify.concrete.machine import speaks_of_steps
from mmsverify.model import Claim
from mmsverify.model import expr as ex
from mmsverify.model.expr import Expr
from mmsverify.results import ModelCheck
from mmsverify.symbolic.certificate import reads_as

EVERY_SCOPE = "any number of PI, Client, Request, Domain, Upload, Device, Joint"


def checked(variant: str) -> ModelCheck:
    (found,) = check_models(["mms-robot"], variant=variant)
    return found


@pytest.mark.slow
@pytest.mark.exercises(every="property", of="mms-robot")
def test_repaired_keeps_every_claim_for_any_number_and_reaches_what_it_says() -> None:
    for verdict in checked("repaired").verdicts:
        assert verdict.result == "proved", verdict
        if verdict.kind == "sometimes":
            assert verdict.witness, verdict.name
        else:
            assert (verdict.method, verdict.scope) == ("induction", EVERY_SCOPE)


@pytest.mark.slow
@pytest.mark.exercises(every="property", of="mms-robot")
def test_as_written_breaks_the_known_claims_and_the_others_are_proved() -> None:
    verdicts = checked("as-written").verdicts
    broken = {v.name: len(v.counterexample or ()) - 1 for v in verdicts if v.result == "violated"}
    assert broken == BROKEN  # every counterexample was replayed by the judge before it was reported
    assert [v.name for v in verdicts if v.result == "unknown"] == []


def implied_of(claim: Claim) -> Expr:
    """The condition under which an invariant demands something, for some elements; true where it has none."""
    body: Expr = claim.formula
    bound: tuple[ex.Ref, ...] = ()
    if isinstance(body, ex.Quantified) and body.universal:
        bound, body = body.bound, body.body
    conditions = body.parts[:-1] if isinstance(body, ex.Or) else ()
    return ex.quantified(False, bound, ex.conjunction(*map(ex.negation, conditions)))


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_no_claim_about_states_is_vacuous(variant: str) -> None:
    model = robot(variant)
    demanding = {c.name: implied_of(c) for c in model.always}
    asked = [
        Claim(name, "sometimes", model.always[0].clause, formula)
        for name, formula in demanding.items()
        if formula != ex.TRUE
    ]
    for world in WORLDS:
        met: set[str] = set()
        for group in alike(model, asked):
            met |= look(model, group, world.scope(model), states=60_000).witnesses.keys()
        asked = [claim for claim in asked if claim.name not in met]
    assert sorted(claim.name for claim in asked) == VACUOUS[variant]


ARM = {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False}
CALIBRATION = {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False}
OTHER = {"name": "OTHER", "control": "NORMAL", "domains": ["R_ARM"], "deletable": False}
WORLDS = (
    World({"PI": 2}, {"predefined": [ARM]}),
    World({"PI": 1, "Domain": 1, "Upload": 1}, {"predefined": []}),
    World({"PI": 2, "Domain": 2}, {"predefined": [ARM, CALIBRATION]}),
    World({"PI": 2, "Domain": 1}, {"predefined": [ARM, OTHER]}),
    World({"PI": 2, "Domain": 1}, {"predefined": [CALIBRATION]}),
    World({"PI": 1, "Client": 2}, {"predefined": [ARM], "associations": "multiple"}),
    World({"PI": 1}, {"predefined": [], "single_task": True}),
)
# As written, c2) of Start ends before f): no motion is enabled.
VACUOUS = {
    "as-written": ["motion_has_running_arm", "motion_only_executing"],
    "repaired": [],
}


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_robot_state_and_every_arrow_of_figure_8_is_asked_for(variant: str) -> None:
    sometimes = [claim for claim in robot(variant).claims if claim.kind == "sometimes"]
    assert sum(not speaks_of_steps(claim) for claim in sometimes) >= 6
    assert sum(speaks_of_steps(claim) for claim in sometimes) >= 12


@pytest.mark.slow
@pytest.mark.exercises(every="property", of="mms-robot")
def test_the_proof_of_repaired_stands_when_it_is_read_anew_from_its_files(tmp_path: Path) -> None:
    paths = write_certificates("mms-robot", tmp_path)
    assert len(paths) > 100
    assert [path.name for path in paths if reads_as(path.read_text(encoding="ascii")) != "unsat"] == []
