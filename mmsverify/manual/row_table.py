"""The rows of one procedure or transition as a table: clause, event, guard, updates, answer."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mmsverify.manual.markdown import code, formula, stacked, table, text
from mmsverify.model import Clause
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.rows import SHOWN, Conjunct, Row
from mmsverify.model.show import shown

HEAD = ("clauses", "event", "guard", "updates", "answer")
Link = Callable[[Clause], str]


def row_table(rows: Sequence[Row], link: Link) -> str:
    """One line for each row, in the order in which they are tried; an event is named once."""
    return table(HEAD, (_row(row, rows[:place], link) for place, row in enumerate(rows)))


def _row(row: Row, above: Sequence[Row], link: Link) -> tuple[str, ...]:
    gone = [c for c in row.guard if implied(c, row, above)]
    guard = [formula(shown(c.condition)) for c in row.guard if c not in gone]
    updates = [formula(assigned(assign)) for assign in row.assigns]
    event = _event(row)
    same = bool(above) and event == _event(above[-1])
    clause = _without(row.clause, [c.clause for c in gone])
    return link(clause), "" if same else event, stacked(guard), stacked(updates), _answer(row)


def _without(clause: Clause, told: Sequence[Clause]) -> Clause:
    """What a row cites beyond the conditions that go without saying; all of it where nothing else is left."""
    ids = {name for other in told for name in (*other.ids, *other.readings)}
    own = Clause(*(tuple(i for i in group if i not in ids) for group in (clause.ids, clause.readings)))
    return own if own.ids else clause


def implied(conjunct: Conjunct, row: Row, above: Sequence[Row]) -> bool:
    """Whether a condition of a row goes without saying, as some row above it was not taken.

    It does if that row asks for the opposite and, for the rest, for nothing that this one does not ask for.
    """
    opposite = ex.negation(conjunct.condition)
    asked = {c.condition for c in row.guard} | {opposite}
    return any(
        opposite in conditions and conditions <= asked
        for conditions in ({c.condition for c in other.guard} for other in above)
    )


def _event(row: Row) -> str:
    """The event with its parameters, and what the controller is free to choose."""
    names = ", ".join(p.name for p in row.on.parameters)
    told = code(f"{row.on}({names})" if names else str(row.on))
    chosen = ", ".join(p.name for p in row.choices)
    return told + (f"<br>free: {code(chosen)}" if chosen else "")


def _answer(row: Row) -> str:
    return "" if row.answer == SHOWN else text(row.answer)


def assigned(assign: Assign) -> str:
    """An update as a line: the cell, its new value, for which elements."""
    args = ", ".join(map(shown, assign.args))
    cell = f"{assign.variable}[{args}]" if args else assign.variable
    elements = ", ".join(map(shown, assign.bound))
    every = f" for all {elements}" if elements else ""
    where = f" where {shown(assign.where)}" if assign.where != ex.TRUE else ""
    return f"{cell} := {shown(assign.value)}{every}{where}"
