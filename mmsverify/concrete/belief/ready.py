"""Rows with names resolved: conditions and updates as nodes, and the cells that they touch.

Making a row ready is done once for each environment; taking it is the hot path.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from mmsverify.concrete.belief.ground import Ground, element
from mmsverify.concrete.belief.nodes import Fixed, Formula
from mmsverify.concrete.belief.partial import OTHER, Key
from mmsverify.concrete.belief.slots import Value
from mmsverify.concrete.belief.values import ABSENT, NO, Env
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Ref
from mmsverify.model.rows import Row
from mmsverify.model.sorts import ElementSort

LARGEST_MEMO = 20_000


@dataclass(frozen=True, slots=True)
class Write:
    """One update of one cell, where a condition holds.

    ``vague``: it may not be made for all that its condition says. The cell stands for many names, of which
    only one is meant; or the condition speaks of unseen names, of which there may be none.
    """

    key: Key
    where: Formula
    value: Value
    vague: bool


@dataclass(frozen=True, slots=True, eq=False)
class Ready:
    """A row in an environment: its conjuncts, its updates, and the bits of the cells that they touch.

    ``needs`` are the cells that each conjunct reads, ``takes`` those that the updates read. ``unseen``: one
    of the names has not been seen; what is known of all of them need not be its own.
    """

    row: Row
    env: Env
    guard: tuple[Formula, ...]
    updates: tuple[Write, ...]
    needs: tuple[int, ...]
    takes: int
    writes: int
    unseen: bool

    @property
    def reads(self) -> int:
        """The cells that its conjuncts and updates read."""
        found = self.takes
        for needs in self.needs:
            found |= needs
        return found


class Rows:
    """Makes rows ready, and remembers them."""

    def __init__(self, ground: Ground) -> None:
        self.ground = ground
        self._memo: dict[tuple[int, frozenset[Any]], tuple[Row, tuple[Ready, ...]]] = {}

    def forget(self) -> None:
        """Drop what was made: a new name has been seen."""
        self.ground.forget()
        self._memo.clear()

    def ready(self, row: Row, env: Env) -> tuple[Ready, ...]:
        """The row in the environment, once for each choice of elements that no event shows."""
        key = (id(row), frozenset(env.items()))
        found = self._memo.get(key)
        if found is None or found[0] is not row:
            if len(self._memo) > LARGEST_MEMO:
                self._memo.clear()
            found = self._memo[key] = (row, tuple(self._ready(row, each) for each in self._chosen(row, env)))
        return found[1]

    def _chosen(self, row: Row, env: Env) -> Iterator[Env]:
        chosen = [c for c in row.choices if isinstance(c, Ref) and isinstance(c.of, ElementSort)]
        for names in self.ground.world.combinations([ref.of for ref in chosen]):
            yield {**env, **dict(zip((ref.name for ref in chosen), names, strict=True))} if chosen else env

    def _ready(self, row: Row, env: Env) -> Ready:
        guard = tuple(self.ground.formula(conjunct.condition, env) for conjunct in row.guard)
        updates = tuple(write for assign in row.assigns for write in self._writes(assign, env))
        takes = writes = 0
        for update in updates:
            takes |= update.where.reads | update.value.reads
            writes |= self.ground.world.spots[update.key]
        unseen = OTHER in [given for given in env.values() if isinstance(given, str)]
        return Ready(row, env, guard, updates, tuple(f.reads for f in guard), takes, writes, unseen)

    def _writes(self, assign: Assign, env: Env) -> Iterator[Write]:
        names = {ref.name for ref in assign.bound}
        targets = {arg.name for arg in assign.args if isinstance(arg, Ref)}
        one = any(env.get(name) == OTHER for name in targets - names)
        for chosen in self.ground.world.combinations([ref.of for ref in assign.bound]):
            over = dict(zip((ref.name for ref in assign.bound), chosen, strict=True))
            inner = {**env, **over}
            where = self.ground.formula(assign.where, inner)
            if isinstance(where, Fixed) and where.value == NO:
                continue
            args = tuple([element(arg, inner) for arg in assign.args])
            value = self.ground.value(assign.value, inner)
            if ABSENT not in args and value is not None:
                perhaps = any(name == OTHER and ref not in targets for ref, name in over.items())
                yield Write((assign.variable, args), where, value, one or perhaps)
