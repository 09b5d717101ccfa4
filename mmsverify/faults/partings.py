"""A run of one variant, taken by the rows of another: where the two go different ways, and by which step.

What mends a fault is told by this and not by the list of repairs: a procedure may be repaired for many
reasons, and only some of its steps keep the run from ending in the breach.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from mmsverify.concrete import Path, Scope, Taken
from mmsverify.concrete.evaluate import Moment, holds, step, value
from mmsverify.concrete.scope import CellKey, Value, cell_name
from mmsverify.concrete.trace_path import readable
from mmsverify.model.declare import Assign
from mmsverify.model.model import ModelData
from mmsverify.model.rows import MINUS, Clause, Row
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
    """Where ``path``, a run of another variant, goes another way by the rows of ``model``, from power-on.

    The state is compared where ``watched`` variables are concerned. It ends with the first step that is not
    taken: what comes after would speak of another run.
    """
    return _Follower(model, scope, watched).follow(path)


def last_parting(model: ModelData, scope: Scope, path: Path, watched: Collection[str]) -> list[Parting]:
    """How the last step of ``path`` that can go another way does so, from the state that the run has reached.

    Several are listed where several steps refuse, or where the effects differ in several ways. Where every
    step is the same, the beginning is not.
    """
    follower = _Follower(model, scope, watched)
    for number in range(len(path) - 1, 0, -1):
        found = follower.one(path[number - 1], path[number])
        if found:
            return found
    return list(follower.beginning(path[0]))


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
        for parting in self.beginning(path[0]):
            yield parting
            return
        apart = self._apart(state, path[0].state)
        for taken in path[1:]:
            after, found = self._step(taken, state, apart)
            yield from found
            if after is None:
                return
            state, apart = after, self._apart(after, taken.state)

    def one(self, before: Taken, taken: Taken) -> list[Parting]:
        """How one step goes another way from the state of the run before it."""
        state = self._own(before.state)
        return self._step(taken, state, self._apart(state, before.state))[1]

    def beginning(self, first: Taken) -> Iterator[Parting]:
        """What forbids the initial state."""
        at = Moment(self.scope, self._own(first.state), {})
        for conjunct in (*self.model.assumptions, *self.model.initial):
            if not holds(conjunct.condition, at):
                yield Parting(conjunct.rule, "", Clause(()), "no robot is like this one when it is powered")

    def _step(
        self, taken: Taken, state: State, apart: Collection[CellKey]
    ) -> tuple[State | None, list[Parting]]:
        """The state after a step, ``None`` where it is not taken, and what differs that did not before."""
        assert taken.row is not None
        tried = [self._try(r, taken, state) for r in self.model.actions if r.name == taken.row.name]
        same = next((w for w in tried if w.after is not None and w.row.answer == taken.row.answer), None)
        if same is None or same.after is None:
            return None, list(_not_taken(taken.row.name, tried))
        now = self._apart(same.after, taken.state)
        return same.after, [self._effect(same, same.after, key) for key in now if key not in apart]

    def _own(self, other: Mapping[CellKey, Value]) -> State:
        """The state of the run, with the values for what it lacks under which all that both have is alike."""
        cells = [key for signature in self.model.signatures.values() for key in self.scope.cells(signature)]
        lacking = [key for key in cells if key not in other]
        state = {key: other.get(key, self._values(key)[0]) for key in cells}
        for key in lacking:
            state = min(
                ({**state, key: held} for held in self._values(key)),
                key=lambda each: sum(self._here(shared, each) != held for shared, held in other.items()),
            )
        return state

    def _values(self, key: CellKey) -> tuple[Value, ...]:
        sort = self.model.signatures[key[0]].of
        return (0,) if isinstance(sort, IntSort) else self.scope.values(sort)

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


def _not_taken(name: str, tried: Sequence[_Way]) -> Iterator[Parting]:
    """Why none is taken with the answer of the run: all refusals that stand, else what happens instead."""
    ways = [way for way in tried if way.after is not None]
    refusing = [w for w in tried if w.row.answer == MINUS and holds(w.row.guard[-1].condition, w.before)]
    if any(way.row.answer == MINUS for way in ways):
        yield from map(_refusal, refusing)
    elif ways:
        yield Parting(name, "", Clause(()), f"ends with {ways[0].row.answer}")
    elif tried:
        closed = next(c for c in tried[0].row.guard if not holds(c.condition, tried[0].before))
        yield Parting(name, "", closed.clause, "does not happen then")
    else:
        yield Parting(name, "", Clause(()), "is not there")


def _refusal(way: _Way) -> Parting:
    known = {name: readable(held) for name, held in way.before.bindings.items()}
    told = way.row.guard[-1].says.format_map(known)
    return Parting(way.row.name, way.row.step, way.row.clause, f"refuses: {told}" if told else "refuses")
