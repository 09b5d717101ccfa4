"""The exact belief about a closed world: every state that some run reaches which shows these events.

It is what beliefs are measured by: explicit sets of states, all rows tried in all orders by the judge,
nothing joined, nothing left out. Internal rows fire any number of times; a request may be performed at any
instant before its answer.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from itertools import product
from typing import Any

from mmsverify.concrete import Scope
from mmsverify.concrete.evaluate import Moment, Valuation, enabled, step, within_bounds
from mmsverify.model import ModelData
from mmsverify.model.rows import Row

Decisions = frozenset[tuple[str, str]]
Frozen = tuple[tuple[Any, ...], Decisions]


@dataclass
class ExactBelief:
    """The states, each with the answers that are decided and not yet shown; ``asked`` are open requests.

    ``most``: above as many states it gives up, and says so.
    """

    model: ModelData
    scope: Scope
    most: int = 1500
    asked: dict[str, tuple[str, Mapping[str, Any]]] = field(default_factory=dict)
    states: set[Frozen] = field(default_factory=set)
    gave_up: bool = False

    def __post_init__(self) -> None:
        self.keys = [key for s in self.model.signatures.values() for key in self.scope.cells(s)]

    def begin(self, states: Iterable[Valuation]) -> None:
        """These states may hold at the beginning."""
        self.states = {(self._frozen(state), frozenset()) for state in states}

    def _frozen(self, state: Valuation) -> tuple[Any, ...]:
        return tuple(state[key] for key in self.keys)

    def valuation(self, frozen: Frozen) -> dict[Any, Any]:
        """A state as a mapping."""
        return dict(zip(self.keys, frozen[0], strict=True))

    def _rows(self, phase: str, service: str | None = None) -> list[Row]:
        return [r for r in self.model.rows if r.on.phase == phase and service in (None, r.on.service)]

    def _taken(self, row: Row, state: Valuation, given: Mapping[str, Any]) -> Iterator[dict[Any, Any]]:
        choices = [
            (given[p.name],) if p.name in given else self.scope.parameter_values(row, p)
            for p in row.parameters
        ]
        for values in product(*choices):
            bindings = dict(zip((p.name for p in row.parameters), values, strict=True))
            after = step(row, bindings, state, self.scope)
            if after is not None and within_bounds(self.model, self.scope, after):
                yield after

    def closed(self) -> set[Frozen]:
        """The states that may hold when the next event comes, whatever happened unseen."""
        internal = self._rows("internal")
        todo = list(self.states)
        seen = set(todo)
        while todo and len(seen) <= self.most:
            values, decisions = todo.pop()
            state = self.valuation((values, decisions))
            found = {
                (self._frozen(after), decisions) for row in internal for after in self._taken(row, state, {})
            }
            for slot, (service, said) in self.asked.items():
                if slot not in dict(decisions):
                    for row in self._rows("response", service):
                        decided = decisions | {(slot, row.answer)}
                        found |= {(self._frozen(after), decided) for after in self._taken(row, state, said)}
            todo += found - seen
            seen |= found
        self.gave_up = self.gave_up or bool(todo)
        return seen

    def indicate(self, slot: str, service: str, said: Mapping[str, Any]) -> None:
        """A request arrives."""
        self.states = self.closed()
        self.asked[slot] = (service, said)

    def respond(self, slot: str, answer: str) -> bool:
        """The answer comes; whether some state is left."""
        decided = [(v, d) for v, d in self.closed() if (slot, answer) in d]
        self.states = {(values, d - {(slot, answer)}) for values, d in decided}
        del self.asked[slot]
        return bool(self.states)

    def show(self, service: str, shown: Mapping[str, Any]) -> bool:
        """Something is shown; whether some state is left."""
        rows = self._rows("shown", service)
        self.states = {
            frozen
            for frozen in self.closed()
            if all(enabled(row, Moment(self.scope, self.valuation(frozen), shown)) for row in rows)
        }
        return bool(self.states)
