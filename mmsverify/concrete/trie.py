"""Guards that share conjuncts, arranged so that a shared one is tested once: a tree with instances as leaves.

A literal is a formula and whether it must hold. The test that most instances want comes first; those that
want its negation go under its other branch. Ties fall to the older formula, so that the tree is the same in
every run.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

Wanted = Mapping[int, bool]
"""The literals that an instance still waits for: formula to whether it must hold."""


@dataclass(slots=True)
class Tests:
    """The instances that are enabled here, and further tests, all of which are made."""

    leaves: list[int] = field(default_factory=list)
    branches: list[Branch] = field(default_factory=list)


@dataclass(slots=True)
class Branch:
    """One test and what follows where it holds and where it does not."""

    test: int
    then: Tests
    otherwise: Tests


def arrange(instances: Iterable[tuple[int, Wanted]]) -> Tests:
    """The tree of tests for numbered instances with the literals of their guards."""
    found = Tests()
    waiting: list[tuple[int, Wanted]] = []
    for number, wanted in instances:
        if wanted:
            waiting.append((number, wanted))
        else:
            found.leaves.append(number)
    counts = Counter(test for _, wanted in waiting for test in wanted)
    while waiting:
        test = min(counts, key=lambda formula: (-counts[formula], formula))
        taken = [item for item in waiting if test in item[1]]
        waiting = [item for item in waiting if test not in item[1]]
        counts.subtract(formula for _, wanted in taken for formula in wanted)
        found.branches.append(Branch(test, _under(taken, test, True), _under(taken, test, False)))
    return found


def _under(taken: list[tuple[int, Wanted]], test: int, holds: bool) -> Tests:
    return arrange(
        (number, {formula: sign for formula, sign in wanted.items() if formula != test})
        for number, wanted in taken
        if wanted[test] is holds
    )
