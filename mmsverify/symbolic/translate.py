"""From expressions to Z3 terms over uninterpreted sorts: what is proved holds for any number of elements.

The translation is one to one. The state after a step is never named: a formula over it is first rewritten
over the state before (``mmsverify.model.rows.after``), so unrolling is substitution. Optional parameters
become a constant and a presence Boolean; set-valued ones a fresh unary relation.
"""

from __future__ import annotations

import itertools
from collections.abc import Callable
from typing import Any

import z3

from mmsverify.model.expr import (
    And,
    Cell,
    Const,
    Eq,
    Expr,
    Ite,
    Less,
    Member,
    Not,
    Or,
    Plus,
    Present,
    Quantified,
    Ref,
)  # fmt: skip
from mmsverify.model.model import ModelData
from mmsverify.model.rows import Claim, Row, Signature, after, step_formula
from mmsverify.model.sorts import BoolSort, ElementSort, Enumeration, EnumSort, IntSort, Sort
from mmsverify.model.terms import SetOf

_SERIAL = itertools.count()


class Translator:
    """Z3 sorts and functions for one model, and the translation of its expressions.

    ``state`` distinguishes copies of the state (for unrolling): the functions of copy ``k`` are named
    ``variable@k``.
    """

    def __init__(self, model: ModelData) -> None:
        self.model = model
        self._serial = next(_SERIAL)
        self._sorts: dict[Sort, z3.SortRef] = {}
        self._literals: dict[Enumeration, z3.ExprRef] = {}
        self._functions: dict[tuple[str, str], z3.FuncDeclRef] = {}
        self._memo: dict[tuple[Expr, str], z3.ExprRef] = {}

    def sort(self, sort: Sort) -> z3.SortRef:
        """The Z3 sort: uninterpreted for elements, a datatype without fields for enumerations."""
        match sort:
            case BoolSort():
                return z3.BoolSort()
            case IntSort():
                return z3.IntSort()
        if sort not in self._sorts:
            self._sorts[sort] = self._new_sort(sort)
        return self._sorts[sort]

    def _new_sort(self, sort: Sort) -> z3.SortRef:
        if isinstance(sort, ElementSort):
            return z3.DeclareSort(sort.name)
        assert isinstance(sort, EnumSort)
        # Z3 keeps enumeration names for the life of its context, hence the serial number.
        made, members = z3.EnumSort(
            f"{sort.name}!{self._serial}", [f"{sort.name}.{m.name}!{self._serial}" for m in sort.members]
        )
        self._literals.update(zip(sort.members, members, strict=True))
        return made

    def function(self, name: str, state: str = "") -> z3.FuncDeclRef:
        """The function that holds the variable ``name`` in a copy of the state."""
        key = (name, "" if self.model.signatures[name].rigid else state)
        if key not in self._functions:
            signature = self.model.signatures[name]
            shape = [self.sort(s) for s in (*signature.sorts, signature.of)]
            self._functions[key] = z3.Function(f"{name}@{key[1]}" if key[1] else name, *shape)
        return self._functions[key]

    def parameter(self, parameter: Ref | SetOf, suffix: str = "") -> z3.AstRef:
        """The constant (or, for a set, the unary relation) that stands for a parameter."""
        if isinstance(parameter, SetOf):
            return z3.Function(parameter.name + suffix, self.sort(parameter.of), z3.BoolSort())
        return z3.Const(parameter.name + suffix, self.sort(parameter.of))

    def formula(self, expr: Expr, state: str = "", suffix: str = "") -> z3.BoolRef:
        """A Boolean expression; parameters get ``suffix``, variables belong to the copy ``state``."""
        made = self.term(expr, state, suffix)
        assert isinstance(made, z3.BoolRef)
        return made

    def term(self, expr: Expr, state: str = "", suffix: str = "") -> z3.ExprRef:
        """The Z3 term of an expression; memoized, for rows share their guards."""
        key = (expr, f"{state}|{suffix}")
        if key not in self._memo:
            self._memo[key] = self._translate(expr, state, suffix)
        return self._memo[key]

    def _translate(self, expr: Expr, state: str, suffix: str) -> Any:
        def sub(part: Expr) -> Any:
            return self.term(part, state, suffix)

        match expr:
            case Const(value):
                return self._literal(value, expr.sort)
            case Ref():
                return self.parameter(expr, suffix)
            case Cell(variable, args):
                return self.function(variable, state)(*map(sub, args))
            case Member(name, element):
                return z3.Function(name + suffix, self.sort(element.sort), z3.BoolSort())(sub(element))
            case Present(name):
                return z3.Bool(f"{name}{suffix}!present")
            case Quantified(universal, bound, body):
                names = [self.parameter(ref, suffix) for ref in bound]
                return (z3.ForAll if universal else z3.Exists)(names, sub(body))
        return _connected(expr, sub)

    def _literal(self, value: bool | int | Enumeration, sort: Sort) -> z3.ExprRef:
        if isinstance(value, bool):
            return z3.BoolVal(value)
        if isinstance(value, int):
            return z3.IntVal(value)
        self.sort(sort)
        return self._literals[value]

    def bounds(self, state: str = "") -> list[z3.BoolRef]:
        """What the declared bounds of integer variables say."""
        return [
            b
            for s in self.model.signatures.values()
            if isinstance(s.of, IntSort)
            for b in self._bound(s, s.of, state)
        ]

    def _bound(self, signature: Signature, sort: IntSort, state: str) -> list[z3.BoolRef]:
        names = [z3.Const(f"b{i}", self.sort(s)) for i, s in enumerate(signature.sorts)]
        value = self.function(signature.name, state)(*names)
        limits = ([] if sort.low is None else [value >= sort.low]) + (
            [] if sort.high is None else [value <= sort.high]
        )
        return [z3.ForAll(names, limit) if names else limit for limit in limits]


def _connected(expr: Expr, sub: Callable[[Expr], Any]) -> Any:
    """A node whose meaning is that of its parts: connectives, comparisons, sums, choices."""
    match expr:
        case Not(body):
            return z3.Not(sub(body))
        case And(parts):
            return z3.And(*map(sub, parts))
        case Or(parts):
            return z3.Or(*map(sub, parts))
        case Eq(left, right):
            return sub(left) == sub(right)
        case Less(left, right):
            return sub(left) < sub(right)
        case Plus(left, right, factor):
            return sub(left) + factor * sub(right)
        case Ite(condition, then, otherwise):
            return z3.If(sub(condition), sub(then), sub(otherwise))
    raise TypeError(f"no translation for {expr!r}")


def obligation(claim: Claim, row: Row) -> Expr:
    """What must follow from the invariant and the row's guard for the claim to survive the row."""
    return step_formula(claim.formula, row) if claim.kind == "step" else after(claim.formula, row.assigns)
