"""Which cells an expression touches, as far as its parameters tell.

A pattern is a variable with names, or "any" in place of a bound one.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from mmsverify.concrete.belief.partial import Key
from mmsverify.model import expr as ex
from mmsverify.model.expr import Cell, Expr, Ref

Pattern = tuple[str, tuple[str | None, ...]]
"""A variable with the names at which it is touched; ``None`` stands for any name."""


def patterns(expr: Expr) -> Iterator[Pattern]:
    """The cells as they stand in an expression, with the names of its parameters."""
    for node in ex.walk(expr):
        if isinstance(node, Cell):
            yield node.variable, tuple(arg.name if isinstance(arg, Ref) else None for arg in node.args)


def at(patterns: Iterable[Pattern], env: Mapping[str, Any]) -> frozenset[Pattern]:
    """The patterns with parameters replaced by the names of an environment; other names become "any"."""
    return frozenset(
        (variable, tuple(_named(env.get(arg)) if arg else None for arg in args))
        for variable, args in patterns
    )


def _named(given: Any) -> str | None:
    return given if isinstance(given, str) else None


def touches(patterns: Iterable[Pattern], keys: Iterable[Key]) -> bool:
    """Whether one of the cells is among the patterns."""
    by_variable: dict[str, list[tuple[str | None, ...]]] = {}
    for variable, args in patterns:
        by_variable.setdefault(variable, []).append(args)
    return any(
        all(want is None or want == name for want, name in zip(args, names, strict=True))
        for variable, names in keys
        for args in by_variable.get(variable, ())
    )


def overlap(left: Iterable[Pattern], right: Iterable[Pattern]) -> bool:
    """Whether some cell may be among both."""
    by_variable: dict[str, list[tuple[str | None, ...]]] = {}
    for variable, args in left:
        by_variable.setdefault(variable, []).append(args)
    return any(
        all(a is None or b is None or a == b for a, b in zip(mine, args, strict=True))
        for variable, args in right
        for mine in by_variable.get(variable, ())
    )
