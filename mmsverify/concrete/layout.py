"""Where each cell of a model stands in a packed state, and what its small integers mean.

A packed state is a ``bytes`` where every value fits in one octet, else a tuple of integers; both are
indexed alike. Rigid cells whose value is known are not stored. Nothing here knows rows.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from functools import cached_property

from mmsverify.concrete.scope import CellKey, Scope, Value
from mmsverify.model.model import ModelData
from mmsverify.model.sorts import IntSort, Sort

State = bytes | tuple[int, ...]


class Layout:
    """The cells of a model in a scope: those in ``fixed`` are constants (codes), others have a position."""

    def __init__(self, model: ModelData, scope: Scope, fixed: Mapping[CellKey, int] | None = None) -> None:
        self.model = model
        self.scope = scope
        self.fixed = dict(fixed or {})
        every = [key for signature in model.signatures.values() for key in scope.cells(signature)]
        self.keys = tuple(key for key in every if key not in self.fixed)
        self.position = {key: i for i, key in enumerate(self.keys)}
        self.sorts = tuple(model.signatures[variable].of for variable, _ in self.keys)
        self.ranges = tuple(self._range(sort) for sort in self.sorts)
        self.in_octets = all(low >= 0 and high <= 255 for low, high in self.ranges)

    def _range(self, sort: Sort) -> tuple[int, int]:
        return self.scope.bounds(sort) if isinstance(sort, IntSort) else (0, len(self.scope.values(sort)) - 1)

    def pack(self, codes: Iterable[int]) -> State:
        """The packed state of the codes, one per position."""
        return bytes(codes) if self.in_octets else tuple(codes)

    def code(self, sort: Sort, value: Value) -> int:
        """The small integer that stands for a value: an integer is itself, others go by their order."""
        if isinstance(sort, IntSort):
            return int(value)  # type: ignore[arg-type]
        return self.scope.values(sort).index(value)

    def value(self, sort: Sort, code: int) -> Value:
        """The value that a small integer stands for."""
        return code if isinstance(sort, IntSort) else self.scope.values(sort)[code]

    @cached_property
    def _constants(self) -> dict[CellKey, Value]:
        return {key: self.value(self.model.signatures[key[0]].of, code) for key, code in self.fixed.items()}

    @cached_property
    def _meanings(self) -> tuple[tuple[CellKey, Sort, tuple[Value, ...]], ...]:
        return tuple(
            (key, sort, () if isinstance(sort, IntSort) else self.scope.values(sort))
            for key, sort in zip(self.keys, self.sorts, strict=True)
        )

    def read(self, state: State) -> dict[CellKey, Value]:
        """The state as a mapping of every cell, known rigid ones included, to its value."""
        held: dict[CellKey, Value] = dict(self._constants)
        for (key, _, values), code in zip(self._meanings, state, strict=True):
            held[key] = values[code] if values else code
        return held

    def write(self, state: Mapping[CellKey, Value]) -> State:
        """The packed form of a state; its known rigid cells are left out."""
        return self.pack(self.code(sort, state[key]) for key, sort in zip(self.keys, self.sorts, strict=True))
