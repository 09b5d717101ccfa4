"""Like elements are exchangeable: one representative for states that differ only in which is which.

The language has no names of single elements, so only facts tell elements apart: elements that facts treat
alike may be exchanged. A representative has them sorted by what the state says of each; ties are broken by
the least packed state, where there are few. A representative is always an exchange of its state, hence
verdicts are the same; that two like states get the same representative is not promised where ties are many,
and costs only time.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from itertools import groupby, permutations, product
from math import factorial, prod
from operator import itemgetter
from typing import Any

from mmsverify.concrete.layout import Layout, State
from mmsverify.concrete.scope import CellKey, known_facts
from mmsverify.model.sorts import ElementSort

_MOST_TIES = 720
_MOST_KEPT = 2_000_000

Order = tuple[int, ...]


class Symmetry:
    """The exchanges of like elements for one layout."""

    def __init__(self, layout: Layout) -> None:
        self.groups = (
            [_Group(layout, sort, names) for sort, names in _alike(layout)] if len(layout.keys) > 1 else []
        )
        self._kept: dict[State, State] = {}

    def canonical(self, state: State) -> State:
        """The representative of a state."""
        found = self._kept.get(state)
        if found is None:
            found = state
            for group in self.groups:
                found = group.sorted(found)
            if len(self._kept) > _MOST_KEPT:
                self._kept.clear()
            self._kept[state] = found
        return found


def _alike(layout: Layout) -> Iterator[tuple[ElementSort, tuple[str, ...]]]:
    """The groups of two or more elements of one sort that facts do not tell apart."""
    facts: dict[CellKey, Any] = {
        **known_facts(layout.model, layout.scope),
        **{k: ("code", v) for k, v in layout.fixed.items()},
    }
    for sort in layout.model.sorts.values():
        groups: list[list[str]] = []
        for name in layout.scope.names(sort):
            group = next((g for g in groups if _exchangeable(layout, facts, sort, g[0], name)), None)
            if group is None:
                groups.append([name])
            else:
                group.append(name)
        yield from ((sort, tuple(group)) for group in groups if len(group) > 1)


def _exchangeable(
    layout: Layout, facts: Mapping[CellKey, Any], sort: ElementSort, left: str, right: str
) -> bool:
    swap = {left: right, right: left}
    for (variable, args), value in facts.items():
        signature = layout.model.signatures[variable]
        other = tuple(swap.get(a, a) if s == sort else a for a, s in zip(args, signature.sorts, strict=True))
        held = swap.get(value, value) if signature.of == sort and isinstance(value, str) else value
        if facts.get((variable, other)) != held:
            return False
    return True


class _Group:
    """One group of like elements: how to sort them in a state."""

    def __init__(self, layout: Layout, sort: ElementSort, names: tuple[str, ...]) -> None:
        self.layout, self.sort, self.names = layout, sort, names
        self._profile = [self._readers(name) for name in names]
        self._orders: dict[Order, Callable[[State], State]] = {}

    def _readers(self, name: str) -> list[Callable[[State], Any]]:
        """Functions of a state that together say what it holds of one element, whatever others are called."""
        places: dict[tuple[str, tuple[bool, ...]], list[int]] = {}
        for i, (variable, args) in enumerate(self.layout.keys):
            sorts = self.layout.model.signatures[variable].sorts
            mine = tuple(a == name and s == self.sort for a, s in zip(args, sorts, strict=True))
            if any(mine):
                places.setdefault((variable, mine), []).append(i)
        return [  # in one order for every element, so that their profiles can be compared
            itemgetter(*found) if len(found) == 1 else _multiset(found) for _, found in sorted(places.items())
        ]

    def sorted(self, state: State) -> State:
        """The state with the group's elements in order."""
        profiles = [tuple(read(state) for read in readers) for readers in self._profile]
        slots = sorted(range(len(self.names)), key=profiles.__getitem__)
        ties = [tuple(tied) for _, tied in groupby(slots, key=profiles.__getitem__)]
        if prod(factorial(len(tied)) for tied in ties) > _MOST_TIES:
            return self._arranged(state, tuple(slots))
        orders = product(*(permutations(tied) for tied in ties))
        return min(self._arranged(state, sum(order, ())) for order in orders)

    def _arranged(self, state: State, order: Order) -> State:
        if order not in self._orders:
            self._orders[order] = self._arrangement(order)
        return self._orders[order](state)

    def _arrangement(self, order: Order) -> Callable[[State], State]:
        """The exchange that puts element ``order[k]`` in the place of element ``k``."""
        old = {self.names[k]: self.names[source] for k, source in enumerate(order)}
        sources = [self.layout.position[self._moved(key, old)] for key in self.layout.keys]
        read, pack = itemgetter(*sources), self.layout.pack
        new = {i: self._renamed(old) for i, sort in enumerate(self.layout.sorts) if sort == self.sort}
        if not new:
            return lambda state: pack(read(state))
        return lambda state: pack(new[i][code] if i in new else code for i, code in enumerate(read(state)))

    def _moved(self, key: CellKey, old: Mapping[str, str]) -> CellKey:
        sorts = self.layout.model.signatures[key[0]].sorts
        return key[0], tuple(
            old.get(a, a) if s == self.sort else a for a, s in zip(key[1], sorts, strict=True)
        )

    def _renamed(self, old: Mapping[str, str]) -> list[int]:
        """For cells that hold an element: the code that takes the place of each code."""
        names = list(self.layout.scope.names(self.sort))
        back = {source: name for name, source in old.items()}
        return [names.index(back.get(name, name)) for name in names]


def _multiset(positions: list[int]) -> Callable[[State], Any]:
    read = itemgetter(*positions)
    return lambda state: tuple(sorted(read(state)))
