"""Random small models, written in the public language, for the readers to agree on.

Every construct of the language can occur: relations of arity 0 to 2, enumerations, bounded integers, rigid
cells, quantifiers, conditional values, optional and set-valued parameters, procedures. Optional
parameters are read under ``present`` only, as the language demands.
"""

from __future__ import annotations

import types
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from hypothesis import strategies as st

from mmsverify.concrete import Scope
from mmsverify.model import (
    BOOL,
    Each,
    Enumeration,
    Model,
    ModelData,
    Procedure,
    Relation,
    Transition,
    Variable,
    accept,
    assemble,
    do,
    for_all,
    for_each,
    for_some,
    if_,
    integer,
    internal,
    may,
    optional,
    parameter,
    refuse,
    response,
)
from mmsverify.model.declare import Assign
from mmsverify.model.steps import Step
from mmsverify.model.terms import Element, Maybe, SetOf, Term

Draw = Callable[[st.SearchStrategy[Any]], Any]


class Colour(Enumeration):
    """Three values."""

    RED = "RED"
    GREEN = "GREEN"
    BLUE = "BLUE"


@dataclass
class World:
    """The declarations that the terms of a random model are made of."""

    things: Each
    flag: Variable
    mark: Variable
    link: Variable
    colour: Variable
    level: Variable
    count: Variable
    fixed: Variable

    @staticmethod
    def new() -> World:
        """A fresh vocabulary: the same names in every model."""
        things = Each("Thing")
        things.bind("T")
        made = World(
            things,
            Relation(),
            Relation(things),
            Relation(things, things),
            Variable(Colour, things),
            Variable(integer(0, 2), things),
            Variable(integer()),
            Relation(things, rigid=True),
        )
        for name, variable in made.variables().items():
            variable.bind(name)
        return made

    def variables(self) -> dict[str, Variable]:
        """The variables by name."""
        return {name: value for name, value in vars(self).items() if isinstance(value, Variable)}


@dataclass
class Hand:
    """What can be named at one place: element terms, value parameters, optional ones, sets."""

    world: World
    elements: list[Element] = field(default_factory=list)
    flags: list[Element] = field(default_factory=list)
    colours: list[Element] = field(default_factory=list)
    optionals: list[Maybe] = field(default_factory=list)
    sets: list[SetOf] = field(default_factory=list)
    perhaps: list[Maybe] = field(default_factory=list)

    def also(self, element: Element) -> Hand:
        """The same with one more element."""
        return replace(self, elements=[*self.elements, element])


def one_of(draw: Draw, options: Sequence[Callable[[], Any]]) -> Any:
    """One of several ways to make something."""
    return draw(st.sampled_from(list(options)))()


def element(draw: Draw, hand: Hand) -> Element:
    return draw(st.sampled_from(hand.elements))  # type: ignore[no-any-return]


def colour(draw: Draw, hand: Hand, depth: int) -> Term:
    """A colour as a term: of a cell, a parameter, or one of two."""
    world = hand.world
    options: list[Callable[[], Any]] = [lambda: world.colour[element(draw, hand)]]
    options += [lambda given=given: given for given in hand.colours]  # type: ignore[misc]
    if depth > 0:
        options.append(
            lambda: if_(
                condition(draw, hand, depth - 1), colour(draw, hand, depth - 1), colour(draw, hand, depth - 1)
            )
        )
    return one_of(draw, options)  # type: ignore[no-any-return]


def number(draw: Draw, hand: Hand, depth: int) -> Term:
    """An integer as a term."""
    world = hand.world
    options: list[Callable[[], Any]] = [lambda: world.level[element(draw, hand)], world.count]
    if depth > 0:
        step = draw(st.sampled_from((1, 1, -1)))
        options.append(lambda: number(draw, hand, depth - 1) + step)
        options.append(lambda: number(draw, hand, 0) - number(draw, hand, 0))
    return one_of(draw, options)  # type: ignore[no-any-return]


def atom(draw: Draw, hand: Hand, depth: int) -> Term:
    """A condition without connectives."""
    world = hand.world
    options: list[Callable[[], Any]] = [
        world.flag,
        lambda: world.mark[element(draw, hand)],
        lambda: world.fixed[element(draw, hand)],
        lambda: world.link[element(draw, hand), element(draw, hand)],
        lambda: element(draw, hand) == element(draw, hand),
        lambda: colour(draw, hand, depth) == draw(st.sampled_from(Colour)),
        lambda: colour(draw, hand, depth) == colour(draw, hand, depth),
        lambda: number(draw, hand, depth) < number(draw, hand, depth),
        lambda: number(draw, hand, depth) == draw(st.integers(0, 2)),
    ]
    options += [lambda given=given: given for given in hand.flags]  # type: ignore[misc]
    options += [lambda s=s: s.has(element(draw, hand)) for s in hand.sets]  # type: ignore[misc]
    options += [lambda o=o: o.present & optional_read(draw, hand, o) for o in hand.optionals]  # type: ignore[misc]
    options += [lambda o=o: o.present >> optional_read(draw, hand, o) for o in hand.optionals]  # type: ignore[misc]
    options += [lambda k=k: k.present & (k == draw(st.sampled_from(Colour))) for k in hand.perhaps]  # type: ignore[misc]
    return one_of(draw, options)  # type: ignore[no-any-return]


def optional_read(draw: Draw, hand: Hand, given: Maybe) -> Term:
    """A condition on an optional element that is given."""
    world = hand.world
    options: list[Callable[[], Any]] = [
        lambda: world.mark[given],
        lambda: world.link[element(draw, hand), given],
        lambda: given == element(draw, hand),
        lambda: world.colour[given] == draw(st.sampled_from(Colour)),
    ]
    return one_of(draw, options)  # type: ignore[no-any-return]


def condition(draw: Draw, hand: Hand, depth: int) -> Term:
    """Any condition up to a depth of connectives and quantifiers."""
    if depth == 0:
        return atom(draw, hand, 0)

    def part(within: Hand = hand) -> Term:
        return condition(draw, within, depth - 1)

    def quantified() -> Term:
        bound = hand.world.things.element(f"x{depth}")
        quantifier = draw(st.sampled_from((for_all, for_some)))(bound)
        if draw(st.booleans()):
            quantifier = quantifier.where(part(hand.also(bound)))
        return quantifier(part(hand.also(bound)))  # type: ignore[no-any-return]

    options: list[Callable[[], Any]] = [
        lambda: atom(draw, hand, depth - 1),
        lambda: ~part(),
        lambda: part() & part(),
        lambda: part() | part(),
        lambda: part() >> part(),
        lambda: if_(part(), part(), part()),
        quantified,
    ]
    return one_of(draw, options)  # type: ignore[no-any-return]


def update(draw: Draw, hand: Hand) -> Assign:
    """An update of some cells, perhaps conditional, perhaps of all elements."""
    world = hand.world
    bound = world.things.element("y")
    over = draw(st.booleans())
    hand = hand.also(bound) if over else hand
    options: list[Callable[[], Any]] = [
        lambda: world.flag().becomes(condition(draw, hand, 1)),
        lambda: world.mark[element(draw, hand)].becomes(condition(draw, hand, 1)),
        lambda: world.link[element(draw, hand), element(draw, hand)].becomes(condition(draw, hand, 1)),
        lambda: world.colour[element(draw, hand)].becomes(colour(draw, hand, 1)),
        lambda: world.level[element(draw, hand)].becomes(number(draw, hand, 1)),
        lambda: world.count().becomes(number(draw, hand, 1)),
    ]
    options += [lambda k=k: painted(draw, hand, k) for k in hand.perhaps]  # type: ignore[misc]
    if over:
        # A value for each element at its own cell: nothing else would say which of several values is meant.
        options = [
            lambda: world.mark[bound].becomes(condition(draw, hand, 1)),
            lambda: world.link[bound, element(draw, hand)].becomes(condition(draw, hand, 1)),
            lambda: world.colour[bound].becomes(colour(draw, hand, 1)),
            lambda: world.level[bound].becomes(number(draw, hand, 1)),
            # The same value for every element: it is made if one of them meets the condition.
            lambda: world.flag().becomes(draw(st.booleans())),
            lambda: world.mark[draw(st.sampled_from(hand.elements[:-1]))].becomes(draw(st.booleans())),
        ]
    made: Assign = one_of(draw, options)
    if draw(st.booleans()):
        made = made.when(condition(draw, hand, 1))
    return made.over(bound) if over else made


def painted(draw: Draw, hand: Hand, given: Maybe) -> Assign:
    """An update to an optional value, where it is given."""
    return hand.world.colour[element(draw, hand)].becomes(given).when(given.present)


def updates(draw: Draw, hand: Hand, most: int = 3) -> list[Assign]:
    """Some updates of different cells; they may still meet in one, and then the later wins."""
    found: dict[Any, Assign] = {}
    for _ in range(draw(st.integers(1, most))):
        made = update(draw, hand)
        found.setdefault((made.variable, made.args), made)
    return list(found.values())


def loop(draw: Draw, hand: Hand, label: str) -> Step:
    """A loop whose body writes the element's own colour or mark and reads neither of another element."""
    world = hand.world
    each = world.things.element("z")
    alone = replace(hand, elements=[each], optionals=[], perhaps=[])
    by_colour = draw(st.booleans())
    value = draw(st.sampled_from(Colour)) if by_colour else draw(st.booleans())
    back = draw(st.sampled_from(Colour)) if by_colour else draw(st.booleans())
    cell = world.colour[each] if by_colour else world.mark[each]
    return for_each(
        label, each, where=atom(draw, alone, 0), possible=atom(draw, alone, 0),
        body=[cell.becomes(value)], undo=[cell.becomes(back)] if draw(st.booleans()) else [],
    )  # fmt: skip


def steps(draw: Draw, hand: Hand) -> list[Step]:
    """The steps of a procedure; the last accepts."""
    made: list[Step] = []
    for label in "abcd"[: draw(st.integers(1, 4))]:
        options: list[Callable[[], Step]] = [
            lambda label=label: refuse(label, when=condition(draw, hand, 1)),  # type: ignore[misc]
            lambda label=label: refuse(label, unless=condition(draw, hand, 1), then=updates(draw, hand, 1)),  # type: ignore[misc]
            lambda label=label: do(label, *updates(draw, hand, 2)),  # type: ignore[misc]
            lambda label=label: may(label, *updates(draw, hand, 1)),  # type: ignore[misc]
            lambda label=label: accept(label, when=condition(draw, hand, 1)),  # type: ignore[misc]
            lambda label=label: loop(draw, hand, label),  # type: ignore[misc]
        ]
        made.append(one_of(draw, options))
    return [*made, accept("m")]


def hand_of(draw: Draw, world: World) -> tuple[Hand, list[Element | SetOf]]:
    """Random parameters for one row."""
    hand = Hand(world, [world.things.element("p")])
    if draw(st.booleans()):
        hand.elements.append(world.things.element("q"))
    if draw(st.booleans()):
        hand.flags.append(parameter("f", BOOL))
    if draw(st.booleans()):
        hand.colours.append(parameter("c", Colour))
    if draw(st.booleans()):
        hand.optionals.append(world.things.maybe("o"))
    if draw(st.booleans()):
        hand.sets.append(world.things.some("s"))
    if draw(st.booleans()):
        hand.perhaps.append(optional("k", Colour))
    return hand, [*hand.elements, *hand.flags, *hand.colours, *hand.optionals, *hand.sets, *hand.perhaps]


def body(draw: Draw, world: World) -> dict[str, Any]:
    """The declarations of a random class body."""
    names: dict[str, Any] = {"T": world.things, **world.variables()}
    hand, given = hand_of(draw, world)
    names["act"] = Transition(
        "X-1", on=internal("act", *given),
        when=[condition(draw, hand, 2) for _ in range(draw(st.integers(0, 2)))], then=updates(draw, hand),
    )  # fmt: skip
    hand, given = hand_of(draw, world)
    names["serve"] = Procedure(
        "X-2", on=response("serve", *given), steps=steps(draw, hand), always=updates(draw, hand, 1),
        on_refusal=updates(draw, hand, 1) if draw(st.booleans()) else [],
    )  # fmt: skip
    return names


def model_of(names: dict[str, Any]) -> ModelData:
    """The class body as a model, by the way that a model file takes."""

    def fill(space: Any) -> None:
        for name, value in names.items():
            space[name] = value

    return assemble(types.new_class("Random", (Model,), {"name": "random"}, fill))


def scope_of(draw: Draw, model: ModelData) -> Scope:
    """One or two things, and facts that fix the value of every cell: one initial state."""
    bounds = draw(st.sampled_from(((0, 2), (-1, 1))))
    scope = Scope({"T": ("T1", "T2")[: draw(st.integers(1, 2))]}, int_bounds=bounds)
    facts = {
        key: draw(st.sampled_from(scope.values(signature.of)))
        for signature in model.signatures.values()
        for key in scope.cells(signature)
    }
    return Scope(scope.elements, facts, scope.int_bounds)


@st.composite
def situations(draw: Draw) -> tuple[ModelData, Scope]:
    """A random model and a scope in which it has one random initial state."""
    model = model_of(body(draw, World.new()))
    return model, scope_of(draw, model)


@st.composite
def procedures(draw: Draw) -> tuple[ModelData, Scope, Procedure]:
    """The same, with the declared procedure, for whoever runs its steps one by one."""
    names = body(draw, World.new())
    model = model_of(names)
    return model, scope_of(draw, model), names["serve"]
