"""Small models that tests of the concrete readers and of the graph share."""

from __future__ import annotations

from mmsverify.model import (
    MINUS,
    Always,
    Derived,
    Each,
    Enumeration,
    Initially,
    Model,
    Procedure,
    Relation,
    Sometimes,
    Step,
    Transition,
    Variable,
    accept,
    answered,
    do,
    for_all,
    for_some,
    integer,
    internal,
    refuse,
    response,
    service_is,
    unchanged,
)


class Colour(Enumeration):
    """Two values."""

    RED = "RED"
    GREEN = "GREEN"


class Lamps(Model, name="lamps", views={"colour of a lamp": "colour", "lights": "lights"}):
    """Lamps are switched on one by one and turn green; one that is lit twice is refused."""

    L = Each("Lamp")
    a, b = L.elements("a b")
    lit = Relation(L)
    colour = Variable(Colour, L)
    lights = Derived(for_some(a)(lit[a]))

    press = Procedure("L-1", on=response("press", a), steps=[
        refuse("a", when=lit[a]),
        do("b", lit[a].becomes(True)),
        accept("m"),
    ])  # fmt: skip
    ripen = Transition(
        "L-2",
        on=internal("ripen", a),
        when=[lit[a], colour[a] == Colour.RED],
        then=[colour[a].becomes(Colour.GREEN)],
    )

    dark_at_first = Initially("L-0", for_all(a)(~lit[a] & (colour[a] == Colour.RED)))
    green_is_lit = Always("L-3", for_all(a)((colour[a] == Colour.GREEN) >> lit[a]))
    one_lit = Always("L-4", for_all(a, b)((lit[a] & lit[b]) >> (a == b)))
    all_green = Sometimes("L-5", for_all(a)(colour[a] == Colour.GREEN))
    press_makes_green = Sometimes("L-6", service_is("press") & for_some(a)(colour[a].next != colour[a]))
    refusal_has_no_effect = Step("L-7", answered(MINUS) >> unchanged(lit, colour))
    lit_stays_lit = Step("L-8", for_all(a)(lit[a] >> lit[a].next))
    only_press_lights = Step("L-9", service_is("ripen") >> unchanged(lit))
    nothing_ripens = Step("L-10", unchanged(colour))


class Counter(Model, name="counter"):
    """An integer without a bound."""

    n = Variable(integer(0))
    up = Transition("C-1", on=internal("up"), then=[n().becomes(n() + 1)])
    zero = Initially("C-0", n() == 0)
    small = Always("C-2", n() < 3)
    never_negative = Always("C-3", n() >= 0)
