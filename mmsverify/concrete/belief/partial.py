"""Partial states: what is known of the cells of one possible state; of a cell that is not listed, nothing.

Names that the recording has not shown yet share the cells of ``OTHER``: what holds there holds of each of
them. When a name is first seen, it takes over what is known of ``OTHER``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

from mmsverify.concrete.belief.values import EITHER, Known, everything, join, meet, within
from mmsverify.model.model import ModelData
from mmsverify.model.sorts import ElementSort, Sort

OTHER = "*"

Key = tuple[str, tuple[str, ...]]
Cells = Mapping[Key, Known]


UNSEEN = "$unseen"
DECIDED = "$decided"
MARKS = frozenset({UNSEEN, DECIDED})
"""Keys of what a state holds beside cells: facts about unseen names, answers decided but not shown."""


@dataclass(frozen=True, slots=True)
class Fact:
    """A formula that holds of every name not seen yet, but says nothing certain about any one of its cells.

    It is assumed of a name when the name is seen. ``holds`` and ``wanted`` tell whether it is true of a
    state; ``bound`` are the quantified names with their sorts, ``cells`` what it reads.
    """

    assume: Callable[[Partial, Mapping[str, Any], bool], list[Partial]]
    holds: Callable[[Partial, Mapping[str, Any]], int]
    wanted: int
    env: Mapping[str, Any]
    bound: tuple[tuple[str, str], ...]
    cells: frozenset[tuple[str, tuple[str | None, ...]]]


class World:
    """What the partial states of one belief share: the model's variables, the names seen so far by sort."""

    def __init__(self, model: ModelData) -> None:
        self.model = model
        self.full: dict[str, Known] = {s.name: everything(s.of) for s in model.signatures.values()}
        self.full |= {UNSEEN: EITHER, DECIDED: frozenset()}
        self.names: dict[str, list[str]] = {sort.name: [OTHER] for sort in model.sorts.values()}
        self.facts: list[Fact] = []
        self.survives: dict[Any, bool] = {}
        self._numbers: dict[Any, int] = {}

    def known(self, sort: ElementSort, name: str) -> bool:
        """Whether the name has been seen as an element of the sort."""
        return name in self.names[sort.name]

    def fact(self, identity: Any, make: Callable[[], Fact]) -> Key:
        """The key under which a state holds the fact of that identity."""
        if identity not in self._numbers:
            self._numbers[identity] = len(self.facts)
            self.facts.append(make())
        return UNSEEN, (str(self._numbers[identity]),)

    def combinations(self, sorts: Iterable[Sort]) -> Iterator[tuple[str, ...]]:
        """All tuples of names of these sorts, ``OTHER`` included."""
        return product(*(self.names[sort.name] for sort in sorts))


class Partial:
    """One partial state. Never changed once it is made; equal cells make equal states."""

    __slots__ = ("_decisions", "_hash", "cells", "world")

    def __init__(self, world: World, cells: Cells) -> None:
        self.world = world
        self.cells = cells
        self._hash: int | None = None
        self._decisions: frozenset[tuple[Key, Known]] | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Partial) and self.cells == other.cells

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash(frozenset(self.cells.items()))
        return self._hash

    def get(self, key: Key) -> Known:
        """What is known of a cell."""
        found = self.cells.get(key)
        return self.world.full[key[0]] if found is None else found

    def put(self, key: Key, value: Known) -> Partial:
        """The same state with the cell set to ``value``."""
        return Partial(self.world, {**self.cells, key: value})

    def narrowed(self, key: Key, value: Known) -> Partial | None:
        """The same state with the cell restricted to ``value``; ``None`` if nothing is left."""
        before = self.get(key)
        now = meet(before, value)
        if now is None:
            return None
        return self if now == before else self.put(key, now)

    def without(self, drop: Iterable[Key]) -> Partial:
        """The same state with these cells no longer known."""
        gone = set(drop)
        return Partial(self.world, {k: v for k, v in self.cells.items() if k not in gone})

    def forget(self, variables: frozenset[str]) -> Partial:
        """The same state with nothing known of these variables."""
        return Partial(
            self.world,
            {k: v for k, v in self.cells.items() if k[0] not in variables and not self._reads(k, variables)},
        )

    def _reads(self, key: Key, variables: frozenset[str]) -> bool:
        return key[0] == UNSEEN and any(
            variable in variables for variable, _ in self.world.facts[int(key[1][0])].cells
        )

    def facts(self) -> list[Key]:
        """The keys of the facts about names not seen yet."""
        return [key for key in self.cells if key[0] == UNSEEN]

    def meets(self, name: str, sort: ElementSort) -> list[Partial]:
        """The states once ``name`` has been seen: it takes over what holds of every unseen name."""
        states = [self._renamed(name, sort)]
        for key in self.facts():
            fact = self.world.facts[int(key[1][0])]
            places = [bound for bound, kind in fact.bound if kind == sort.name and fact.env[bound] == OTHER]
            for chosen in product((False, True), repeat=len(places)):
                if any(chosen):
                    env = {**fact.env, **{b: name for b, take in zip(places, chosen, strict=True) if take}}
                    states = [after for before in states for after in fact.assume(before, env, True)]
        return states

    def _renamed(self, name: str, sort: ElementSort) -> Partial:
        more = dict(self.cells)
        for (variable, args), value in self.cells.items():
            places = _places(self.world.model, variable, args, sort)
            for chosen in product((False, True), repeat=len(places)):
                if any(chosen):
                    more[variable, _renamed(args, places, chosen, name)] = value
        return Partial(self.world, more)

    def covers(self, other: Partial) -> bool:
        """Whether every state that ``other`` allows, this one allows; decided answers must be the same."""
        if self.decisions() != other.decisions():
            return False
        for key, value in self.cells.items():
            if key[0] == UNSEEN:
                if key not in other.cells:
                    return False
            elif not within(other.get(key), value):
                return False
        return True

    def decisions(self) -> frozenset[tuple[Key, Known]]:
        """The answers that are decided and not yet shown."""
        if self._decisions is None:
            self._decisions = frozenset((k, v) for k, v in self.cells.items() if k[0] == DECIDED)
        return self._decisions

    def joined(self, other: Partial) -> Partial:
        """A state that allows what either allows."""
        cells = {k: join(v, other.cells[k]) for k, v in self.cells.items() if k in other.cells}
        return Partial(self.world, {k: v for k, v in cells.items() if v != self.world.full.get(k[0])})


def _places(model: ModelData, variable: str, args: tuple[str, ...], sort: ElementSort) -> list[int]:
    signature = model.signatures.get(variable)
    if signature is None:
        return []
    return [i for i, arg in enumerate(args) if arg == OTHER and signature.sorts[i].name == sort.name]


def _renamed(
    args: tuple[str, ...], places: list[int], chosen: tuple[bool, ...], name: str
) -> tuple[str, ...]:
    renamed = list(args)
    for place, take in zip(places, chosen, strict=True):
        if take:
            renamed[place] = name
    return tuple(renamed)


def distinct(states: Iterable[Partial]) -> list[Partial]:
    """The states without those that another one covers, in order; two that differ in one cell become one."""
    kept: list[Partial] = []
    for state in _merged(list(dict.fromkeys(states))):
        if not any(other.covers(state) for other in kept):
            kept = [other for other in kept if not state.covers(other)]
            kept.append(state)
    return kept


def _merged(states: list[Partial]) -> list[Partial]:
    """The same states, fewer: where one cell is all that tells two apart, it is joined; nothing is lost."""
    merging = True
    while merging and len(states) > 1:
        merging = False
        apart = _differing(states)
        for key in apart:
            if key[0] in MARKS:
                continue
            groups: dict[tuple[Known | None, ...], Partial] = {}
            for state in states:
                rest = tuple(state.cells.get(other) for other in apart if other != key)
                groups[rest] = _joined_at(key, groups[rest], state) if rest in groups else state
            merging = merging or len(groups) < len(states)
            states = list(groups.values())
    return states


def _differing(states: Sequence[Partial]) -> list[Key]:
    """The cells in which the states are not all alike, in a fixed order."""
    first = states[0].cells
    apart = {
        key
        for state in states[1:]
        for key in {*first, *state.cells}
        if first.get(key) != state.cells.get(key)
    }
    return sorted(apart)


def _joined_at(key: Key, left: Partial, right: Partial) -> Partial:
    return left.put(key, join(left.get(key), right.get(key)))


def widened(states: list[Partial], most: int) -> list[Partial]:
    """Neighbours joined until at most ``most`` are left: more is allowed than before, never less."""
    while len(states) > most:
        states = distinct(
            a if b is a else a.joined(b)
            for a, b in zip(states[::2], [*states[1::2], states[-1]], strict=False)
        )
    return states


def written(before: Sequence[Partial], after: Sequence[Partial]) -> frozenset[Key]:
    """The cells in which the first states of two beliefs differ."""
    old = before[0].cells if before else {}
    new = after[0].cells if after else {}
    return frozenset(k for k in {*old, *new} if old.get(k) != new.get(k) and not k[0].startswith("$"))
