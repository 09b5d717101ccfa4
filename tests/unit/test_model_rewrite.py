"""Rewriting of expressions: every cell is replaced once, however the formula around it is simplified."""

from __future__ import annotations

import pytest

from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Cell, Expr
from mmsverify.model.rows import after
from mmsverify.model.sorts import BOOL

FLAG, MARK = Cell("flag", (), BOOL), Cell("mark", (), BOOL)
FLIP = Assign("flag", (), ex.negation(FLAG))


@pytest.mark.parametrize(
    ("formula", "later"),
    [
        (FLAG, ex.negation(FLAG)),
        (ex.negation(FLAG), FLAG),
        (ex.conjunction(ex.negation(FLAG), MARK), ex.conjunction(FLAG, MARK)),
        (ex.choice(MARK, ex.negation(FLAG), FLAG), ex.choice(MARK, FLAG, ex.negation(FLAG))),
    ],
)
def test_a_flag_that_is_flipped_is_flipped_once(formula: Expr, later: Expr) -> None:
    assert after(formula, [FLIP]) == later


def test_a_connective_of_which_one_cell_is_left_is_not_changed_again() -> None:
    swap = [Assign("flag", (), MARK), Assign("mark", (), FLAG)]
    assert after(ex.disjunction(FLAG, ex.negation(ex.negation(MARK))), swap) == ex.disjunction(MARK, FLAG)
    assert after(ex.negation(FLAG), [Assign("flag", (), ex.negation(MARK))]) == MARK
    assert after(ex.negation(FLAG), [Assign("flag", (), ex.negation(FLAG)), Assign("mark", (), FLAG)]) == FLAG
