"""Paths: a run of a model from an initial state, as rows with parameters and states in the model's words.

Only the making and the printing of paths; judging one is ``judge``'s.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from mmsverify.concrete.evaluate import Moment, Valuation, value
from mmsverify.concrete.layout import State
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import Binding, Scope, Value, cell_name
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row
from mmsverify.model.sorts import BOOL, Enumeration
from mmsverify.results import PathStep


@dataclass(frozen=True, slots=True)
class Taken:
    """One step: the row, its parameters by name, the state after it. The first of a path has no row."""

    row: Row | None
    bindings: Mapping[str, Binding]
    state: Valuation


Path = tuple[Taken, ...]


class Retrace:
    """Turns a trail of packed states into a path by taking the steps again."""

    def __init__(self, machine: Machine, canonical: Callable[[State], State]) -> None:
        self.machine = machine
        self.canonical = canonical

    def path(self, trail: Sequence[State], settled: Claim | None) -> Path:
        """The path along representatives ``trail``; then, for a claim about steps, a step that settles it."""
        state = next(s for s in self.machine.start.states if self.canonical(s) == trail[0])
        path = [Taken(None, {}, self.machine.layout.read(state))]
        for wanted in trail[1:]:
            number, state = self._step(state, partial(self._leads_to, wanted))
            path.append(self._taken(number, state))
        if settled is not None:
            number, after = self._step(state, self._settles(settled, state))
            path.append(self._taken(number, after))
        return tuple(path)

    def _step(self, state: State, wanted: Callable[[int, State], bool]) -> tuple[int, State]:
        return next(
            (n, after)
            for n, after in self.machine.successors(state)
            if after is not None and wanted(n, after)
        )

    def _leads_to(self, wanted: State, _number: int, after: State) -> bool:
        return self.canonical(after) == wanted

    def _settles(self, claim: Claim, state: State) -> Callable[[int, State], bool]:
        check, compiled = self.machine.check, self.machine.step_predicate
        return lambda number, after: bool(compiled(check(claim, number))(state, after))

    def _taken(self, number: int, state: State) -> Taken:
        instance = self.machine.instances[number]
        return Taken(instance.row, self.machine.grounding.bindings(instance), self.machine.layout.read(state))


def path_steps(model: ModelData, scope: Scope, path: Path) -> tuple[PathStep, ...]:
    """The path as results print it; rigid cells stand in the first step only."""
    return tuple(_path_step(model, scope, taken) for taken in path)


def _path_step(model: ModelData, scope: Scope, taken: Taken) -> PathStep:
    shown = readable_state(model, scope, taken.state, rigid=taken.row is None)
    if taken.row is None:
        ids = dict.fromkeys(i for c in model.initial for i in (*c.clause.ids, *c.clause.readings))
        return PathStep("initially", {}, tuple(ids), shown)
    row = taken.row
    process = f"{row.on.service}: " if "." in row.on.service else ""
    action = f"{process}{row.name} {row.answer}".strip()
    given = {name: readable(held) for name, held in taken.bindings.items() if held is not None}
    return PathStep(action, given, row.clause.ids + row.clause.readings, shown)


def readable_state(model: ModelData, scope: Scope, state: Valuation, rigid: bool = False) -> dict[str, Any]:
    """Every cell, and every definition that is no mere truth value, by printed name, in the model's words."""
    cells = {
        cell_name(key): readable(held)
        for key, held in state.items()
        if rigid or not model.signatures[key[0]].rigid
    }
    return cells | {name: readable(held) for name, held in defined(model, scope, state).items()}


def defined(model: ModelData, scope: Scope, state: Valuation) -> dict[str, Value | None]:
    """The value of every definition that speaks of the whole state; the others only repeat what cells say."""
    whole = {n: body for n, (given, body) in model.definitions.items() if not given and body.sort is not BOOL}
    return {name: value(body, Moment(scope, state, {})) for name, body in whole.items()}


def readable(held: Binding) -> Any:
    """A value as JSON can hold it: words, numbers, truth values, sorted lists."""
    if isinstance(held, frozenset):
        return sorted(held)
    return str(held) if isinstance(held, Enumeration) else held
