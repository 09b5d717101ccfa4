"""The claims have teeth: a row that loses an effect, or a check, is caught by a claim.

A mutant differs in one row, and the other rows keep every claim; so only that row is proved again.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import pytest
from robot import robot

from mmsverify.model import PLUS, ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.symbolic.induction import Prover

# Effects and checks without which a claim fails: the row, what is taken from it.
LETHAL = [
    ("delete/e", "selected"),
    ("kill/c", "selected"),
    ("kill/c", "motion"),
    ("end_of_execution", "selected"),
    ("end_of_execution", "motion"),
    ("select/m", "controls"),
    ("select/m", "controller"),
    ("select/m", "selected"),
    ("stop/d", "motion"),
    ("vmd_stop/5", "motion"),
    ("vmd_stop/5", "physical"),
    ("vmd_reset/f", "selected"),
    ("emergency_stop", "motion"),
    ("release", "holder"),
]
CHECKS = [("select/m", "select.not-controlling"), ("select/m", "select.controlled-elsewhere"),
          ("select/m", "select.selected-active"), ("vmd_reset/f", "vmd-reset.intervention"),
          ("take_control/3", "take-control.taken"), ("create/0#2", "create.exists"),
          ("start/g", "start.arm-alone"), ("delete/e", "delete.not-deletable")]  # fmt: skip


def row_of(model: ModelData, name: str) -> Row:
    return next(row for row in model.actions if row.id == name)


def survives(row: Row) -> bool:
    """Whether every claim is still proved with this row in place of its original."""
    model = replace(robot("repaired"), rows=(row,))
    claims = [claim for claim in model.claims if claim.kind != "sometimes"]
    return len(Prover(model).prove(claims).proved) == len(claims)


def without_effect(row: Row, variable: str) -> Row:
    assert variable in row.writes
    return replace(row, assigns=tuple(a for a in row.assigns if a.variable != variable))


def without_check(row: Row, rule: str) -> Row:
    assert any(conjunct.rule == rule for conjunct in row.guard)
    return replace(row, guard=tuple(c for c in row.guard if c.rule != rule))


@pytest.mark.parametrize(("name", "variable"), LETHAL)
def test_a_row_that_loses_an_effect_is_caught(name: str, variable: str) -> None:
    assert not survives(without_effect(row_of(robot("repaired"), name), variable))


@pytest.mark.parametrize(("name", "rule"), CHECKS)
def test_a_row_that_loses_a_check_is_caught(name: str, rule: str) -> None:
    assert not survives(without_check(row_of(robot("repaired"), name), rule))


@pytest.mark.parametrize(("name", "rule"), CHECKS)
def test_a_row_whose_check_is_turned_round_is_caught(name: str, rule: str) -> None:
    row = row_of(robot("repaired"), name)
    turned = tuple(replace(c, condition=ex.negation(c.condition)) if c.rule == rule else c for c in row.guard)
    assert not survives(replace(row, guard=turned))


def mutants() -> Iterator[Row]:
    for row in robot("repaired").actions:
        if row.answer == PLUS:
            for variable in sorted(row.writes):
                yield without_effect(row, variable)


@pytest.mark.slow
def test_most_effects_of_accepting_rows_matter_to_some_claim() -> None:
    caught = [not survives(mutant) for mutant in mutants()]
    assert sum(caught) / len(caught) >= LEAST_CAUGHT


LEAST_CAUGHT = 0.59
"""A ratchet: it may rise, never fall. What is left writes counters and attributes that no claim reads."""
