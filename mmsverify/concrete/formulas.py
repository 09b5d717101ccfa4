"""Ground formulas over the positions of a packed state, each stored once and named by a small integer.

Equal formulas are the same integer, so that comparing and sharing cost nothing. The constructors simplify:
they know that a cell has one value. Formulas 0 and 1 are the literals 0 and 1, and thereby false and true.
Nothing here knows models or Python source.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Literal, NamedTuple

Op = Literal["const", "cell", "is", "not", "and", "or", "same", "less", "plus", "ite", "absent", "fact"]

FALSE, TRUE = 0, 1


class Node(NamedTuple):
    """One formula: its operator, the formulas that it is made of, and what the operator needs besides.

    ``cell`` and ``next`` place a ``cell`` or an ``is`` (cell equals ``code``); ``code`` is the literal of a
    ``const``, the factor of a ``plus``, 1 for an ``ite`` or a ``same`` of truth values, the number of a
    ``fact``.
    """

    op: Op
    parts: tuple[int, ...] = ()
    cell: int = -1
    next: bool = False
    code: int = 0


class Formulas:
    """All ground formulas of one model in one scope."""

    def __init__(self) -> None:
        self.nodes: list[Node] = []
        self._ids: dict[Node, int] = {}
        self._partial: set[int] = set()
        self.const(0)
        self.const(1)
        self.absent = self._id(Node("absent"))
        self._partial.add(self.absent)

    def _id(self, node: Node) -> int:
        found = self._ids.get(node)
        if found is None:
            found = self._ids[node] = len(self.nodes)
            self.nodes.append(node)
            if node.op == "ite" and not self._partial.isdisjoint(node.parts):
                self._partial.add(found)
        return found

    def const(self, code: int) -> int:
        """A literal."""
        return self._id(Node("const", code=code))

    def cell(self, position: int, after: bool = False) -> int:
        """The value of a cell, or the truth of a Boolean one."""
        return self._id(Node("cell", (), position, after))

    def fact(self, number: int) -> int:
        """A fact about the row that makes the step, by number."""
        return self._id(Node("fact", code=number))

    def literal(self, formula: int) -> int | None:
        """The code of a literal, else ``None``."""
        node = self.nodes[formula]
        return node.code if node.op == "const" else None

    def negation(self, formula: int) -> int:
        """``not formula``."""
        if formula in (FALSE, TRUE):
            return TRUE - formula
        node = self.nodes[formula]
        return node.parts[0] if node.op == "not" else self._id(Node("not", (formula,)))

    def conjunction(self, formulas: Iterable[int]) -> int:
        """The conjunction, flat, in order; false where two parts exclude each other on their face."""
        kept: dict[int, None] = {}
        settled: dict[tuple[int, bool], int] = {}
        for part in self._flat("and", formulas):
            node = self.nodes[part]
            if part == FALSE or self.negation(part) in kept:
                return FALSE
            if node.op == "is" and settled.setdefault((node.cell, node.next), node.code) != node.code:
                return FALSE
            if part != TRUE:
                kept[part] = None
        live = tuple(part for part in kept if not self._implied(part, settled))
        return self._joined("and", live, TRUE)

    def _implied(self, part: int, settled: dict[tuple[int, bool], int]) -> bool:
        node = self.nodes[part]
        if node.op != "not":
            return False
        inner = self.nodes[node.parts[0]]
        return inner.op == "is" and settled.get((inner.cell, inner.next), inner.code) != inner.code

    def disjunction(self, formulas: Iterable[int]) -> int:
        """The disjunction, flat, in order."""
        kept: dict[int, None] = {}
        for part in self._flat("or", formulas):
            if part == TRUE or self.negation(part) in kept:
                return TRUE
            if part != FALSE:
                kept[part] = None
        return self._joined("or", tuple(kept), FALSE)

    def _flat(self, op: Op, formulas: Iterable[int]) -> Iterable[int]:
        for formula in formulas:
            node = self.nodes[formula]
            if node.op == op:
                yield from node.parts
            else:
                yield formula

    def _joined(self, op: Op, parts: tuple[int, ...], neutral: int) -> int:
        if not parts:
            return neutral
        return parts[0] if len(parts) == 1 else self._id(Node(op, parts))

    def parts(self, formula: int) -> tuple[int, ...]:
        """The conjuncts of a formula."""
        if formula == TRUE:
            return ()
        node = self.nodes[formula]
        return node.parts if node.op == "and" else (formula,)

    def same(self, left: int, right: int, boolean: bool = False) -> int:
        """Equality; of truth values, equivalence. An absent value equals nothing."""
        if self.absent in (left, right):
            return FALSE
        if self.literal(left) is not None:
            left, right = right, left
        code, node = self.literal(right), self.nodes[left]
        if left in self._partial or (node.op == "ite" and not boolean and code is not None):
            return self._through(left, lambda value: self.same(value, right), boolean=True)
        if right in self._partial:
            return self._through(right, lambda value: self.same(left, value), boolean=True)
        if left == right:
            return TRUE
        if code is None:
            return self._id(Node("same", (min(left, right), max(left, right)), code=int(boolean)))
        return self._is(left, node, code, boolean)

    def _is(self, left: int, node: Node, code: int, boolean: bool) -> int:
        if boolean:
            return left if code else self.negation(left)
        if node.op == "const":
            return FALSE
        if node.op == "cell":
            return self._id(Node("is", (), node.cell, node.next, code))
        return self._id(Node("same", (left, self.const(code))))

    def less(self, left: int, right: int) -> int:
        """``left < right``; false where one is absent."""
        if self.absent in (left, right):
            return FALSE
        if left in self._partial:
            return self._through(left, lambda value: self.less(value, right), boolean=True)
        if right in self._partial:
            return self._through(right, lambda value: self.less(left, value), boolean=True)
        low, high = self.literal(left), self.literal(right)
        if low is not None and high is not None:
            return TRUE if low < high else FALSE
        return FALSE if left == right else self._id(Node("less", (left, right)))

    def plus(self, left: int, right: int, factor: int) -> int:
        """``left + factor * right``; absent where one is."""
        if self.absent in (left, right):
            return self.absent
        if left in self._partial:
            return self._through(left, lambda value: self.plus(value, right, factor))
        if right in self._partial:
            return self._through(right, lambda value: self.plus(left, value, factor))
        first, second = self.literal(left), self.literal(right)
        if first is not None and second is not None:
            return self.const(first + factor * second)
        return left if second == 0 else self._id(Node("plus", (left, right), code=factor))

    def _through(self, formula: int, change: Callable[[int], int], boolean: bool = False) -> int:
        """``change`` applied to both branches of a choice, one of which may be absent."""
        condition, then, otherwise = self.nodes[formula].parts
        return self.ite(condition, change(then), change(otherwise), boolean)

    def ite(self, condition: int, then: int, otherwise: int, boolean: bool = False) -> int:
        """``then`` where ``condition`` holds, else ``otherwise``."""
        if then == otherwise or condition == TRUE:
            return then
        if condition == FALSE:
            return otherwise
        if boolean and (then in (FALSE, TRUE) or otherwise in (FALSE, TRUE)):
            return self._connectives(condition, then, otherwise)
        return self._id(Node("ite", (condition, then, otherwise), code=int(boolean)))

    def _connectives(self, condition: int, then: int, otherwise: int) -> int:
        if then == TRUE:
            return self.disjunction((condition, otherwise))
        if then == FALSE:
            return self.conjunction((self.negation(condition), otherwise))
        if otherwise == TRUE:
            return self.disjunction((self.negation(condition), then))
        return self.conjunction((condition, then))

    def cases(self, formula: int, codes: range) -> list[tuple[int, int]]:
        """What a value can be: pairs of a condition and a code; an absent value is no case."""
        code = self.literal(formula)
        if code is not None:
            return [(TRUE, code)]
        found = ((self.same(formula, self.const(c)), c) for c in codes)
        return [(condition, c) for condition, c in found if condition != FALSE]

    def rebuilt(self, formula: int, atom: Callable[[Node], int | None], memo: dict[int, int]) -> int:
        """The formula with every atom changed (``None`` keeps it), simplified; ``memo`` is per ``atom``."""
        found = memo.get(formula)
        if found is None:
            node = self.nodes[formula]
            if node.parts:
                found = self._remade(node, [self.rebuilt(part, atom, memo) for part in node.parts])
            else:
                changed = atom(node)
                found = formula if changed is None else changed
            memo[formula] = found
        return found

    def _remade(self, node: Node, parts: list[int]) -> int:
        match node.op:
            case "not":
                return self.negation(parts[0])
            case "and":
                return self.conjunction(parts)
            case "or":
                return self.disjunction(parts)
            case "same":
                return self.same(parts[0], parts[1], bool(node.code))
            case "less":
                return self.less(parts[0], parts[1])
            case "plus":
                return self.plus(parts[0], parts[1], node.code)
        return self.ite(parts[0], parts[1], parts[2], bool(node.code))
