"""The repaired robot keeps every claim under every shipped profile, whatever else is there."""

from __future__ import annotations

import pytest
from robot import robot

from mmsverify.checking.profile_facts import assumed
from mmsverify.checking.proofs import Proofs
from mmsverify.model import expr as ex
from mmsverify.profiles import ROBOT_TABLE, load_profile, shipped
from mmsverify.symbolic.consistency import contradicted

# What the text excepts: a robot that is never in ROBOT-IDLE, one that goes from there to READY at once, one
# with a single association. The last two claims are made of robots of just one kind.
NEVER_IDLE = {"idle-reached", "t02-clear", "t10-clear-abort", "t11-clear-abandon", "clear-by-reset"}
AT_ONCE = {"t01-load", "loaded-at-the-panel"}
EXCEPTED = {
    "one-program": AT_ONCE | {"several-are-associated"},
    "predefined-task": NEVER_IDLE | AT_ONCE | {"several-are-associated", "load-and-assign"},
}


@pytest.mark.parametrize("name", shipped())
@pytest.mark.parametrize("variant", ["as-written", "repaired"])
def test_a_shipped_profile_contradicts_nothing_that_is_assumed_of_robots(name: str, variant: str) -> None:
    model = robot(variant)
    facts = assumed(model, load_profile(name)[ROBOT_TABLE])
    assert facts
    assert contradicted(model, facts) is None


@pytest.mark.slow
@pytest.mark.exercises(every="property")
@pytest.mark.parametrize("name", shipped())
def test_repaired_is_proved_for_any_number_under_a_shipped_profile(name: str) -> None:
    model = robot("repaired")
    proofs = Proofs(model, assumed=assumed(model, load_profile(name)[ROBOT_TABLE]))
    claims = [claim for claim in model.claims if claim.kind != "sometimes"]
    proofs.attempt(claims)
    assert [claim.name for claim in claims if claim.name not in proofs.proved] == []


@pytest.mark.exercises("R-5.3.1.3.3.4-2", "R-6.3.5.2-2")
def test_a_claim_says_of_which_profiles_it_is_made() -> None:
    conditional = {c.title for c in robot("repaired").claims if c.provided != ex.TRUE}
    assert conditional == set().union(*EXCEPTED.values())
