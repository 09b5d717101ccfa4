"""Operators over expressions: in a model file ``control[a] == CONTROLLING`` is a term, not a truth value.

A term checks sorts when it is built, so that an error has the line of the model file, and refuses to be used
as a Python truth value: ``if``, ``and``, ``or``, ``not`` and chained comparisons would lose the formula
silently.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, NoReturn

from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Const, Expr, Member, Present, Ref
from mmsverify.model.place import mistake
from mmsverify.model.rewrite import bind, primed
from mmsverify.model.show import shown
from mmsverify.model.sorts import (
    BOOL,
    ElementSort,
    Enumeration,
    EnumSort,
    IntSort,
    Sort,
    enumeration,
    integer,
    same_kind,
)  # fmt: skip


class Term:
    """An expression with operators.

    ``==``, ``!=``, ``<``, ``+`` and their kin compare and count; ``&`` means and, ``|`` or, ``~`` not,
    ``>>`` implies.
    """

    __slots__ = ("expr",)
    __hash__: ClassVar[None]  # type: ignore[assignment]

    def __init__(self, expr: Expr) -> None:
        self.expr = expr

    @property
    def sort(self) -> Sort:
        """The sort of the value."""
        return self.expr.sort

    @property
    def next(self) -> Term:
        """The same expression over the state after the step; for two-state claims (``Step``)."""
        return Term(primed(self.expr))

    def __bool__(self) -> NoReturn:
        raise mistake(
            f"the condition '{shown(self.expr)}' is used as a truth value",
            "write & for and, | for or, ~ for not, >> for implies, if_(c, a, b) for if",
        )

    def __eq__(self, other: object) -> Term:  # type: ignore[override]
        return Term(ex.equal(*_pair(self, other)))

    def __ne__(self, other: object) -> Term:  # type: ignore[override]
        return Term(ex.negation(ex.equal(*_pair(self, other))))

    def __lt__(self, other: Any) -> Term:
        return Term(ex.less(*_numbers(self, other)))

    def __gt__(self, other: Any) -> Term:
        left, right = _numbers(self, other)
        return Term(ex.less(right, left))

    def __le__(self, other: Any) -> Term:
        return ~self.__gt__(other)

    def __ge__(self, other: Any) -> Term:
        return ~self.__lt__(other)

    def __add__(self, other: Any) -> Term:
        return Term(ex.plus(*_numbers(self, other)))

    def __sub__(self, other: Any) -> Term:
        return Term(ex.plus(*_numbers(self, other), -1))

    def __and__(self, other: Any) -> Term:
        return Term(ex.conjunction(formula(self), formula(other)))

    def __or__(self, other: Any) -> Term:
        return Term(ex.disjunction(formula(self), formula(other)))

    def __invert__(self) -> Term:
        return Term(ex.negation(formula(self)))

    def __rshift__(self, other: Any) -> Term:
        return Term(ex.disjunction(ex.negation(formula(self)), formula(other)))

    def __iter__(self) -> NoReturn:
        raise mistake(f"'{shown(self.expr)}' cannot be listed", "quantify: for_all(x)(... x ...)")

    def isin(self, values: Iterable[Any]) -> Term:
        """Whether the value is one of ``values``."""
        return Term(ex.disjunction(*(formula(self == value) for value in values)))

    def __repr__(self) -> str:
        return f"<{shown(self.expr)}>"


class Element(Term):
    """A name: a parameter or a bound variable that ranges over an ``Each``."""

    __slots__ = ()

    @property
    def ref(self) -> Ref:
        """The underlying reference."""
        assert isinstance(self.expr, Ref)
        return self.expr


class Maybe(Element):
    """An optional parameter; its value means something only where it is ``present``."""

    __slots__ = ()

    @property
    def present(self) -> Term:
        """Whether the parameter is given."""
        return Term(Present(self.ref.name))


@dataclass(frozen=True, slots=True, eq=False)
class SetOf:
    """A set-valued parameter: a fresh unary relation over an ``Each``."""

    name: str
    of: ElementSort

    def __contains__(self, _element: object) -> NoReturn:
        raise mistake(f"'in {self.name}' gives a truth value", f"write {self.name}.has(x)")

    def has(self, element: Element) -> Term:
        """Whether ``element`` belongs to the set."""
        if element.sort != self.of:
            raise mistake(f"{self.name} holds {self.of}, not {element.sort}", "give an element of that sort")
        return Term(Member(self.name, element.expr))


@dataclass(frozen=True, slots=True)
class Quantifier:
    """``for_all(x, y)`` or ``for_some(x)`` waiting for its body; ``where`` restricts it."""

    universal: bool
    bound: tuple[Ref, ...]
    condition: Expr = ex.TRUE

    def __call__(self, body: Any) -> Term:
        inner = formula(body)
        if self.universal:
            return Term(bind(True, self.bound, ex.disjunction(ex.negation(self.condition), inner)))
        return Term(bind(False, self.bound, ex.conjunction(self.condition, inner)))

    def where(self, condition: Any) -> Quantifier:
        """Only the elements for which ``condition`` holds."""
        return Quantifier(self.universal, self.bound, ex.conjunction(self.condition, formula(condition)))


def for_all(*elements: Element) -> Quantifier:
    """For all names: ``for_all(a, c)(controls[a, c] >> (control[c] == CONTROLLED))``."""
    return Quantifier(True, _bound(elements))


def for_some(*elements: Element) -> Quantifier:
    """For at least one name."""
    return Quantifier(False, _bound(elements))


def _bound(elements: tuple[Element, ...]) -> tuple[Ref, ...]:
    if not elements or not all(isinstance(e, Element) for e in elements):
        raise mistake("a quantifier takes elements", "declare them: a, c = PI.elements('a c')")
    return tuple(e.ref for e in elements)


def if_(condition: Any, then: Any, otherwise: Any) -> Term:
    """The value ``then`` where ``condition`` holds, else ``otherwise``."""
    sort = next((v.sort for v in (then, otherwise) if isinstance(v, Term)), None) or sort_of(then)
    return Term(ex.choice(formula(condition), value_of(then, sort), value_of(otherwise, sort)))


def sort_of(value: Any) -> Sort:
    """The sort of a literal."""
    if isinstance(value, bool):
        return BOOL
    if isinstance(value, Enumeration):
        return enumeration(type(value))
    if isinstance(value, int):
        return integer()
    raise mistake(
        f"{value!r} is not a value of the language",
        "give a term, a truth value, an integer or a member of an Enumeration",
    )


def all_of(*conditions: Any) -> Term:
    """The conjunction of the conditions."""
    return Term(ex.conjunction(*map(formula, conditions)))


def any_of(*conditions: Any) -> Term:
    """The disjunction of the conditions."""
    return Term(ex.disjunction(*map(formula, conditions)))


def answered(*answers: str) -> Term:
    """In a two-state claim: the step gives one of these answers."""
    return Term(ex.RowFact("answer", answers))


def service_is(*services: str) -> Term:
    """In a two-state claim: the step belongs to one of these services (or internal events)."""
    return Term(ex.RowFact("service", services))


def formula(value: Any) -> Expr:
    """``value`` as a Boolean expression."""
    if isinstance(value, bool):
        return Const(value)
    if isinstance(value, Term) and value.sort is BOOL:
        return value.expr
    what = f"of sort {value.sort}" if isinstance(value, Term) else f"{value!r}"
    raise mistake(f"a condition is expected, not a value {what}", "compare it: x == value")


def value_of(value: Any, sort: Sort) -> Expr:
    """``value`` (a term or a literal) as an expression of ``sort``."""
    if isinstance(value, Term):
        if not same_kind(value.sort, sort):
            raise mistake(
                f"{shown(value.expr)} is of sort {value.sort}, not {sort}", "compare like with like"
            )
        return value.expr
    const = ex.literal(value, sort)
    if const is None:
        raise mistake(f"{value!s} is not a value of sort {sort}", f"use {_examples(sort)}")
    return const


def _examples(sort: Sort) -> str:
    if isinstance(sort, EnumSort):
        return "one of " + ", ".join(m.name for m in sort.members)
    return {True: "True or False"}.get(sort is BOOL, f"a term of sort {sort}")


def _pair(left: Any, right: Any) -> tuple[Expr, Expr]:
    if not isinstance(left, Term):
        raise mistake(f"{left!r} cannot stand here", "one side must be a term of the model")
    return left.expr, value_of(right, left.sort)


def _numbers(left: Term, right: Any) -> tuple[Expr, Expr]:
    if not isinstance(left.sort, IntSort):
        raise mistake(f"{shown(left.expr)} is of sort {left.sort}, not an integer", "order only integers")
    return _pair(left, right)


def cell(variable: str, args: tuple[Any, ...], sorts: Sequence[Sort], of: Sort) -> Cell:
    """The cell of a variable at its arguments, with the sorts checked."""
    if len(args) != len(sorts):
        wanted = ", ".join(s.short if isinstance(s, ElementSort) else s.name for s in sorts)
        raise mistake(
            f"{variable} takes {len(sorts)} argument(s), not {len(args)}", f"write {variable}[{wanted}]"
        )
    return Cell(variable, tuple(value_of(arg, sort) for arg, sort in zip(args, sorts, strict=True)), of)
