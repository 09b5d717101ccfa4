"""Formulas about the cells of known names: whether they hold in a partial state, what they imply.

Names are resolved: a node knows the bits of the cells that it reads. Assuming a formula narrows a state: a
conjunct narrows cells without a split. A disjunction with one possible part narrows by it; with a few, it
splits in order ("the first that holds is the i-th"), n parts for n alternatives; with many, or where splits
are not wanted, the state is kept as it is, which allows too much but never too little. None is left only
where none is possible.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mmsverify.concrete.belief.partial import Partial
from mmsverify.concrete.belief.slots import Value
from mmsverify.concrete.belief.values import EITHER, NO, YES, Known, join, same

LARGEST_SPLIT = 6
_FLIP = (0, YES, NO, EITHER)


class Conditional:
    """If-then-else."""

    __slots__ = ("condition", "otherwise", "reads", "then")

    def __init__(self, condition: Formula, then: Value, otherwise: Value) -> None:
        self.condition, self.then, self.otherwise = condition, then, otherwise
        self.reads = condition.reads | then.reads | otherwise.reads

    def known(self, state: Partial) -> Known:
        """The value of the branch, or of both."""
        holds = self.condition.holds(state)
        if holds == YES:
            return self.then.known(state)
        if holds == NO:
            return self.otherwise.known(state)
        return join(self.then.known(state), self.otherwise.known(state))


class Formula:
    """A formula about known names; where nothing else is said, it narrows nothing."""

    __slots__ = ("reads",)
    reads: int

    def holds(self, state: Partial) -> int:
        """Whether it holds: ``NO``, ``YES`` or ``EITHER``."""
        raise NotImplementedError

    def known(self, state: Partial) -> Known:
        """The same, as a value."""
        return self.holds(state)

    def assume(self, state: Partial, want: bool, _split: bool) -> list[Partial]:
        """What remains of a state when it is assumed to be ``want``; ``split`` allows several states."""
        return [state] if self.holds(state) & (YES if want else NO) else []


class Fixed(Formula):
    """A truth value that does not depend on the state."""

    __slots__ = ("value",)

    def __init__(self, value: int) -> None:
        self.value = value
        self.reads = 0

    def holds(self, _state: Partial) -> int:
        return self.value


class Among(Formula):
    """A cell has one of several values."""

    __slots__ = ("full", "good", "shift")

    def __init__(self, shift: int, full: int, good: int) -> None:
        self.shift, self.full, self.good = shift, full, good
        self.reads = full << shift

    def holds(self, state: Partial) -> int:
        now = state.bits >> self.shift & self.full
        if not now & self.good:
            return NO
        return EITHER if now & ~self.good else YES

    def assume(self, state: Partial, want: bool, _split: bool) -> list[Partial]:
        now = state.bits >> self.shift & self.full
        left = now & self.good if want else now & ~self.good
        if left == now:
            return [state]
        return [state.with_bits(state.bits ^ (now ^ left) << self.shift)] if left else []


class Not(Formula):
    """Negation."""

    __slots__ = ("body",)

    def __init__(self, body: Formula) -> None:
        self.body = body
        self.reads = body.reads

    def holds(self, state: Partial) -> int:
        return _FLIP[self.body.holds(state)]

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        return self.body.assume(state, not want, split)


class Connective(Formula):
    """A conjunction, or (``deciding`` is ``YES``) a disjunction; parts in order."""

    __slots__ = ("deciding", "other", "parts")

    def __init__(self, parts: Sequence[Formula], deciding: int) -> None:
        self.parts, self.deciding, self.other = tuple(parts), deciding, _FLIP[deciding]
        self.reads = reading(parts)

    def holds(self, state: Partial) -> int:
        deciding, result = self.deciding, self.other
        for part in self.parts:
            found = part.holds(state)
            if found == deciding:
                return deciding
            if found == EITHER:
                result = EITHER
        return result

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        if want == (self.deciding == NO):
            return in_turn(self.parts, state, want, split)
        good, bad = (YES, NO) if want else (NO, YES)
        possible: list[Formula] = []
        for part in self.parts:
            found = part.holds(state)
            if found == good:
                return [state]
            if found != bad:
                possible.append(part)
        return alternatives(possible, state, want, split)


def in_turn(parts: Sequence[Formula], state: Partial, want: bool, split: bool) -> list[Partial]:
    """All of the formulas assumed, each of what the one before it has left."""
    states = [state]
    for part in parts:
        if len(states) == 1:
            states = part.assume(states[0], want, split)
        else:
            states = [after for before in states for after in part.assume(before, want, split)]
        if not states:
            break
    return states


def alternatives(possible: Sequence[Formula], state: Partial, want: bool, split: bool) -> list[Partial]:
    """The states in which the first, or else the second ..., of several formulas is as wanted."""
    if len(possible) == 1:
        return possible[0].assume(state, want, split)
    if not possible:
        return []
    if not split or len(possible) > LARGEST_SPLIT:
        return [state]
    result: list[Partial] = []
    rest = [state]
    for part in possible:
        result += [after for before in rest for after in part.assume(before, want, split)]
        rest = [after for before in rest for after in part.assume(before, not want, False)]
    return result


Remember = Callable[[Partial, bool], Partial]


class Every(Formula):
    """For all names, or (``universal`` is FALSE) for some: the instances of known names, and of unseen ones.

    Of unseen names there may be none: they alone make no universal false, no existential true. What is
    assumed of all of them and left open is remembered as a fact.
    """

    __slots__ = ("decided", "known_names", "universal", "unseen")

    def __init__(
        self, universal: bool, known: Sequence[Formula], unseen: Sequence[tuple[Formula, Remember]]
    ) -> None:
        self.universal = universal
        self.known_names, self.unseen = tuple(known), tuple(unseen)
        self.decided = NO if universal else YES
        self.reads = reading([*known, *(part for part, _ in unseen)])

    def holds(self, state: Partial) -> int:
        decided = self.decided
        other = result = _FLIP[decided]
        for part in self.known_names:
            found = part.holds(state)
            if found == decided:
                return decided
            if found == EITHER:
                result = EITHER
        if result != EITHER:
            for part, _ in self.unseen:
                if part.holds(state) != other:
                    return EITHER
        return result

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        if want != self.universal:
            return self._some(state, want, split)
        states = in_turn(self.known_names, state, want, split)
        wanted = YES if want else NO
        for part, remember in self.unseen:
            states = [_of_unseen(before, part, want, wanted, remember) for before in states]
        return states

    def _some(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        """For some name: narrowed where only known names come into question."""
        good, bad = (YES, NO) if want else (NO, YES)
        possible: list[Formula] = []
        for part in self.known_names:
            found = part.holds(state)
            if found == good:
                return [state]
            if found != bad:
                possible.append(part)
        if any(part.holds(state) != bad for part, _ in self.unseen):
            return [state]
        return alternatives(possible, state, want, split)


def _of_unseen(state: Partial, part: Formula, want: bool, wanted: int, remember: Remember) -> Partial:
    """What holds of every unseen name narrows their common cells; where it leaves them open, it is kept."""
    if part.holds(state) == wanted:
        return state
    narrowed = part.assume(state, want, False)
    if len(narrowed) != 1:
        return state  # of no unseen name: then there is none, and nothing is known of cells that do not exist
    return narrowed[0] if part.holds(narrowed[0]) == wanted else remember(narrowed[0], want)


class Equivalence(Formula):
    """Two formulas have one truth value: if either is decided, so is the other."""

    __slots__ = ("left", "right")

    def __init__(self, left: Formula, right: Formula) -> None:
        self.left, self.right = left, right
        self.reads = left.reads | right.reads

    def holds(self, state: Partial) -> int:
        return same(self.left.holds(state), self.right.holds(state))

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        for known, other in ((self.left, self.right), (self.right, self.left)):
            found = known.holds(state)
            if found != EITHER:
                return other.assume(state, (found == YES) == want, split)
        if not split:
            return [state]
        true = [b for a in self.left.assume(state, True, split) for b in self.right.assume(a, want, split)]
        false = [
            b for a in self.left.assume(state, False, split) for b in self.right.assume(a, not want, split)
        ]
        return true + false


class Choice(Formula):
    """If-then-else of formulas: an if-then-else that is compared with a value."""

    __slots__ = ("condition", "otherwise", "then")

    def __init__(self, condition: Formula, then: Formula, otherwise: Formula) -> None:
        self.condition, self.then, self.otherwise = condition, then, otherwise
        self.reads = condition.reads | then.reads | otherwise.reads

    def holds(self, state: Partial) -> int:
        holds = self.condition.holds(state)
        if holds == YES:
            return self.then.holds(state)
        if holds == NO:
            return self.otherwise.holds(state)
        return self.then.holds(state) | self.otherwise.holds(state)

    def assume(self, state: Partial, want: bool, split: bool) -> list[Partial]:
        wanted = YES if want else NO
        condition = self.condition.holds(state)
        first = condition & YES and self.then.holds(state) & wanted
        second = condition & NO and self.otherwise.holds(state) & wanted
        if first and second and not split:
            return [state]
        result: list[Partial] = []
        if first:
            for met in self.condition.assume(state, True, split):
                result += self.then.assume(met, want, split)
        if second:
            for spared in self.condition.assume(state, False, split):
                result += self.otherwise.assume(spared, want, split)
        return result


def reading(parts: Sequence[Formula | Value]) -> int:
    """The bits of the cells that any of them reads."""
    found = 0
    for part in parts:
        found |= part.reads
    return found
