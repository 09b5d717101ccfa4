"""Views: what one variable or definition of a model does, as a small diagram of its values.

A view keeps which rows lead from one value to another, with their clauses, and forgets the rest of the state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from mmsverify.concrete.compile import Predicate
from mmsverify.concrete.layout import State
from mmsverify.concrete.machine import Machine
from mmsverify.errors import UsageError
from mmsverify.graph.explore import Walk
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row
from mmsverify.model.sorts import BOOL, EnumSort, Sort


@dataclass(frozen=True, slots=True)
class Arrow:
    """A change from one value to another: the names of the rows that make it, the clauses they cite."""

    source: str
    target: str
    rows: tuple[str, ...]
    clauses: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class View:
    """The values that were reached, in the order of their sort, those at the start, the changes between them.

    ``complete`` is false where only a part of the states was explored: other changes may exist.
    """

    title: str
    values: tuple[str, ...]
    initial: tuple[str, ...]
    arrows: tuple[Arrow, ...]
    complete: bool


def view_names(model: ModelData) -> Mapping[str, str]:
    """What to draw: the ``views`` option of the model (title to name), else its first enumerated variable."""
    declared: Mapping[str, str] | None = model.options.get("views")
    if declared:
        for name in declared.values():
            _check_name(model, name)
        return declared
    enumerated = _first(model, lambda sort: isinstance(sort, EnumSort))
    found = enumerated or _first(model, lambda sort: sort == BOOL)
    if found is None:
        cure = "declare views={'title': 'variable'} on its class"
        raise UsageError(f"the model {model.name} has nothing to draw", cure=cure)
    return {found.replace("_", " "): found}


def _first(model: ModelData, wanted: Callable[[Sort], bool]) -> str | None:
    return next((name for name, arity, sort in _candidates(model) if arity <= 1 and wanted(sort)), None)


def _candidates(model: ModelData) -> Iterator[tuple[str, int, Sort]]:
    for signature in model.signatures.values():
        if not signature.rigid:
            yield signature.name, len(signature.sorts), signature.of
    for name, (parameters, body) in model.definitions.items():
        yield name, len(parameters), body.sort


def views(machine: Machine, names: Mapping[str, str], *, max_states: int | None = None) -> list[View]:
    """The views of the variables and definitions ``names`` (by title), all from one exploration.

    Of one with arguments the view shows what each of its cells does. Where ``max_states`` do not suffice,
    the states that differ most in what the views show are explored first.
    """
    for name in names.values():
        _check_name(machine.model, name)
    shown = [_Projection(machine, title, name) for title, name in names.items()]
    seen: dict[State, tuple[tuple[int, ...], ...]] = {}

    def kind(state: State) -> tuple[tuple[int, ...], ...]:
        if state not in seen:
            seen[state] = tuple(projection.codes(state) for projection in shown)
        return seen[state]

    walk = Walk(machine, machine.moves(()), kind=kind, max_states=max_states)
    for source, number, target in walk.steps():
        before, after = kind(source), kind(target)
        if before != after:
            for projection, old, new in zip(shown, before, after, strict=True):
                projection.step(old, new, machine.instances[number].row)
    starts = [kind(state) for state in machine.start.states]
    return [p.view([codes[i] for codes in starts], walk.complete) for i, p in enumerate(shown)]


def _check_name(model: ModelData, name: str) -> None:
    if name not in model.definitions and name not in model.signatures:
        cure = "name a variable or a definition: " + ", ".join(model.signatures)
        raise UsageError(f"the model {model.name} has no {name}", cure=cure)


class _Projection:
    """One view in the making: the changes seen so far."""

    def __init__(self, machine: Machine, title: str, name: str) -> None:
        self.title = title
        self.words = [str(value) for value in machine.scope.values(machine.sort_of(name))]
        self.reads: list[Predicate] = [read for _, read in machine.readings(name)]
        self.changes: dict[tuple[int, int], dict[str, Row]] = {}

    def codes(self, state: State) -> tuple[int, ...]:
        """The values of all cells in a state."""
        return tuple(int(read(state)) for read in self.reads)  # type: ignore[call-overload]

    def step(self, before: Sequence[int], after: Sequence[int], row: Row) -> None:
        """Take note of a step of ``row``."""
        for pair in zip(before, after, strict=True):
            if pair[0] != pair[1]:
                self.changes.setdefault(pair, {}).setdefault(row.id, row)

    def view(self, starts: Sequence[Sequence[int]], complete: bool) -> View:
        """The finished view."""
        initial = {code for codes in starts for code in codes}
        reached = initial.union(*self.changes)
        return View(
            self.title,
            tuple(self.words[code] for code in sorted(reached)),
            tuple(self.words[code] for code in sorted(initial)),
            tuple(self._arrow(*pair) for pair in sorted(self.changes)),
            complete,
        )

    def _arrow(self, source: int, target: int) -> Arrow:
        rows = sorted(self.changes[source, target].values(), key=lambda row: row.id)
        names = tuple(dict.fromkeys(row.name for row in rows))
        clauses = tuple(dict.fromkeys(i for row in rows for i in row.clause.ids + row.clause.readings))
        return Arrow(self.words[source], self.words[target], names, clauses)
