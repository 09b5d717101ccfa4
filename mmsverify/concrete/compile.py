"""Instances as Python source: one function for the successors of a packed state, and predicates for claims.

A successor is a pair of an instance's number and a packed state, or ``None`` in place of the state where an
integer would leave its bounds. Nothing here knows expressions of the language.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import Any

from mmsverify.concrete.formulas import Formulas
from mmsverify.concrete.ground import Instance
from mmsverify.concrete.layout import Layout, State
from mmsverify.concrete.source import Source
from mmsverify.concrete.trie import Branch, Tests, Wanted, arrange
from mmsverify.model.sorts import IntSort

Successors = Callable[[State], list[tuple[int, State | None]]]
Predicate = Callable[[State], object]
TwoStatePredicate = Callable[[State, State], object]

_DEEPEST = 10


def compile_successors(
    layout: Layout, formulas: Formulas, instances: Sequence[Instance], wanted: Iterable[int]
) -> Successors:
    """The function from a state to the steps of the ``wanted`` instances (by number) from it."""
    return _Writer(layout, formulas, instances).successors(wanted)


def compile_predicate(formulas: Formulas, formula: int) -> Predicate:
    """The function from a state to the truth of a one-state formula."""
    two = compile_step(formulas, formula)
    return lambda state: two(state, state)


def compile_step(formulas: Formulas, formula: int) -> TwoStatePredicate:
    """The function from a state and the next one to the truth of a formula."""
    source = Source(formulas)
    last = f"def predicate(s, t):\n return {source.expression(formula)}"
    found: TwoStatePredicate = _executed([*source.definitions, last], "predicate")
    return found


def _executed(definitions: list[str], name: str) -> Any:
    scope: dict[str, Any] = {}
    exec(
        compile("\n".join(definitions), "<rows>", "exec"), scope
    )  # the source is ours, made of integers only
    return scope[name]


class _Writer:
    """Writes the function ``successors`` and the functions that it is cut into."""

    def __init__(self, layout: Layout, formulas: Formulas, instances: Sequence[Instance]) -> None:
        self.layout, self.formulas, self.instances = layout, formulas, instances
        self.source = Source(formulas)
        self.functions: list[str] = []
        self.open, self.close = ("bytearray", "bytes") if layout.in_octets else ("list", "tuple")

    def successors(self, wanted: Iterable[int]) -> Successors:
        """The compiled function."""
        tests = arrange((number, self._literals(self.instances[number])) for number in wanted)
        body = self._tests(tests, 1)
        whole = ["def successors(s):", " out = []", " add = out.append", " t = s", *body, " return out"]
        found: Successors = _executed(
            [*self.source.definitions, *self.functions, "\n".join(whole)], "successors"
        )
        return found

    def _literals(self, instance: Instance) -> Wanted:
        literals: dict[int, bool] = {}
        for part in instance.guard:
            node = self.formulas.nodes[part]
            literals[node.parts[0] if node.op == "not" else part] = node.op != "not"
        return literals

    def _tests(self, tests: Tests, depth: int) -> list[str]:
        if depth > _DEEPEST and tests.branches:
            return [" " * depth + self._cut(tests)]
        lines = [line for number in tests.leaves for line in self._leaf(number, " " * depth)]
        return lines + [line for branch in tests.branches for line in self._branch(branch, depth)]

    def _cut(self, tests: Tests) -> str:
        """A deep part as a function of its own: Python bounds the depth of its blocks."""
        body = self._tests(tests, 1)
        name = f"g{len(self.functions)}"
        self.functions.append("\n".join([f"def {name}(s, t, add):", *body]))
        return f"{name}(s, t, add)"

    def _branch(self, branch: Branch, depth: int) -> list[str]:
        indent = " " * depth
        test = self.source.expression(branch.test)
        then, otherwise = self._tests(branch.then, depth + 1), self._tests(branch.otherwise, depth + 1)
        if not then:
            return [f"{indent}if not {test}:", *otherwise]
        lines = [f"{indent}if {test}:", *then]
        return [*lines, f"{indent}else:", *otherwise] if otherwise else lines

    def _leaf(self, number: int, indent: str) -> list[str]:
        writes = self.instances[number].writes
        if not writes:
            return [f"{indent}add(({number}, s))"]
        lines = [f"{indent}u = {self.open}(s)"]
        bounds = []
        for position, value in writes:
            text = self.source.expression(value)
            if isinstance(self.layout.sorts[position], IntSort):
                low, high = self.layout.ranges[position]
                lines.append(f"{indent}v{position} = {text}")
                text = f"v{position}"
                bounds.append((f"{low} <= v{position} <= {high}", position))
            else:
                lines.append(f"{indent}u[{position}] = {text}")
        return lines + self._last(number, bounds, indent)

    def _last(self, number: int, bounds: list[tuple[str, int]], indent: str) -> list[str]:
        done = f"add(({number}, {self.close}(u)))"
        if not bounds:
            return [indent + done]
        sets = [f"u[{position}] = v{position}" for _, position in bounds]
        test = " and ".join(text for text, _ in bounds)
        return [
            f"{indent}if {test}:",
            f"{indent} {'; '.join([*sets, done])}",
            f"{indent}else: add(({number}, None))",
        ]
