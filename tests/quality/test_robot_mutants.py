"""The claims and recordings have teeth: of rules and claims written otherwise, nearly all are noticed.

The whole is measured by ``bench/mutants.py``, which writes docs/mutation.md.
"""

from __future__ import annotations

from collections import Counter
from pathlib import Path

import pytest
from mutant_judge import Judge
from mutation import DROPPED, LOST, Mutant, mutants
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN
from robot import robot
from robot_score import RobotScore, numbered_mutants

EVERY = 43
FROM = 7
LEAST = 0.95
"""Of the mutants that are not equal, this share is killed."""


def a_mutant(place: str, kind: str) -> Mutant:
    return next(m for m in mutants(robot("repaired")) if (m.place, m.kind) == (place, kind))


@pytest.fixture(scope="module")
def judge() -> Judge:
    return Judge(robot("repaired"))


@pytest.mark.parametrize(
    ("place", "kind"),
    [
        ("select: select.not-controlling", DROPPED),
        ("start: start.arm-alone", DROPPED),
        ("kill: selected", LOST),
        ("stop: motion", LOST),
        ("create: reusable", LOST),
        ("release: domain_state", LOST),
    ],
)
def test_a_claim_is_lost_with_a_check_or_an_effect(judge: Judge, place: str, kind: str) -> None:
    assert judge.lost(a_mutant(place, kind))


@pytest.mark.slow
def test_a_model_that_is_not_changed_loses_no_claim_and_is_equal(judge: Judge) -> None:
    real = judge.model.rows
    for name in ("select", "kill", "end_of_execution"):
        rows = {number: row for number, row in enumerate(real) if row.name == name}
        unchanged = Mutant("", "", name, dict(rows))
        assert judge.lost(unchanged) == ""
        assert judge.alike(unchanged)


@pytest.mark.slow
def test_nearly_every_mutant_of_a_sample_is_noticed(tmp_path: Path) -> None:
    score = RobotScore(tmp_path)
    fates = [score.fate(number) for number in range(FROM, len(numbered_mutants()), EVERY)]
    counted = Counter(fate.fate for fate in fates)
    assert len(fates) - counted[EQUAL] >= 30
    killed = counted[CHECK] + counted[AUDIT]
    assert killed / (killed + counted[OPEN]) >= LEAST, [str(fate) for fate in fates if fate.open]
