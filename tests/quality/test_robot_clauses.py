"""Every citation of the robot model has the right form; whether it names a statement, the docs tests tell."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from robot import VARIANTS, robot

from mmsverify.model import Clause

FORM = re.compile(r"R-(F|[AT]?[0-9]+(\.[0-9]+)*)-[A-Za-z0-9]+$|R-T[0-9]+-[0-9]+$")
READING = re.compile(r"RP-[0-3][0-9]$|B-[A-Z]+(-[A-Z]+)?$")


def citations(variant: str) -> Iterator[Clause]:
    model = robot(variant)
    for row in model.rows:
        yield row.clause
        yield from (conjunct.clause for conjunct in row.guard)
    yield from (claim.clause for claim in model.claims)
    yield from (conjunct.clause for conjunct in (*model.initial, *model.assumptions))
    yield from (gap.clause for gap in model.gaps)
    yield from (repair.mends for repair in model.repairs.values())


@pytest.mark.parametrize("variant", VARIANTS)
def test_citations_have_the_form_of_clauses_and_readings(variant: str) -> None:
    odd = [i for clause in citations(variant) for i in clause.ids if not FORM.match(i)]
    odd += [i for clause in citations(variant) for i in clause.readings if not READING.match(i)]
    assert sorted(set(odd)) == []


@pytest.mark.parametrize("variant", VARIANTS)
def test_every_row_and_claim_cites_something(variant: str) -> None:
    model = robot(variant)
    assert [row.id for row in model.rows if not row.clause.ids + row.clause.readings] == []
    assert [claim.name for claim in model.claims if not claim.clause.ids + claim.clause.readings] == []


def test_every_repair_names_a_clause_that_it_mends_and_says_why() -> None:
    repairs = robot("repaired").repairs
    assert repairs
    assert [name for name, r in repairs.items() if not (r.mends.ids and r.mends.readings and r.because)] == []
