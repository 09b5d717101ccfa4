"""The steps of a procedure, as the standard prints them: refuse, do, accept, may, for each.

A step is a description; ``procedure`` derives the rows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from mmsverify.model import expr as ex
from mmsverify.model.declare import Assign
from mmsverify.model.expr import Expr, Ref
from mmsverify.model.place import caller, mistake
from mmsverify.model.rows import Clause, Level
from mmsverify.model.show import shown
from mmsverify.model.sorts import BOOL
from mmsverify.model.terms import Element, formula


@dataclass(frozen=True, slots=True)
class StepSource:
    """What all steps share: the printed label, what else it cites, where it stands in the model file."""

    label: str
    cites: tuple[str, ...]
    place: str


@dataclass(frozen=True, slots=True)
class Refuse(StepSource):
    """Where ``condition`` holds, answer result(-) and skip the rest."""

    condition: Expr
    rule: str
    says: str
    level: Level
    then: tuple[Assign, ...]


@dataclass(frozen=True, slots=True)
class Do(StepSource):
    """Make the assignments, all reading the state before this step."""

    assigns: tuple[Assign, ...]


@dataclass(frozen=True, slots=True)
class Accept(StepSource):
    """Where ``condition`` holds, answer result(+) and skip the rest."""

    condition: Expr


@dataclass(frozen=True, slots=True)
class ForEach(StepSource):
    """A loop over the elements for which ``where`` holds, whose body may fail on one of them.

    Iterations are independent: ``body`` reads nothing that another iteration writes. Where ``possible`` fails
    for one element, the elements handled before it (any subset: the order of a list is not visible) keep
    ``undo``, and the procedure answers result(-).
    """

    element: Ref
    where: Expr
    possible: Expr
    body: tuple[Assign, ...]
    undo: tuple[Assign, ...]
    rule: str
    says: str


Step = Refuse | Do | Accept | ForEach


def refuse(
    label: str,
    *cites: str,
    when: Any = None,
    unless: Any = None,
    rule: str = "",
    says: str = "",
    level: Level = "error",
    then: Sequence[Assign] = (),
) -> Refuse:
    """Step ``label`` answers result(-) where ``when`` holds and ``unless`` does not; one may be missing.

    ``then`` are effects of the refusal itself (leaving a transient state, say). ``rule`` and ``says`` name a
    breach of the step in findings; ``level`` is ``warning`` where only a reading of the project forbids it.
    """
    if when is None and unless is None:
        raise mistake(f"step {label} refuses without a condition", "give when=... or unless=...")
    condition = ex.conjunction(
        ex.TRUE if when is None else formula(when),
        ex.TRUE if unless is None else ex.negation(formula(unless)),
    )
    return Refuse(label, cites, caller(), condition, rule, says, level, tuple(then))


def do(label: str, *assigns: Assign, cites: Sequence[str] = ()) -> Do:
    """Step ``label`` makes the assignments."""
    place = caller()
    check_distinct(assigns, place)
    return Do(label, tuple(cites), place, tuple(assigns))


def accept(label: str, *cites: str, when: Any = True) -> Accept:
    """Step ``label`` answers result(+), where ``when`` holds."""
    return Accept(label, cites, caller(), formula(when))


def may(label: str, *assigns: Assign, cites: Sequence[str] = ()) -> Do:
    """Step ``label`` leaves it to the responder whether the assignments are made: a free choice."""
    chosen = Element(Ref(f"chooses_{label}", BOOL))
    return Do(label, tuple(cites), caller(), tuple(assign.when(chosen) for assign in assigns))


def for_each(
    label: str,
    element: Element,
    *cites: str,
    where: Any,
    possible: Any,
    body: Sequence[Assign],
    undo: Sequence[Assign] = (),
    rule: str = "",
    says: str = "",
) -> ForEach:
    """Step ``label`` handles every ``element`` for which ``where`` holds; see :class:`ForEach`."""
    return ForEach(
        label,
        cites,
        caller(),
        element.ref,
        formula(where),
        formula(possible),
        tuple(body),
        tuple(undo),
        rule,
        says,
    )


def cited(clause: str, step: StepSource) -> Clause:
    """The citation of a step: the procedure's clause with the printed label, then what it cites besides.

    A label that starts with a capital is a citation of its own (a reading or a base assumption), not a
    printed step.
    """
    own = step.label if step.label[:1].isupper() else f"{clause}-{step.label}"
    return Clause.of(own, *step.cites)


def check_distinct(assigns: Sequence[Assign], place: str) -> None:
    """Refuse two updates of one cell that are meant to happen at once."""
    seen: dict[tuple[str, tuple[Expr, ...]], Expr] = {}
    for assign in assigns:
        key = (assign.variable, assign.args)
        other = seen.get(key)
        if other is not None and not _apart(other, assign.where):
            raise mistake(
                f"two updates of {assign.variable}[{', '.join(map(shown, assign.args))}] in one step",
                "keep one, or give them conditions that exclude each other",
                place,
            )
        seen[key] = assign.where


def _apart(left: Expr, right: Expr) -> bool:
    """Whether two conditions exclude each other on their face: one negates a conjunct of the other."""
    parts = left.parts if isinstance(left, ex.And) else (left,)
    others = right.parts if isinstance(right, ex.And) else (right,)
    return any(ex.negation(part) == other for part in parts for other in others)
