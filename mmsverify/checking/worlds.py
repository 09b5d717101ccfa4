"""The small worlds in which runs are looked for: how many of each sort, and what a profile fixes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import product
from typing import Any

from mmsverify.concrete import Scope, scope_for
from mmsverify.model.model import ModelData

LARGEST_GROWTH = 2
FEW_INTEGERS = (0, 1)
"""What counters range over while a run is looked for: whether one is exhausted is all that most rows ask."""


@dataclass(frozen=True, slots=True)
class World:
    """Sizes by sort, and the profile table that holds in it."""

    sizes: Mapping[str, int]
    profile: Mapping[str, Any] = field(default_factory=dict)

    def scope(self, model: ModelData, few: bool = True) -> Scope:
        """The scope of this world; with ``few``, integers without bounds are 0 or 1."""
        made = scope_for(model, self.sizes, self.profile)
        return replace(made, int_bounds=FEW_INTEGERS) if few else made


def small_worlds(model: ModelData, profile: Mapping[str, Any] | None) -> Sequence[World]:
    """The worlds to look into, smaller ones first: the model's option ``worlds``, else more of each sort.

    The option is a function from a profile table (or ``None``) to tables with ``sizes`` and ``profile``.
    """
    made = model.options.get("worlds")
    if made is not None:
        return [World(each["sizes"], each.get("profile", {})) for each in made(profile)]
    return [World(sizes, profile or {}) for sizes in _growing([s.short for s in model.sorts.values()])]


def _growing(sorts: Sequence[str]) -> Iterator[dict[str, int]]:
    """One of each, then up to ``LARGEST_GROWTH`` more in all ways, the fewest first."""
    ways = (w for w in product(range(LARGEST_GROWTH + 1), repeat=len(sorts)) if sum(w) <= LARGEST_GROWTH)
    for more in sorted(ways, key=lambda w: (sum(w), [-n for n in w])):
        yield {sort: 1 + n for sort, n in zip(sorts, more, strict=True)}
