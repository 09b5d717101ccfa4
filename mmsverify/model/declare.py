"""Declarations of a model: sorts of things, state variables, definitions, events.

Names come from the class body. Rows and claims are made of these; ``procedure`` and ``claims`` declare them.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from typing import Any

from mmsverify.model import expr as ex
from mmsverify.model import show
from mmsverify.model.expr import Cell, Expr, Ref
from mmsverify.model.place import caller, mistake
from mmsverify.model.rewrite import bind, primed, substitute
from mmsverify.model.sorts import BOOL, ElementSort, Enumeration, Sort, enumeration
from mmsverify.model.terms import Element, Maybe, SetOf, Term, cell, formula, value_of


class Declared:
    """Something that a class body gives a name to; the name is set once, by the body."""

    name: str = ""
    place: str = ""

    def bind(self, name: str) -> None:
        """Take the name under which the class body declares this."""
        if not self.name:
            self.name = name


class Each(Declared):
    """Names of things of one kind, any number of them: ``PI = Each("ProgramInvocation")``.

    Proofs hold for every number. An element is a name; whether it exists is for a variable to say.
    """

    def __init__(self, kind: str) -> None:
        self.kind = kind
        self.place = caller()

    @property
    def sort(self) -> ElementSort:
        """The sort of its elements."""
        return ElementSort(self.kind, short=self.name or self.kind)

    def elements(self, names: str) -> tuple[Element, ...]:
        """Several element variables, by their names separated by spaces."""
        return tuple(Element(Ref(name, self.sort)) for name in names.split())

    def element(self, name: str) -> Element:
        """One element variable or parameter."""
        return Element(Ref(name, self.sort))

    def maybe(self, name: str) -> Maybe:
        """An optional parameter."""
        return Maybe(Ref(name, self.sort))

    def some(self, name: str) -> SetOf:
        """A set-valued parameter."""
        return SetOf(name, self.sort)


def parameter(name: str, of: type[Enumeration] | Sort) -> Element:
    """A parameter of an event that is a value: a Boolean, an integer or a member of an enumeration."""
    return Element(Ref(name, of if isinstance(of, Sort) else enumeration(of)))


def optional(name: str, of: type[Enumeration] | Sort) -> Maybe:
    """An optional parameter that is a value, not a name."""
    return Maybe(Ref(name, of if isinstance(of, Sort) else enumeration(of)))


@dataclass(frozen=True, slots=True)
class Assign:
    """``variable[args] := value`` for all ``bound`` elements with ``where``; all read the state before.

    A list of these is applied in order: a later one wins where two touch one cell. ``clauses`` and
    ``readings`` are those of the step that makes it.
    """

    variable: str
    args: tuple[Expr, ...]
    value: Expr
    bound: tuple[Ref, ...] = ()
    where: Expr = ex.TRUE
    place: str = field(default="", compare=False)
    clauses: tuple[str, ...] = field(default=(), compare=False)
    readings: tuple[str, ...] = field(default=(), compare=False)

    def when(self, condition: Any) -> Assign:
        """The same update where ``condition`` holds; it may speak of the elements that ``over`` has bound."""
        marked = {ref.name.removesuffix("·"): ref for ref in self.bound}
        where = ex.conjunction(self.where, substitute(formula(condition), marked))
        return replace(self, where=where)

    def over(self, *elements: Element) -> Assign:
        """The same update for every value of ``elements``.

        Their names are marked, so that no parameter is taken for them.
        """
        marked = {e.ref.name: Ref(e.ref.name + "·", e.ref.of) for e in elements}
        return replace(
            self,
            args=tuple(substitute(arg, marked) for arg in self.args),
            value=substitute(self.value, marked),
            bound=self.bound + tuple(marked.values()),
            where=substitute(self.where, marked),
        )


class Place(Term):
    """A cell of a variable: a term that can also be updated with ``becomes``."""

    __slots__ = ()

    def becomes(self, value: Any) -> Assign:
        """The update of this cell; ``value`` reads the state before the step."""
        target = self.expr
        if not isinstance(target, Cell):
            raise mistake(
                f"'{show.shown(target)}' is a definition, not a variable",
                "update the variables that it is made of",
            )
        return Assign(target.variable, target.args, value_of(value, target.of), place=caller())

    @property
    def next(self) -> Place:
        """The cell after the step."""
        return Place(primed(self.expr))


class Variable(Declared):
    """A state variable: a function from elements to values of ``of``'s sort.

    ``Variable(Control, of=PI)`` is ``control[pi]``; without ``of`` it is one cell, written ``name[()]`` or
    ``name()``. ``rigid`` ones never change (what a profile fixes). ``initially`` gives the value at power-on
    as a function of the arguments, or a literal; ``None`` leaves it open (see ``Initially``). ``cites`` are
    the statements that the variable itself encodes: that there is such an attribute, with such values.
    """

    def __init__(
        self,
        sort: type[Enumeration] | Sort,
        of: Each | tuple[Each, ...] = (),
        *,
        rigid: bool = False,
        doc: str = "",
        cites: Iterable[str] = (),
    ) -> None:
        self.of = of if isinstance(of, tuple) else (of,)
        self.value_sort = sort if isinstance(sort, Sort) else enumeration(sort)
        self.rigid = rigid
        self.doc = doc
        self.cites = tuple(cites)
        self.place = caller()

    @property
    def sorts(self) -> tuple[ElementSort, ...]:
        """The sorts of its arguments."""
        return tuple(each.sort for each in self.of)

    def __getitem__(self, args: Any) -> Place:
        listed = args if isinstance(args, tuple) else (args,)
        return Place(cell(self.name, listed, self.sorts, self.value_sort))

    def __call__(self) -> Place:
        return self[()]

    def __bool__(self) -> bool:
        raise mistake(
            f"the variable {self.name} is used as a truth value", f"write {self.name}[...] with &, |, ~ or >>"
        )


def relation(*of: Each, rigid: bool = False, doc: str = "", cites: Iterable[str] = ()) -> Variable:
    """A relation between elements: a Boolean variable of its arguments."""
    return Variable(BOOL, of, rigid=rigid, doc=doc, cites=cites)


Relation = relation


def unchanged(*variables: Variable) -> Term:
    """In a two-state claim: every cell of these variables has the value that it had before the step."""
    return Term(ex.conjunction(*map(_kept, variables)))


def _kept(variable: Variable) -> Expr:
    refs = tuple(Ref(f"kept{i}", sort) for i, sort in enumerate(variable.sorts))
    before = Cell(variable.name, refs, variable.value_sort)
    return bind(True, refs, ex.equal(primed(before), before))


class Derived(Declared):
    """A definition: a name for an expression over the variables, never stored and never updated."""

    def __init__(
        self,
        definition: Any,
        *,
        over: Iterable[Element] = (),
        repairs: object = None,
        doc: str = "",
        cites: Iterable[str] = (),
    ) -> None:
        listed = tuple(over)
        self.parameters = tuple(e.ref for e in listed)
        self.sorts: tuple[Sort, ...] = tuple(e.sort for e in listed)
        self.definition: Expr = definition.expr
        self.repairs = repairs
        self.doc = doc
        self.cites = tuple(cites)
        self.place = caller()

    def __getitem__(self, args: Any) -> Place:
        listed = args if isinstance(args, tuple) else (args,)
        return Place(cell(self.name, listed, self.sorts, self.definition.sort))

    def __call__(self) -> Place:
        return self[()]


@dataclass(frozen=True, slots=True)
class On:
    """The event that a row answers to: its phase, the service it belongs to and its parameters in order.

    ``indication``: a request arrives; ``response``: the responder decides and acts; ``shown``: a message
    shows state and changes nothing; ``internal``: nothing that a message shows.
    """

    phase: str
    service: str
    parameters: tuple[Ref | SetOf, ...] = ()
    optional: frozenset[str] = frozenset()

    def __str__(self) -> str:
        return f"{self.service}.{self.phase}" if self.phase != "internal" else self.service


def _on(phase: str, service: str, parameters: tuple[Element | SetOf, ...]) -> On:
    listed = tuple(p if isinstance(p, SetOf) else p.ref for p in parameters)
    return On(phase, service, listed, frozenset(p.ref.name for p in parameters if isinstance(p, Maybe)))


def indication(service: str, *parameters: Element | SetOf) -> On:
    """The arrival of a request."""
    return _on("indication", service, parameters)


def response(service: str, *parameters: Element | SetOf) -> On:
    """The responder performs the service and answers."""
    return _on("response", service, parameters)


def shown(service: str, *parameters: Element | SetOf) -> On:
    """A message that shows state and changes none."""
    return _on("shown", service, parameters)


def internal(what: str, *parameters: Element | SetOf) -> On:
    """What happens inside the controller or at its panel: no message shows it.

    Of several processes that interleave ``what`` names the one that acts, too: ``Cmd02.ScanMIO``.
    """
    return _on("internal", what, parameters)
