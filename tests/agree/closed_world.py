"""The steps from a state, found by a solver: models of guard and effect over a closed world of elements.

The translation is the one that proofs use, over uninterpreted sorts; only here are the sorts closed.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import z3

from mmsverify.concrete import Scope
from mmsverify.concrete.scope import CellKey, Value
from mmsverify.model import ModelData, Row
from mmsverify.model.expr import Cell, Const, Expr, Present, Ref
from mmsverify.model.rows import after
from mmsverify.model.sorts import BoolSort, ElementSort, IntSort, Sort
from mmsverify.model.terms import SetOf
from mmsverify.symbolic.translate import Translator


class ClosedWorld:
    """A translator whose sorts have exactly the elements of a scope, and a state that is known."""

    def __init__(self, model: ModelData, scope: Scope, state: dict[CellKey, Value]) -> None:
        self.model, self.scope, self.z3 = model, scope, Translator(model)
        self.solver = z3.Solver()
        for sort in model.sorts.values():
            self.solver.add(*self._closed(sort))
        for key, value in state.items():
            self.solver.add(self.z3.term(self.cell(key)) == self.value(model.signatures[key[0]].of, value))

    def _closed(self, sort: ElementSort) -> Iterator[z3.BoolRef]:
        names = [self.value(sort, name) for name in self.scope.names(sort)]
        some = z3.Const("some", self.z3.sort(sort))
        yield z3.Distinct(*names)
        yield z3.ForAll([some], z3.Or(*(some == name for name in names)))

    def value(self, sort: Sort, value: Value) -> Any:
        """The term for a value: for an element, a constant of its name."""
        return self.z3.term(self.expr(sort, value))

    def expr(self, sort: Sort, value: Value) -> Expr:
        """The expression for a value."""
        if isinstance(sort, ElementSort):
            return Ref(f"the {value}", sort)
        assert not isinstance(value, str)
        return Const(value, sort)

    def cell(self, key: CellKey) -> Cell:
        """The expression for a cell."""
        signature = self.model.signatures[key[0]]
        args = tuple(self.expr(sort, name) for sort, name in zip(signature.sorts, key[1], strict=True))
        return Cell(key[0], args, signature.of)

    def steps(self, row: Row) -> Iterator[tuple[Row, dict[str, Any], dict[CellKey, Value]]]:
        """All steps of one row from the state."""
        self.solver.push()
        self.solver.add(self.z3.formula(row.guard_formula))
        for parameter in row.parameters:
            self.solver.add(*self._in_scope(parameter))
        terms = {key: self._named(key, after(self.cell(key), row.assigns)) for key in self.cells()}
        while self.solver.check() == z3.sat:
            found = self.solver.model()
            bindings = {parameter.name: self._binding(found, row, parameter) for parameter in row.parameters}
            yield (
                row,
                bindings,
                {key: self._read(found, self.model.signatures[key[0]].of, terms[key]) for key in terms},
            )
            self.solver.add(
                z3.Not(z3.And(*(part for p in row.parameters for part in self._given(row, p, bindings))))
            )
        self.solver.pop()

    def _named(self, key: CellKey, expr: Expr) -> Any:
        """A constant that equals the expression: the solver then says its value, quantifiers and all."""
        term = self.z3.term(expr)
        constant = z3.Const(f"next {key}", term.sort())
        self.solver.add(constant == term)
        return constant

    def cells(self) -> Iterator[CellKey]:
        """All cells."""
        for signature in self.model.signatures.values():
            yield from self.scope.cells(signature)

    def _in_scope(self, parameter: Ref | SetOf) -> Iterator[z3.BoolRef]:
        if isinstance(parameter, Ref) and not isinstance(parameter.of, BoolSort):
            values = self.scope.values(parameter.of)
            yield z3.Or(*(self.z3.term(parameter) == self.value(parameter.of, value) for value in values))

    def _binding(self, found: z3.ModelRef, row: Row, parameter: Ref | SetOf) -> Any:
        if isinstance(parameter, SetOf):
            members = self.z3.parameter(parameter)
            names = self.scope.names(parameter.of)
            return frozenset(
                n for n in names if z3.is_true(self._eval(found, members(self.value(parameter.of, n))))
            )
        if parameter.name in row.on.optional and not z3.is_true(self._eval(found, self._presence(parameter))):
            return None
        return self._read(found, parameter.of, self.z3.term(parameter))

    def _given(self, row: Row, parameter: Ref | SetOf, bindings: dict[str, Any]) -> Iterator[z3.BoolRef]:
        """The binding as a formula, so that another one is looked for."""
        held = bindings[parameter.name]
        if isinstance(parameter, SetOf):
            members = self.z3.parameter(parameter)
            for name in self.scope.names(parameter.of):
                yield members(self.value(parameter.of, name)) == z3.BoolVal(name in held)
            return
        if parameter.name in row.on.optional:
            yield self._presence(parameter) == z3.BoolVal(held is not None)
        if held is not None:
            yield self.z3.term(parameter) == self.value(parameter.of, held)
        else:
            yield z3.BoolVal(True)

    def _presence(self, parameter: Ref) -> Any:
        return self.z3.term(Present(parameter.name))

    def _eval(self, found: z3.ModelRef, term: Any) -> Any:
        return found.eval(term, model_completion=True)

    def _read(self, found: z3.ModelRef, sort: Sort, term: Any) -> Value:
        if isinstance(sort, IntSort):
            return int(self._eval(found, term).as_long())
        return next(
            v for v in self.scope.values(sort) if z3.is_true(self._eval(found, term == self.value(sort, v)))
        )


def solver_steps(
    model: ModelData, scope: Scope, state: dict[CellKey, Value]
) -> Iterator[tuple[Row, Any, Any]]:
    """Every step of every row from a state, as the solver finds them."""
    world = ClosedWorld(model, scope, state)
    for row in model.actions:
        yield from world.steps(row)
