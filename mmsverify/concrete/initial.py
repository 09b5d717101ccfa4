"""The states that a model may start in: by unit propagation, then by trying what is left open."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from mmsverify.concrete.formulas import FALSE, TRUE, Formulas, Node
from mmsverify.concrete.ground import Grounding
from mmsverify.concrete.layout import Layout, State
from mmsverify.concrete.names import conjuncts
from mmsverify.concrete.scope import CellKey, Scope, known_facts
from mmsverify.model.model import ModelData

Domains = dict[int, tuple[int, ...]]
"""The codes that each position may still have."""


@dataclass(frozen=True, slots=True)
class Start:
    """Initial states in a fixed order; ``complete`` tells whether these are all."""

    states: tuple[State, ...]
    complete: bool


def settled_rigid_cells(model: ModelData, scope: Scope) -> dict[CellKey, int]:
    """The rigid cells whose value facts and assumptions settle, with their codes."""
    layout = Layout(model, scope)
    found = next(_Narrowing(Grounding(layout, Formulas())).narrowed(), {})
    return {
        key: found[i][0]
        for i, key in enumerate(layout.keys)
        if model.signatures[key[0]].rigid and len(found.get(i, ())) == 1
    }


def initial_states(grounding: Grounding, limit: int = 100_000) -> Start:
    """All initial states, or the first ``limit`` of them."""
    layout = grounding.layout
    states: list[State] = []
    for codes in _Narrowing(grounding).solutions():
        if len(states) == limit:
            return Start(tuple(states), False)
        states.append(layout.pack(codes))
    return Start(tuple(states), True)


class _Narrowing:
    """The conditions on an initial state, and the search for the states that meet them."""

    def __init__(self, grounding: Grounding) -> None:
        self.formulas = grounding.formulas
        self.layout = layout = grounding.layout
        model = layout.model
        given = (*model.initial, *model.assumptions)
        self.conditions = [grounding.formula(part, {}) for c in given for part in conjuncts(c.condition)]
        self.domains: Domains = {
            i: tuple(range(low, high + 1)) for i, (low, high) in enumerate(layout.ranges)
        }
        for key, value in known_facts(model, layout.scope).items():
            if key in layout.position:
                position = layout.position[key]
                self.domains[position] = (layout.code(layout.sorts[position], value),)

    def narrowed(self) -> Iterator[Domains]:
        """The domains after unit propagation; nothing if the conditions contradict each other."""
        found = self._propagate(self.domains, self.conditions)
        if found is not None:
            yield found[0]

    def solutions(self) -> Iterator[tuple[int, ...]]:
        """The codes of every state that meets the conditions."""
        found = self._propagate(self.domains, self.conditions)
        if found is not None:
            yield from self._solve(*found)

    def _solve(self, domains: Domains, conditions: list[int]) -> Iterator[tuple[int, ...]]:
        position = next((i for i, domain in domains.items() if len(domain) > 1), None)
        if position is None:
            yield tuple(domain[0] for domain in domains.values())
            return
        for code in domains[position]:
            found = self._propagate({**domains, position: (code,)}, conditions)
            if found is not None:
                yield from self._solve(*found)

    def _propagate(self, domains: Domains, conditions: list[int]) -> tuple[Domains, list[int]] | None:
        """Domains and conditions with every unit condition used up; ``None`` if one becomes false."""
        domains = dict(domains)
        while True:
            memo: dict[int, int] = {}
            left = [p for c in conditions for p in self.formulas.parts(self._known(c, domains, memo))]
            if FALSE in left:
                return None
            units = [c for c in left if self._unit(c) is not None]
            conditions = [c for c in left if self._unit(c) is None]
            if not units:
                return domains, conditions
            if not all(self._narrow(domains, unit) for unit in units):
                return None

    def _known(self, formula: int, domains: Domains, memo: dict[int, int]) -> int:
        def atom(node: Node) -> int | None:
            if node.op not in ("cell", "is"):
                return None
            domain = domains[node.cell]
            if node.op == "cell":
                return self.formulas.const(domain[0]) if len(domain) == 1 else None
            if node.code not in domain:
                return FALSE
            return TRUE if len(domain) == 1 else None

        return self.formulas.rebuilt(formula, atom, memo)

    def _unit(self, formula: int) -> tuple[Node, bool] | None:
        """The atom of a literal about one cell, and whether it must hold."""
        node = self.formulas.nodes[formula]
        holds = node.op != "not"
        atom = node if holds else self.formulas.nodes[node.parts[0]]
        return (atom, holds) if atom.op in ("cell", "is") else None

    def _narrow(self, domains: Domains, unit: int) -> bool:
        found = self._unit(unit)
        assert found is not None
        atom, holds = found
        code = atom.code if atom.op == "is" else 1
        domains[atom.cell] = tuple(c for c in domains[atom.cell] if (c == code) is holds)
        return bool(domains[atom.cell])
