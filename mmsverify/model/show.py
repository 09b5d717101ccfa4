"""Expressions as text, for messages and certificates; never parsed back."""

from __future__ import annotations

from mmsverify.model.expr import (
    BOUND,
    And,
    Cell,
    Const,
    Eq,
    Expr,
    Ite,
    Less,
    Member,
    Not,
    Or,
    Plus,
    Present,
    Quantified,
    Ref,
    RowFact,
)


def shown(expr: Expr) -> str:
    """The expression as a reader of the standard would write it."""
    match expr:
        case Const(value):
            return str(value)
        case Ref(name):
            return name.rstrip(BOUND + "·'")
        case Cell(variable, args, _, after):
            inner = f"[{', '.join(map(shown, args))}]" if args else ""
            return f"{variable}{inner}{chr(39) if after else ''}"
        case Member(name, element):
            return f"{shown(element)} in {name}"
        case Present(name):
            return f"{name} present"
        case RowFact(fact, values):
            return f"{fact} is {' or '.join(values)}"
        case Plus(left, right, factor):
            return f"{shown(left)} {'+' if factor > 0 else '-'} {shown(right)}"
        case Ite(condition, then, otherwise):
            return f"({shown(then)} if {shown(condition)} else {shown(otherwise)})"
        case Quantified(universal, bound, body):
            names = ", ".join(map(shown, bound))
            return f"{'for all' if universal else 'for some'} {names}: {_bracketed(body)}"
    return _connected(expr)


def _connected(expr: Expr) -> str:
    """A comparison or a formula made with a connective."""
    match expr:
        case Not(Eq(left, right)):
            return f"{shown(left)} != {shown(right)}"
        case Not(Less(left, right)):
            return f"{shown(left)} >= {shown(right)}"
        case Not(body):
            return f"not ({shown(body)})" if isinstance(body, And | Or) else f"not {shown(body)}"
        case And(parts):
            return " and ".join(_bracketed(part) for part in parts)
        case Or(parts):
            return " or ".join(_bracketed(part) for part in parts)
        case Eq(left, right):
            return f"{_bracketed(left)} = {_bracketed(right)}"
        case Less(left, right):
            return f"{shown(left)} < {shown(right)}"
    return repr(expr)


def _bracketed(expr: Expr) -> str:
    return f"({shown(expr)})" if isinstance(expr, And | Or | Quantified | Eq) else shown(expr)
