"""A run of one variant, taken by the rows of another: where the two go different ways, and by which step.

What mends a fault is told by this and not by the list of repairs: a procedure may be repaired for many
reasons, and only some of its steps keep the run from ending in the breach.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass

from mmsverify.concrete import Path, Scope, Taken
from mmsverify.concrete.evaluate import Moment, holds, step, value
from mmsverify.concrete.scope import CellKey, Value, cell_name
from mmsverify.concrete.trace_path import readable
from mmsverify.model.declare import Assign
from mmsverify.model.model import ModelData
from mmsverify.model.rows import MINUS, Clause, Conjunct, Row
from mmsverify.model.sorts import IntSort

State = dict[CellKey, Value]


@dataclass(frozen=True, slots=True)
class Parting:
    """A step of the run that the other variant does not take, or takes elsewhere.

    ``declared`` is the declaration that is responsible there, ``step`` the step of it, ``clause`` what that
    rests on; empty where the declaration differs as a whole. ``says`` tells what is different.
    """

    declared: str
    step: str
    clause: Clause
    says: str


def partings(model: ModelData, scope: Scope, path: Path, watched: Collection[str]) -> Iterator[Parting]:
    """Where ``path``, a run of another variant, goes another way by the rows of ``model``.

    The state is compared where ``watched`` variables are concerned. It ends with the first step that is not
    taken: what comes after would speak of another run.
    """
    return _Follower(model, scope, watched).follow(path)


@dataclass(frozen=True, slots=True)
class _Way:
    """One row with its parameters, tried in a state; ``after`` is ``None`` where its guard refuses."""

    row: Row
    before: Moment
    after: State | None

    def maker(self, key: CellKey) -> Assign | None:
        """The update that gives the cell its value."""
        made = [a for a in self.row.assigns if a.variable == key[0] and self._touches(a, key)]
        return made[-1] if made else None

    def _touches(self, assign: Assign, key: CellKey) -> bool:
        return any(
            tuple(str(value(arg, each)) for arg in assign.args) == key[1] and holds(assign.where, each)
            for each in self.before.knowing(assign.bound)
        )


class _Follower:
    def __init__(self, model: ModelData, scope: Scope, watched: Collection[str]) -> None:
        self.model, self.scope, self.watched = model, scope, watched

    def follow(self, path: Path) -> Iterator[Parting]:
        state = self._own(path[0].state)
        impossible = self._impossible(state)
        if impossible is not None:
            yield Parting(impossible.rule, "", Clause(()), "no robot is like this one when it is powered")
            return
        apart = self._apart(state, path[0].state)
        for taken in path[1:]:
            way = self._way(taken, state)
            if isinstance(way, Parting):
                yield way
                return
            assert way.after is not None
            now = self._apart(way.after, taken.state)
            yield from (self._effect(way, way.after, key) for key in now if key not in apart)
            state, apart = way.after, now

    def _own(self, other: Mapping[CellKey, Value]) -> State:
        """The initial state, with the first value for each cell that the run's variant does not have."""
        cells = (key for signature in self.model.signatures.values() for key in self.scope.cells(signature))
        return {key: other.get(key, self._first(key)) for key in cells}

    def _first(self, key: CellKey) -> Value:
        sort = self.model.signatures[key[0]].of
        return 0 if isinstance(sort, IntSort) else self.scope.values(sort)[0]

    def _impossible(self, state: State) -> Conjunct | None:
        at = Moment(self.scope, state, {})
        given = (*self.model.assumptions, *self.model.initial)
        return next((conjunct for conjunct in given if not holds(conjunct.condition, at)), None)

    def _way(self, taken: Taken, state: State) -> _Way | Parting:
        """The row that is taken here, with the run's answer; else why the step is not taken."""
        assert taken.row is not None
        tried = [self._try(r, taken, state) for r in self.model.actions if r.name == taken.row.name]
        ways = [way for way in tried if way.after is not None]
        same = [way for way in ways if way.row.answer == taken.row.answer]
        if same:
            return same[0]
        if ways:
            return _answer(ways[0])
        name = taken.row.name
        if not tried:
            return Parting(name, "", Clause(()), "is not there")
        refusing = next(c for c in tried[0].row.guard if not holds(c.condition, tried[0].before))
        return Parting(name, "", refusing.clause, "does not happen then")

    def _try(self, row: Row, taken: Taken, state: State) -> _Way:
        """The row with the run's parameters; one that the run lacks has its first value (absent, false)."""
        given = {
            p.name: taken.bindings.get(p.name, self.scope.parameter_values(row, p)[0]) for p in row.parameters
        }
        return _Way(row, Moment(self.scope, state, given), step(row, given, state, self.scope))

    def _apart(self, state: State, other: Mapping[CellKey, Value]) -> list[CellKey]:
        """The watched cells of the run that have another value here."""
        return [
            key for key, held in other.items() if key[0] in self.watched and self._here(key, state) != held
        ]

    def _here(self, key: CellKey, state: State) -> Value | None:
        if key in state or key[0] not in self.model.definitions:
            return state.get(key)
        parameters, body = self.model.definitions[key[0]]
        given = dict(zip((p.name for p in parameters), key[1], strict=True))
        return value(body, Moment(self.scope, state, given))

    def _effect(self, way: _Way, after: State, key: CellKey) -> Parting:
        held = self._here(key, after)
        says = f"leads to {cell_name(key)} = {str(held).lower() if isinstance(held, bool) else held}"
        if key not in after:
            return Parting(key[0], "", Clause(()), says)
        made = way.maker(key)
        if made is None:
            return Parting(way.row.name, "", Clause(()), says)
        return Parting(way.row.name, made.clauses[0], Clause(made.clauses, made.readings), says)


def _answer(way: _Way) -> Parting:
    row = way.row
    if row.answer != MINUS:
        return Parting(row.name, "", Clause(()), f"ends with {row.answer}")
    known = {name: readable(held) for name, held in way.before.bindings.items()}
    told = row.guard[-1].says.format_map(known)
    return Parting(row.name, row.step, row.clause, f"refuses: {told}" if told else "refuses")
