"""Mutants of a model: a step dropped, a condition negated, an effect lost, a target changed.

A mutant of a procedure's step changes every row that the step has part in, as if it were printed otherwise.
Transitions, observations and what makes an event occur are changed alike. Where a rule looks a value up in a
table, each entry of the table can be changed, too.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace

from mmsverify.model import ModelData, Row
from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr
from mmsverify.model.occurrences import Occurrence
from mmsverify.model.rows import MINUS, Clause, Conjunct
from mmsverify.model.show import shown
from mmsverify.model.sorts import BOOL, EnumSort

STEP, TRANSITION, OBSERVATION, EVENT = "procedure step", "transition", "observation", "event"
DROPPED, NEGATED, LOST, CHANGED = "step dropped", "condition negated", "effect lost", "target changed"


@dataclass(frozen=True)
class Mutant:
    """One change: to what, of which kind, where; the rows as they are then, by the place of the real one.

    A row that is gone is ``None``. ``clauses`` are those of what is changed.
    """

    what: str
    kind: str
    place: str
    rows: Mapping[int, Row | None]
    clauses: frozenset[str] = frozenset()
    occurrences: Mapping[int, Occurrence] = field(default_factory=dict)

    def __str__(self) -> str:
        return f"{self.what}, {self.kind}: {self.place}"

    def applied(self, model: ModelData) -> ModelData:
        """The model with the change."""
        rows = [self.rows.get(number, row) for number, row in enumerate(model.rows)]
        events = tuple(self.occurrences.get(number, o) for number, o in enumerate(model.occurrences))
        return replace(model, rows=tuple(row for row in rows if row is not None), occurrences=events)


def mutants(model: ModelData, *, entries: bool = False) -> Iterator[Mutant]:
    """All mutants of the rows, in order of the rows, and of the events.

    With ``entries`` those of the entries of tables, too.
    """
    by_name: dict[str, list[int]] = {}
    for number, row in enumerate(model.rows):
        by_name.setdefault(row.name, []).append(number)
    for numbers in by_name.values():
        rows = {number: model.rows[number] for number in numbers}
        made = [*_of_conditions(rows), *_of_effects(rows)]
        if entries:
            made += [entry for entry in _of_entries(rows) if all(entry.rows != m.rows for m in made)]
        yield from _numbered(made)
    yield from _of_events(model)


def _numbered(made: Iterable[Mutant]) -> Iterator[Mutant]:
    """Places that are alike told apart."""
    seen: dict[str, int] = {}
    for mutant in made:
        count = seen[str(mutant)] = seen.get(str(mutant), 0) + 1
        yield mutant if count == 1 else replace(mutant, place=f"{mutant.place} ({count})")


def cited(clause: Clause) -> frozenset[str]:
    """All ids of a citation."""
    return frozenset((*clause.ids, *clause.readings))


def what_is(row: Row) -> str:
    """What the row belongs to."""
    if row.on.phase == "shown":
        return OBSERVATION
    return STEP if row.step else TRANSITION


def _of_conditions(rows: Mapping[int, Row]) -> Iterator[Mutant]:
    """Each condition dropped, and negated, in every row that has it at its place.

    The refusing row of a dropped step goes with it.
    """
    done: set[tuple[int, tuple[Conjunct, ...]]] = set()
    for row in rows.values():
        for at in range(len(row.guard)):
            key = (at, row.guard[:at])
            if key not in done:
                done.add(key)
                yield from _of_step(rows, row.guard[:at], at)


def _of_step(rows: Mapping[int, Row], passed: tuple[Conjunct, ...], at: int) -> Iterator[Mutant]:
    here = {n: row for n, row in rows.items() if row.guard[:at] == passed and len(row.guard) > at}
    last = {n for n, row in here.items() if row.step and len(row.guard) == at + 1}
    refusing = {n for n in last if here[n].answer == MINUS and len(here) > 1}
    first = next(iter(here.values()))
    what, clauses = what_is(first), cited(first.guard[at].clause)
    place = f"{first.name}: {first.guard[at].rule or f'condition {at + 1}'}"
    without = {n: None if n in refusing else _guarded(row, at, None) for n, row in here.items()}
    yield Mutant(what, DROPPED, place, without, clauses)
    negated = {n: _guarded(row, at, ex.negation(row.guard[at].condition)) for n, row in here.items()}
    yield Mutant(what, NEGATED, place, negated, clauses)


def _guarded(row: Row, at: int, condition: Expr | None) -> Row:
    new = () if condition is None else (replace(row.guard[at], condition=condition),)
    return replace(row, guard=(*row.guard[:at], *new, *row.guard[at + 1 :]))


def _of_effects(rows: Mapping[int, Row]) -> Iterator[Mutant]:
    """Each update lost, and each made to another value, in every row that has it."""
    for assign in dict.fromkeys(a for row in rows.values() for a in row.assigns):
        here = {n: row for n, row in rows.items() if assign in row.assigns}
        what, place = _place(here, assign)
        yield Mutant(what, LOST, place, {n: _with(row, assign, None) for n, row in here.items()})
        other = replace(assign, value=_other(assign.value))
        yield Mutant(what, CHANGED, place, {n: _with(row, assign, other) for n, row in here.items()})


def _place(here: Mapping[int, Row], assign: Assign) -> tuple[str, str]:
    first = next(iter(here.values()))
    return what_is(first), f"{first.name}: {assign.variable}"


def _of_entries(rows: Mapping[int, Row]) -> Iterator[Mutant]:
    """In values that depend on a condition: the condition negated, each alternative another, or as it was."""
    for assign in dict.fromkeys(a for row in rows.values() for a in row.assigns):
        here = {n: row for n, row in rows.items() if assign in row.assigns}
        what, place = _place(here, assign)
        kept = ex.Cell(assign.variable, assign.args, assign.value.sort)
        for kind, entry, value in _entries(assign.value, kept):
            other = replace(assign, value=value)
            changed = {n: _with(row, assign, other) for n, row in here.items()}
            yield Mutant(what, kind, f"{place}, {entry}", changed)


def _entries(value: Expr, kept: Expr) -> Iterator[tuple[str, str, Expr]]:
    """Of a value that depends on conditions: what is changed, where, and the value then."""
    if not isinstance(value, ex.Ite):
        return
    of, yes, no = value.condition, value.then, value.otherwise
    yield NEGATED, shown(of), ex.choice(ex.negation(of), yes, no)
    for kind, entry, made in _alternative(yes, shown(of), kept):
        yield kind, entry, ex.choice(of, made, no)
    for kind, entry, made in _alternative(no, "otherwise", kept):
        yield kind, entry, ex.choice(of, yes, made)


def _alternative(value: Expr, entry: str, kept: Expr) -> Iterator[tuple[str, str, Expr]]:
    if isinstance(value, ex.Ite):
        yield from _entries(value, kept)
        return
    yield CHANGED, entry, _other(value)
    if value != kept:
        yield LOST, entry, kept


def _with(row: Row, assign: Assign, other: Assign | None) -> Row:
    new = (other if a == assign else a for a in row.assigns)
    return replace(row, assigns=tuple(a for a in new if a is not None))


def _other(value: Expr) -> Expr:
    """Another value of the same sort."""
    sort = value.sort
    if sort == BOOL:
        return ex.negation(value)
    if isinstance(value, ex.Ite):
        return ex.choice(value.condition, value.otherwise, value.then)
    if isinstance(sort, EnumSort):
        members = sort.members
        at = members.index(value.value) if isinstance(value, ex.Const) else 0
        return ex.Const(members[(at + 1) % len(members)], sort)
    return ex.Plus(value, ex.Const(1, sort), 1)


def _of_events(model: ModelData) -> Iterator[Mutant]:
    """What makes an event occur: each side negated, and each left out."""
    for number, event in enumerate(model.occurrences):
        changes = {
            f"{event.name}: before": (NEGATED, replace(event, before=ex.negation(event.before))),
            f"{event.name}: after": (NEGATED, replace(event, after=ex.negation(event.after))),
            f"{event.name}: before ": (DROPPED, replace(event, before=ex.TRUE)),
            f"{event.name}: after ": (DROPPED, replace(event, after=ex.TRUE)),
            event.name: (CHANGED, replace(event, before=event.after, after=event.before)),
            f"{event.name} ": (LOST, replace(event, before=ex.FALSE)),
        }
        for place, (kind, changed) in changes.items():
            yield Mutant(EVENT, kind, place.strip(), {}, cited(event.clause), {number: changed})
