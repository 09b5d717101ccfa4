"""Evidence of a proof is checked by other means; gaps and overlaps of rows are found."""

from __future__ import annotations

from dataclasses import replace

import pytest
from small_models import Lamps

from mmsverify.concrete import Scope, search
from mmsverify.concrete.slicing import cone, narrowed, restored, sliced
from mmsverify.model import Claim, Model, Relation, Transition, accept, assemble, internal, response
from mmsverify.model import expr as ex
from mmsverify.model.procedure import Procedure
from mmsverify.symbolic.certificate import certificates, reads_as
from mmsverify.symbolic.induction import Prover
from mmsverify.symbolic.overlap import Coverage
from mmsverify.symbolic.sharpen import sharpened

LAMPS = assemble(Lamps)
SCOPE = Scope({"L": ("L1", "L2")})


def proved() -> list[Claim]:
    names = Prover(LAMPS).prove(LAMPS.claims).proved
    return [claim for claim in LAMPS.claims if claim.name in names]


def test_every_script_of_a_proof_is_unsatisfiable_when_it_is_read_anew() -> None:
    scripts = list(certificates(LAMPS, proved()))
    assert {reads_as(each.script) for each in scripts} == {"unsat"}
    assert scripts[0].about == "start"
    assert all(each.script.isascii() for each in scripts)


def test_the_script_of_a_false_claim_is_satisfiable() -> None:
    wrong = next(claim for claim in LAMPS.claims if claim.name == "nothing_ripens")
    answers = {each.about: reads_as(each.script) for each in certificates(LAMPS, [wrong])}
    assert answers["ripen"] == "sat"


def test_a_sharper_claim_implies_the_claim_that_it_is_made_from() -> None:
    for claim in LAMPS.always:
        for sharper in sharpened([claim]):
            model = replace(LAMPS, rows=(), initial=())
            outcome = Prover(model, facts=[sharper.formula]).prove([claim])
            assert claim.name in outcome.proved


class Switch(Model, name="switch"):
    """Two rows that both answer; one event that nothing answers while the switch is on."""

    on = Relation()
    a = Transition("S-1", on=internal("toggle"), then=[on().becomes(~on())])
    b = Transition("S-2", on=response("press"), when=[on()], then=[on().becomes(False)], answer="result(+)")
    c = Transition("S-3", on=response("press"), when=[on()], answer="result(+)")
    d = Procedure("S-4", on=response("ask"), steps=[accept("m")])


def test_rows_that_answer_one_event_differently_in_one_state_overlap() -> None:
    assert [each.rows for each in Coverage(assemble(Switch), ()).overlaps()] == [("b", "c")]


def test_a_response_that_no_row_gives_in_some_state_is_a_gap() -> None:
    assert [(gap.event, gap.proved) for gap in Coverage(assemble(Switch), ()).gaps()] == [
        ("press.response", True)
    ]


@pytest.mark.parametrize("claim", LAMPS.claims, ids=lambda claim: claim.name)
def test_the_part_that_matters_settles_a_claim_in_as_many_steps_as_the_whole(claim: Claim) -> None:
    whole = search(LAMPS, SCOPE, claims=[claim])
    part = sliced(LAMPS, [claim])
    few = search(part, narrowed(part, SCOPE), claims=[claim])
    paths, short = ({**r.violations, **r.witnesses} for r in (whole, few))
    assert {name: len(path) for name, path in paths.items()} == {
        name: len(path) for name, path in short.items()
    }
    for path in short.values():
        assert len(restored(LAMPS, SCOPE, path)) == len(path)


def test_what_a_claim_does_not_rest_on_is_left_out() -> None:
    lit = next(claim for claim in LAMPS.claims if claim.name == "one_lit")
    assert cone(LAMPS, lit) == {"lit"}
    assert [row.name for row in sliced(LAMPS, [lit]).rows] == ["press"]
    assert ex.variables_of(sliced(LAMPS, [lit]).rows[0].guard_formula) == {"lit"}
