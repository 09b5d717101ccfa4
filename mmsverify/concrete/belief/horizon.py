"""How far a state may still drift before an event: the values that moves could yet give to cells.

A state from which, for all that may still happen, the event cannot be, need not be explored further.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from mmsverify.concrete.belief.nodes import Among, Conditional, Fixed
from mmsverify.concrete.belief.partial import Key, Partial, World
from mmsverify.concrete.belief.ready import Ready
from mmsverify.concrete.belief.slots import CellBeside, CellBits, Constant, Value
from mmsverify.concrete.belief.values import YES, Known, join


@dataclass(slots=True)
class Reach:
    """For each cell, the values that moves may give it: as bits, and beside them those of integers."""

    bits: int = 0
    beside: dict[Key, Known] = field(default_factory=dict)

    def drifted(self, state: Partial) -> Partial:
        """The state with every value still possible that its cells may yet take."""
        beside = state.beside
        if self.beside and beside:
            beside = {k: join(v, self.beside[k]) if k in self.beside else v for k, v in beside.items()}
        return Partial(state.world, state.bits | self.bits, beside)

    def anything(self, world: World, variables: Iterable[str]) -> None:
        """These variables may become anything."""
        names = frozenset(variables)
        self.bits |= world.mask(names)
        self.beside |= {key: world.full[key[0]] for key in world.spots if key[0] in names}


def reach(ways: Iterable[Ready], world: World) -> Reach:
    """The values that the rows may give."""
    found = Reach()
    for way in ways:
        for write in way.updates:
            place = world.places.get(write.key)
            for known in _values(write.value, world.spots[write.key], world.full[write.key[0]]):
                if place is not None:
                    assert isinstance(known, int)
                    found.bits |= known << place.shift
                else:
                    found.beside[write.key] = join(found.beside.get(write.key, known), known)
    return found


def _values(value: Value, target: int, full: Known) -> list[Known]:
    """The values that an assignment may give its target, beyond what the target already has."""
    match value:
        case Conditional():
            return _values(value.then, target, full) + _values(value.otherwise, target, full)
        case Constant() | Fixed():
            return [value.value]
        case CellBeside() if not value.reads:
            return [value.full]
        case CellBits() | CellBeside() if value.reads == target:
            return []
        case Among() if value.reads == target and value.good == YES:
            return []
    return [full]
