"""Ground formulas as Python source over ``s``, the packed state, and ``t``, the state after a step.

A formula that grows long becomes a function of its own, so that shared parts are written once and no line
grows beyond what Python parses. Nothing here runs.
"""

from __future__ import annotations

from mmsverify.concrete.formulas import Formulas, Node

_LONG = 600


class Source:
    """The text of formulas, and the definitions that it refers to, in order."""

    def __init__(self, formulas: Formulas) -> None:
        self.formulas = formulas
        self.definitions: list[str] = []
        self._text: dict[int, str] = {}

    def expression(self, formula: int) -> str:
        """An expression with the value (or truth) of the formula; safe to stand anywhere."""
        text = self._text.get(formula)
        if text is None:
            text = self._write(self.formulas.nodes[formula])
            if len(text) > _LONG:
                self.definitions.append(f"def f{formula}(s, t):\n return {text}")
                text = f"f{formula}(s, t)"
            self._text[formula] = text
        return text

    def _write(self, node: Node) -> str:
        parts = [self.expression(part) for part in node.parts]
        cell = f"{'t' if node.next else 's'}[{node.cell}]"
        match node.op:
            case "const":
                return str(node.code) if node.code >= 0 else f"({node.code})"
            case "cell":
                return cell
            case "is":
                return f"({cell} == {node.code})"
            case "not":
                return self._negated(node, parts[0])
            case "and":
                return f"({' and '.join(parts)})"
            case "or":
                return self._either(node, parts)
            case "same":
                return f"({parts[0]} == {parts[1]})"
            case "less":
                return f"({parts[0]} < {parts[1]})"
            case "plus":
                return f"({parts[0]} {'+' if node.code > 0 else '-'} {parts[1]})"
            case "ite":
                return f"({parts[1]} if {parts[0]} else {parts[2]})"
        raise ValueError(f"{node.op} has no value")

    def _negated(self, node: Node, part: str) -> str:
        inner = self.formulas.nodes[node.parts[0]]
        if inner.op == "is":
            return part.replace("==", "!=")
        return f"(not {part})"

    def _either(self, node: Node, parts: list[str]) -> str:
        """A disjunction; alternatives for one cell become one test of membership."""
        inner = [self.formulas.nodes[part] for part in node.parts]
        if all(n.op == "is" and (n.cell, n.next) == (inner[0].cell, inner[0].next) for n in inner):
            cell = f"{'t' if inner[0].next else 's'}[{inner[0].cell}]"
            return f"({cell} in ({', '.join(str(n.code) for n in inner)}))"
        return f"({' or '.join(parts)})"
