"""The repaired robot keeps every claim under every shipped profile, whatever else is there."""

from __future__ import annotations

from pathlib import Path

import pytest
from robot import robot

from mmsverify.checking import check_models
from mmsverify.checking.profile_facts import assumed
from mmsverify.model import expr as ex
from mmsverify.profiles import ROBOT_TABLE, load_profile, shipped
from mmsverify.symbolic.consistency import contradicted

# What the text excepts: a robot that is never in ROBOT-IDLE, one that goes from there to READY at once, one
# with a single association, one without step control; and what only a robot can do that has a program
# invocation for its arm, by its standardized name (8.3.1) or at all (6.3.2.2).
NEVER_IDLE = {"idle-reached", "t02-clear", "t10-clear-abort", "t11-clear-abandon", "clear-by-reset"}
AT_ONCE = {"t01-load", "loaded-at-the-panel"}
SINGLE = {"several-are-associated", "hangs-after-time", "ownership-ends-in-time"}
SEVERAL_TASKS = {"load-and-assign"}
NO_STEPS = {"runs-steps", "steps-end", "steps-down"}
NO_R_ARM = {"arm-stops-running"}
NO_ARM_PROGRAM = {"stops-by-arm", "arm-rests-after-stop"}
EXCEPTED = {
    "multi-client": SEVERAL_TASKS,
    "no-controlled": SINGLE | SEVERAL_TASKS | NO_R_ARM | NO_ARM_PROGRAM,
    "no-step": SINGLE | SEVERAL_TASKS | NO_STEPS,
    "one-program": SINGLE | AT_ONCE,
    "predefined-task": SINGLE | SEVERAL_TASKS | NEVER_IDLE | AT_ONCE,
    "single-arm": SINGLE | SEVERAL_TASKS,
    "two-arms": SINGLE | SEVERAL_TASKS | NO_R_ARM,
}


@pytest.mark.parametrize("name", shipped(ROBOT_TABLE))
@pytest.mark.parametrize("variant", ["as-written", "repaired"])
def test_a_shipped_profile_contradicts_nothing_that_is_assumed_of_robots(name: str, variant: str) -> None:
    model = robot(variant)
    facts = assumed(model, load_profile(name)[ROBOT_TABLE])
    assert facts
    assert contradicted(model, facts) is None


@pytest.mark.slow
@pytest.mark.exercises(every="property", of="mms-robot")
@pytest.mark.parametrize("name", shipped(ROBOT_TABLE))
def test_repaired_keeps_every_claim_under_a_shipped_profile_and_reaches_what_it_says(name: str) -> None:
    (found,) = check_models(["mms-robot"], variant="repaired", profile=Path(name))
    assert [(v.name, v.reason) for v in found.verdicts if v.result != "proved"] == []
    assert [v.name for v in found.verdicts if v.kind == "sometimes" and not v.witness] == []
    assert {v.method for v in found.verdicts if v.kind != "sometimes"} == {"induction"}
    made = {claim.title for claim in robot("repaired").claims}
    assert made - {v.name for v in found.verdicts} == EXCEPTED[name]


@pytest.mark.exercises("R-5.3.1.3.3.4-2", "R-6.3.5.2-2", "R-5.3.2-2")
def test_a_claim_says_of_which_profiles_it_is_made() -> None:
    conditional = {c.title for c in robot("repaired").claims if c.provided != ex.TRUE}
    assert conditional == set().union(*EXCEPTED.values())
