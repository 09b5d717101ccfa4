"""Partial states: what is known of the cells of one possible state.

The cells that hold truth values or members of enumerations are the bits of one integer: a cell's bits are the
values that it may have, all of them where nothing is known. What one state allows and another does not, what
either allows, whether two are the same: each is one operation. Integers, facts about names not seen yet, and
answers decided but not shown stand beside it, where something is known of them.

Names that the recording has not shown yet share the cells of ``OTHER``: what holds there holds of each of
them. When a name is first seen, it takes over what is known of ``OTHER``.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, Protocol

from mmsverify.concrete.belief.values import EITHER, Env, Known, everything, join, meet, within
from mmsverify.model.model import ModelData
from mmsverify.model.sorts import ElementSort, Sort

OTHER = "*"

Key = tuple[str, tuple[str, ...]]
Beside = Mapping[Key, Any]

UNSEEN = "$unseen"
DECIDED = "$decided"
MARKS = frozenset({UNSEEN, DECIDED})
"""Keys of what a state holds beside cells: facts about unseen names, answers decided but not shown."""


class Reading(Protocol):
    """A formula about the cells of known names: which cells it reads, whether it holds, what it implies."""

    reads: int

    def holds(self, state: Partial) -> int:
        """Whether it holds, as a mask of truth values."""

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        """The states in which it holds, or (``want`` is FALSE) does not."""


@dataclass(frozen=True, slots=True)
class Fact:
    """A formula that holds of every name not seen yet, but says nothing certain about any one of its cells.

    It is assumed of a name when the name is seen. ``about`` reads it of the names of an environment, ``want``
    is its truth value; ``bound`` are the quantified names with their sorts, ``variables`` what it reads.
    """

    about: Callable[[Env], Reading]
    want: bool
    env: Env
    bound: tuple[tuple[str, str], ...]
    variables: frozenset[str]


@dataclass(frozen=True, slots=True)
class Place:
    """Where a cell's bits are in the integer: from which bit on, and the mask of as many bits.

    A cell that holds an integer has one bit that never changes: its place in sets of cells.
    """

    key: Key
    shift: int
    full: int

    @property
    def bits(self) -> int:
        """The cell's own bits."""
        return self.full << self.shift


Identity = tuple[Any, bool, frozenset[tuple[str, Any]], tuple[tuple[str, str], ...]]
"""What makes a fact what it is: its formula, its truth value, its environment and its quantified names."""
Growth = tuple[ElementSort, str] | Identity
"""A name that is seen, or a fact that is made."""


class World:
    """What the partial states of one belief share: the model's variables, the names seen so far by sort.

    ``grown`` are the names and facts in the order in which they came: what states mean rests on nothing else.
    """

    def __init__(self, model: ModelData) -> None:
        self.model = model
        self.grown: list[Growth] = []
        self.full: dict[str, Known] = {s.name: everything(s.of) for s in model.signatures.values()}
        self.full |= {UNSEEN: EITHER}
        self.names: dict[str, list[str]] = {sort.name: [OTHER] for sort in model.sorts.values()}
        self.places: dict[Key, Place] = {}
        self.spots: dict[Key, int] = {}
        self.at_bit: list[Place] = []
        self.of_variable: dict[str, int] = dict.fromkeys(model.signatures, 0)
        self.all = 0
        self.facts: list[Fact] = []
        self.survives: dict[Any, bool] = {}
        self._numbers: dict[Any, int] = {}
        for signature in model.signatures.values():
            for names in self.combinations(signature.sorts):
                self._place((signature.name, names))

    def _place(self, key: Key) -> None:
        full = self.full[key[0]]
        place = Place(key, len(self.at_bit), full if isinstance(full, int) else 1)
        if isinstance(full, int):
            self.places[key] = place
        self.spots[key] = place.bits
        self.at_bit += [place] * place.full.bit_length()
        self.all |= place.bits
        self.of_variable[key[0]] |= place.bits

    def blank(self) -> Partial:
        """The partial state that knows nothing."""
        return Partial(self, self.all, {})

    def known(self, sort: ElementSort, name: str) -> bool:
        """Whether the name has been seen as an element of the sort."""
        return name in self.names[sort.name]

    def add(self, sort: ElementSort, name: str) -> list[tuple[Key, Key]]:
        """See a name; its new cells, each with the one of ``OTHER`` that it takes over from."""
        self.names[sort.name].append(name)
        self.grown.append((sort, name))
        self.survives.clear()
        found: list[tuple[Key, Key]] = []
        for signature in self.model.signatures.values():
            if sort.name in [s.name for s in signature.sorts]:
                for names in self.combinations(signature.sorts):
                    places = [i for i, s in enumerate(signature.sorts) if s.name == sort.name]
                    if any(names[i] == name for i in places):
                        self._place((signature.name, names))
                        old = tuple(OTHER if i in places and n == name else n for i, n in enumerate(names))
                        found.append(((signature.name, names), (signature.name, old)))
        return found

    def mask(self, variables: Iterable[str]) -> int:
        """The bits of all cells of these variables."""
        found = 0
        for variable in variables:
            found |= self.of_variable.get(variable, 0)
        return found

    def changed(self, bits: int) -> Iterator[Place]:
        """The cells that these bits belong to."""
        while bits:
            place = self.at_bit[(bits & -bits).bit_length() - 1]
            yield place
            bits &= ~place.bits

    def fact(self, identity: Identity, about: Callable[[Env], Reading], variables: frozenset[str]) -> Key:
        """The key under which a state holds the fact of that identity."""
        if identity not in self._numbers:
            _, want, env, bound = identity
            self._numbers[identity] = len(self.facts)
            self.facts.append(Fact(about, want, dict(env), bound, variables))
            self.grown.append(identity)
        return UNSEEN, (str(self._numbers[identity]),)

    def fact_of(self, key: Key) -> Fact:
        """The fact that a state holds under the key."""
        return self.facts[int(key[1][0])]

    def combinations(self, sorts: Iterable[Sort]) -> Iterator[tuple[str, ...]]:
        """All tuples of names of these sorts, ``OTHER`` included."""
        return product(*(self.names[sort.name] for sort in sorts))


class Partial:
    """One partial state. Never changed once it is made; equal cells make equal states."""

    __slots__ = ("_hash", "beside", "bits", "world")

    def __init__(self, world: World, bits: int, beside: Beside) -> None:
        self.world = world
        self.bits = bits
        self.beside = beside
        self._hash: int | None = None

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Partial) and self.bits == other.bits and self.beside == other.beside

    def __hash__(self) -> int:
        if self._hash is None:
            self._hash = hash((self.bits, frozenset(self.beside.items())))
        return self._hash

    def get(self, key: Key) -> Known:
        """What is known of a cell."""
        place = self.world.places.get(key)
        if place is not None:
            return self.bits >> place.shift & place.full
        found = self.beside.get(key)
        return self.world.full[key[0]] if found is None else found

    def put(self, key: Key, value: Any) -> Partial:
        """The same state with the cell set to ``value``."""
        place = self.world.places.get(key)
        if place is not None:
            return Partial(self.world, self.bits & ~place.bits | value << place.shift, self.beside)
        beside = {**self.beside, key: value}
        if value == self.world.full.get(key[0]) and key[0] not in MARKS:
            del beside[key]
        return Partial(self.world, self.bits, beside)

    def with_bits(self, bits: int) -> Partial:
        """The same state with other truth values and members of enumerations."""
        return Partial(self.world, bits, self.beside)

    def narrowed(self, key: Key, value: Known) -> Partial | None:
        """The same state with the cell restricted to ``value``; ``None`` if nothing is left."""
        before = self.get(key)
        now = meet(before, value)
        if now is None:
            return None
        return self if now == before else self.put(key, now)

    def without(self, drop: Iterable[Key]) -> Partial:
        """The same state without these marks."""
        gone = set(drop)
        return Partial(self.world, self.bits, {k: v for k, v in self.beside.items() if k not in gone})

    def without_choices(self) -> Partial:
        """The same state without what was found out about free choices."""
        kept = {k: v for k, v in self.beside.items() if k[0][0] != "$" or k[0] in MARKS}
        return self if len(kept) == len(self.beside) else Partial(self.world, self.bits, kept)

    def forget(self, variables: Iterable[str]) -> Partial:
        """The same state with nothing known of these variables."""
        gone = frozenset(variables)
        kept = {k: v for k, v in self.beside.items() if k[0] not in gone and not self._fact_reads(k, gone)}
        return Partial(self.world, self.bits | self.world.mask(gone), kept)

    def keep(self, variables: Iterable[str]) -> Partial:
        """A state with only these variables known."""
        kept = frozenset(variables)
        bits = self.world.all & ~self.world.mask(kept) | self.bits
        return Partial(self.world, bits, {k: v for k, v in self.beside.items() if k[0] in kept})

    def forget_cells(self, gone: Callable[[Key], bool]) -> Partial:
        """The same state with nothing known of the cells that the test chooses."""
        bits = self.bits
        for key, place in self.world.places.items():
            if gone(key):
                bits |= place.bits
        return Partial(self.world, bits, {k: v for k, v in self.beside.items() if not gone(k)})

    def _fact_reads(self, key: Key, variables: frozenset[str]) -> bool:
        return key[0] == UNSEEN and not variables.isdisjoint(self.world.fact_of(key).variables)

    def facts(self) -> list[Key]:
        """The keys of the facts about names not seen yet."""
        return [key for key in self.beside if key[0] == UNSEEN]

    def cells(self) -> Iterator[tuple[Key, Known]]:
        """The cells of which something is known, with what it is."""
        for key, place in self.world.places.items():
            known = self.bits >> place.shift & place.full
            if known != place.full:
                yield key, known
        for key, value in self.beside.items():
            if not key[0].startswith("$"):
                yield key, value

    def meets(self, name: str, sort: ElementSort, cells: Sequence[tuple[Key, Key]]) -> list[Partial]:
        """The states once ``name`` has been seen: it takes over what holds of every unseen name."""
        states = [self._renamed(cells)]
        for key in self.facts():
            fact = self.world.fact_of(key)
            places = [bound for bound, kind in fact.bound if kind == sort.name and fact.env[bound] == OTHER]
            for chosen in product((False, True), repeat=len(places)):
                if any(chosen):
                    env = {**fact.env, **{b: name for b, take in zip(places, chosen, strict=True) if take}}
                    states = [
                        after
                        for before in states
                        for after in fact.about(env).assume(before, fact.want, True)
                    ]
        return states

    def _renamed(self, cells: Sequence[tuple[Key, Key]]) -> Partial:
        bits, beside = self.bits, dict(self.beside)
        places = self.world.places
        for new, old in cells:
            place = places.get(new)
            if place is not None:
                bits |= (bits >> places[old].shift & place.full) << place.shift
            elif old in beside:
                beside[new] = beside[old]
        return Partial(self.world, bits, beside)

    def covers(self, other: Partial) -> bool:
        """Whether every state that ``other`` allows, this one allows; decided answers must be the same."""
        if self.bits | other.bits != self.bits:
            return False
        if self.beside == other.beside:
            return True
        for key, value in self.beside.items():
            theirs = other.beside.get(key)
            if (
                theirs is None
                or (key[0] not in MARKS and not within(theirs, value))
                or (key[0] == DECIDED and theirs != value)
            ):
                return False
        return not any(key[0] == DECIDED and key not in self.beside for key in other.beside)

    def joined(self, other: Partial) -> Partial:
        """A state that allows what either allows."""
        beside = {
            k: v if k[0] in MARKS else join(v, other.beside[k])
            for k, v in self.beside.items()
            if k in other.beside
        }
        return Partial(
            self.world,
            self.bits | other.bits,
            {k: v for k, v in beside.items() if v != self.world.full.get(k[0]) or k[0] in MARKS},
        )
