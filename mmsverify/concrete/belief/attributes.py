"""What is known of attributes in a set of partial states, as words: for timelines, not for judgements."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import reduce

from mmsverify.concrete.belief.ground import Ground
from mmsverify.concrete.belief.partial import OTHER, Partial
from mmsverify.concrete.belief.values import NO, YES, Known, everything, join, plain
from mmsverify.model.sorts import Sort

UNKNOWN, NONE = "", "none"
ALTERNATIVES = " | "
MOST = 3
"""So many alternatives are still worth telling."""


def attribute(ground: Ground, states: Sequence[Partial], name: str) -> str:
    """What is known of a variable without names, or of a definition: a value, a few, or ``UNKNOWN``."""
    model = ground.world.model
    if name in model.definitions:
        _, body = model.definitions[name]
        value = ground.value(body, {})
        known = None if value is None else reduce(join, (value.known(state) for state in states))
        return UNKNOWN if known is None else words(known, body.sort)
    known = reduce(join, (state.get((name, ())) for state in states))
    return words(known, model.signatures[name].of)


def of_each(ground: Ground, states: Sequence[Partial], variable: str, names: Iterable[str]) -> dict[str, str]:
    """What is known of a variable of one sort, for each of these names."""
    sort = ground.world.model.signatures[variable].of
    return {
        name: words(reduce(join, (state.get((variable, (name,))) for state in states)), sort)
        for name in names
    }


def the_one(states: Sequence[Partial], relation: str, names: Iterable[str]) -> str:
    """Of which name a relation holds that holds of one at most: that name, ``NONE``, or ``UNKNOWN``."""
    known = {
        name: reduce(join, (state.get((relation, (name,))) for state in states)) for name in (*names, OTHER)
    }
    held = [name for name, value in known.items() if value == YES and name != OTHER]
    if held:
        return ALTERNATIVES.join(held[:MOST])
    return NONE if all(value == NO for value in known.values()) else UNKNOWN


def words(known: Known, sort: Sort) -> str:
    """A value or a few; ``UNKNOWN`` where it may be anything, or too much."""
    if known == everything(sort):
        return UNKNOWN
    listed = plain(known, sort)
    return ALTERNATIVES.join(map(_spoken, listed)) if 0 < len(listed) <= MOST else UNKNOWN


def _spoken(value: object) -> str:
    return str(value).upper() if isinstance(value, bool) else str(value)
