"""The reachable states of a closed world, enumerated by Z3: a second opinion on what a search counts.

Nothing is shared with the search but the rows: initial states and steps are models of the formulas that
proofs use (``translate``), with the elements of the world put in for every quantifier. Each state that is
found is blocked, until no step leads to a new one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import product

import z3

from mmsverify.model.expr import Cell, Const, Expr, Present, Ref
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Row, after
from mmsverify.model.sorts import BoolSort, ElementSort, Enumeration, EnumSort, IntSort, Sort
from mmsverify.model.terms import SetOf
from mmsverify.symbolic.translate import Translator

Value = bool | int | str | Enumeration
Key = tuple[str, tuple[str, ...]]
"""A variable and the elements that it is taken at."""
State = tuple[Value, ...]
"""The values of all cells, in the order of :attr:`Enumerator.keys`."""


@dataclass(frozen=True, slots=True)
class ClosedWorld:
    """The elements of each sort by its short name, what is given about cells, bounds of every integer.

    ``tried`` names, for an enumeration, the members that parameters take; all where it does not say.
    """

    elements: Mapping[str, Sequence[str]]
    facts: Mapping[Key, Value] = field(default_factory=dict)
    int_bounds: tuple[int, int] = (0, 1)
    tried: Mapping[str, Sequence[Enumeration]] = field(default_factory=dict)

    def values(self, sort: Sort) -> Sequence[Value]:
        """All values of a sort."""
        match sort:
            case ElementSort():
                return self.elements[sort.short]
            case EnumSort():
                return sort.members
            case IntSort():
                low, high = self.int_bounds
                first = low if sort.low is None else sort.low
                return range(first, (high if sort.high is None else sort.high) + 1)
        return (False, True)


class Enumerator:
    """The states of one model in one closed world."""

    def __init__(self, model: ModelData, world: ClosedWorld) -> None:
        self.model, self.world, self.translator = model, world, Translator(model)
        self.keys: tuple[Key, ...] = tuple(
            (name, tuple(map(str, at)))
            for name, signature in model.signatures.items()
            for at in product(*(world.values(sort) for sort in signature.sorts))
        )
        self._sorts = [model.signatures[name].of for name, _ in self.keys]
        self._now = [self.translator.term(self._cell(key)) for key in self.keys]
        self._next = [
            z3.Const(f"next {key}", now.sort()) for key, now in zip(self.keys, self._now, strict=True)
        ]

    def reachable(self) -> set[State]:
        """All of them."""
        found = set(self._initial())
        steps = self._steps()
        for state in found:
            steps.add(self._other(self._next, state))
        waiting = list(found)
        while waiting:
            new = self._after(steps, waiting.pop())
            steps.add(*(self._other(self._next, state) for state in new))
            found.update(new)
            waiting += new
        return found

    def successors(self, states: Iterable[State]) -> Iterator[tuple[State, set[State]]]:
        """Each of these states with the states after a step from it, itself perhaps among them."""
        steps = self._steps()
        for state in states:
            yield state, set(self._after(steps, state))

    def _initial(self) -> Iterator[State]:
        given = [c.condition for c in (*self.model.initial, *self.model.assumptions)]
        solver = self._solver(*map(self._formula, given), *self._in_range(self._now))
        for key, value in self.world.facts.items():
            solver.add(
                self.translator.term(self._cell(key)) == self._term(self.model.signatures[key[0]].of, value)
            )
        while solver.check() == z3.sat:
            state = self._read(solver.model(), self._now)
            solver.add(self._other(self._now, state))
            yield state

    def _after(self, steps: z3.Solver, state: State) -> list[State]:
        """The states after a step from this one, without those that are blocked."""
        new: list[State] = []
        steps.push()
        steps.add(*self._equal(self._now, state))
        while steps.check() == z3.sat:
            new.append(self._read(steps.model(), self._next))
            steps.add(self._other(self._next, new[-1]))
        steps.pop()
        return new

    # Formulas.

    def _solver(self, *formulas: z3.BoolRef) -> z3.Solver:
        """A solver that knows that the elements are apart."""
        solver = z3.Solver()
        for sort in self.model.sorts.values():
            names = [self._term(sort, name) for name in self.world.values(sort)]
            solver.add(z3.Distinct(*names) if names else z3.BoolVal(True))
        solver.add(*formulas)
        return solver

    def _steps(self) -> z3.Solver:
        """A solver whose models are the steps of the model's rows."""
        return self._solver(z3.Or(*(self._step(row) for row in self.model.actions)))

    def _step(self, row: Row) -> z3.BoolRef:
        """The row is taken from the state now to the next one."""
        kept = dict(zip(self.keys, self._now, strict=True))
        later = [
            self._grounded(self.translator.term(after(self._cell(key), row.assigns)))
            if key[0] in row.writes
            else kept[key]
            for key in self.keys
        ]
        parameters = [part for parameter in row.parameters for part in self._given(row, parameter)]
        moves = [new == term for new, term in zip(self._next, later, strict=True)]
        return z3.And(self._formula(row.guard_formula), *parameters, *moves, *self._in_range(self._next))

    def _given(self, row: Row, parameter: Ref | SetOf) -> Iterator[z3.BoolRef]:
        """A parameter is a value of the world, or, where it is optional, perhaps absent."""
        if isinstance(parameter, SetOf) or isinstance(parameter.of, BoolSort):
            return
        term = self.translator.term(parameter)
        values = self.world.tried.get(parameter.of.name, self.world.values(parameter.of))
        among = z3.Or(*(term == self._term(parameter.of, value) for value in values))
        absent = z3.Not(self.translator.formula(Present(parameter.name)))
        yield z3.Or(absent, among) if parameter.name in row.on.optional else among

    def _in_range(self, cells: Sequence[z3.ExprRef]) -> Iterator[z3.BoolRef]:
        for cell, sort in zip(cells, self._sorts, strict=True):
            if not isinstance(sort, BoolSort | EnumSort):
                yield z3.Or(*(cell == self._term(sort, value) for value in self.world.values(sort)))

    def _formula(self, expr: Expr) -> z3.BoolRef:
        return self._grounded(self.translator.formula(expr))

    def _grounded(self, term: z3.ExprRef) -> z3.ExprRef:
        """The term with every quantifier spelled out for the elements of the world."""
        pairs = [(found, self._spelled_out(found)) for found in _quantifiers(term)]
        return z3.substitute(term, *pairs) if pairs else term

    def _spelled_out(self, found: z3.QuantifierRef) -> z3.BoolRef:
        sorts = {str(self.translator.sort(sort)): sort for sort in self.model.sorts.values()}
        bound = [sorts[str(found.var_sort(i))] for i in range(found.num_vars())]
        instances = [
            self._grounded(
                z3.substitute_vars(
                    found.body(), *(self._term(s, v) for s, v in reversed(list(zip(bound, at, strict=True))))
                )
            )
            for at in product(*(self.world.values(sort) for sort in bound))
        ]
        return z3.And(*instances) if found.is_forall() else z3.Or(*instances)

    # Values.

    def _cell(self, key: Key) -> Cell:
        signature = self.model.signatures[key[0]]
        args = tuple(_constant(sort, name) for sort, name in zip(signature.sorts, key[1], strict=True))
        return Cell(key[0], args, signature.of)

    def _term(self, sort: Sort, value: Value) -> z3.ExprRef:
        return self.translator.term(_constant(sort, self._meant(sort, value)))

    def _meant(self, sort: Sort, value: Value) -> Value:
        """A member of an enumeration may be given by the word that it prints."""
        if isinstance(sort, EnumSort) and isinstance(value, str):
            return next(member for member in sort.members if value in (member.name, member.value))
        return value

    def _equal(self, cells: Sequence[z3.ExprRef], state: State) -> list[z3.BoolRef]:
        return [
            cell == self._term(sort, value)
            for cell, sort, value in zip(cells, self._sorts, state, strict=True)
        ]

    def _other(self, cells: Sequence[z3.ExprRef], state: State) -> z3.BoolRef:
        return z3.Not(z3.And(*self._equal(cells, state)))

    def _read(self, found: z3.ModelRef, cells: Sequence[z3.ExprRef]) -> State:
        return tuple(
            next(
                v
                for v in self.world.values(sort)
                if z3.is_true(found.eval(cell == self._term(sort, v), model_completion=True))
            )
            for cell, sort in zip(cells, self._sorts, strict=True)
        )


def _constant(sort: Sort, value: Value) -> Expr:
    """The expression for a value; an element is a constant of its name."""
    if isinstance(sort, ElementSort):
        return Ref(f"the {value}", sort)
    assert not isinstance(value, str)
    return Const(value, sort)


def _quantifiers(term: z3.ExprRef) -> list[z3.QuantifierRef]:
    """The outermost quantified parts of a term."""
    found: dict[int, z3.QuantifierRef] = {}
    seen: set[int] = set()
    waiting = [term]
    while waiting:
        part = waiting.pop()
        if z3.is_quantifier(part):
            found[part.get_id()] = part
        elif part.get_id() not in seen:
            seen.add(part.get_id())
            waiting += part.children()
    return list(found.values())
