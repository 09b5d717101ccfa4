"""Verdicts in a notebook: a table of properties, and runs that are read by what changes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import pandas as pd

from mmsverify.errors import UsageError
from mmsverify.report import render_check
from mmsverify.report.check_text import summary
from mmsverify.report.frame import verdicts_frame
from mmsverify.report.markup import Markup, code, element, folding, joined, table, text, word
from mmsverify.report.wording import cells, spoken
from mmsverify.results import ModelCheck, PathStep, Verdict

MOST_SHOWN = 40
"""Verdicts that a check shows of itself: first those that are not as they should be."""
RANK = {"violated": 0, "unknown": 1, "proved": 2}


def checked(name: str | Path, *, properties: Sequence[str] = (), **how: Any) -> NotebookCheck:
    """Check one model; what ``how`` may hold is what ``mmsverify.check`` takes."""
    from mmsverify.checking import check_models  # it needs Z3: who only audits does not wait for that

    profile = how.pop("profile", None)
    given = None if profile is None else Path(profile)
    named = [properties] if isinstance(properties, str) else list(properties)
    (result,) = check_models([str(name)], properties=named, profile=given, **how)
    return NotebookCheck(result)


class NotebookCheck:
    """The verdicts of a model in order; ``check["one-controller"]`` is one. ``result`` is plain data."""

    def __init__(self, result: ModelCheck) -> None:
        self.result = result
        self.verdicts = [NotebookVerdict(verdict) for verdict in result.verdicts]

    @cached_property
    def frame(self) -> pd.DataFrame:
        """One row for each property."""
        return verdicts_frame(self.result.verdicts)

    @property
    def holds(self) -> bool:
        """Whether every property is proved."""
        return all(verdict.result == "proved" for verdict in self.verdicts)

    @property
    def violated(self) -> list[NotebookVerdict]:
        """The verdicts of the properties that are violated."""
        return [verdict for verdict in self.verdicts if verdict.result == "violated"]

    def __getitem__(self, name: str) -> NotebookVerdict:
        """The verdict of a property by its name; raises ``UsageError`` where it was not checked."""
        for verdict in self.verdicts:
            if verdict.name == name.replace("_", "-"):
                return verdict
        raise UsageError(f"no verdict of {name!r}", cure="see check.frame for what was checked")

    def __iter__(self) -> Iterator[NotebookVerdict]:
        return iter(self.verdicts)

    def __len__(self) -> int:
        return len(self.verdicts)

    def __repr__(self) -> str:
        return f"<check of {self.result.model}, {self.result.variant}: {summary(self.result)}>"

    def __str__(self) -> str:
        return render_check([self.result], "text")

    def _repr_html_(self) -> str:
        said = element(
            "p", element("b", self.result.model), f", {self.result.variant}: {summary(self.result)}"
        )
        told = sorted(self.verdicts, key=lambda verdict: RANK[verdict.result])[:MOST_SHOWN]
        rows = [(code(v.name), word(v.result), v.verdict.method, v.scope, v.verdict.statement) for v in told]
        more = len(self.verdicts) - len(told)
        rest = element("p", f"and {more} more: see check.frame") if more else Markup()
        runs = [verdict.as_markup() for verdict in told if verdict.counterexample is not None]
        notes = [element("p", f"note: {note}") for note in self.result.notes]
        head = ("property", "result", "method", "scope", "what it says")
        return element("div", said, table(head, rows), rest, *runs, *notes)


class NotebookVerdict:
    """What is known of one property. ``verdict`` is plain data."""

    def __init__(self, verdict: Verdict) -> None:
        self.verdict = verdict
        self.name = verdict.name
        self.result = verdict.result
        self.counterexample = _run(verdict.counterexample)
        self.witness = _run(verdict.witness)

    @property
    def scope(self) -> str:
        """Of how many elements it is known, and within how many steps."""
        depth = "" if self.verdict.depth is None else f", depth {self.verdict.depth}"
        return self.verdict.scope + depth

    def __repr__(self) -> str:
        return f"<{self.name}: {self.result} by {self.verdict.method}, {self.scope}>"

    def as_markup(self) -> Markup:
        """The verdict with its run."""
        head = joined([code(self.name), " is ", word(self.result), f" ({' '.join(self.verdict.clauses)})"])
        told = [element("p", line) for line in (self.verdict.statement, self.verdict.reason) if line]
        run = self.counterexample or self.witness
        return element("div", element("p", head), *told, *([run.as_markup()] if run is not None else []))

    def _repr_html_(self) -> str:
        return self.as_markup()


class NotebookRun:
    """A counterexample or a witness: steps, the first of which is the initial state."""

    def __init__(self, steps: Sequence[PathStep]) -> None:
        self.steps = tuple(steps)

    @cached_property
    def frame(self) -> pd.DataFrame:
        """One row for each step: action, arguments, clauses, and the cells that it changes."""
        rows = [
            (step.action, dict(step.arguments), step.clauses, _changes(before, step))
            for before, step in self._pairs()
        ]
        return pd.DataFrame(rows, columns=["action", "arguments", "clauses", "changes"])

    def __len__(self) -> int:
        return len(self.steps)

    def __repr__(self) -> str:
        return f"<run of {len(self.steps)} steps: {', '.join(step.action for step in self.steps)}>"

    def as_markup(self) -> Markup:
        """The run as a table."""
        rows = [
            (number, _action(step), _shown(before, step), element("small", " ".join(step.clauses)))
            for number, (before, step) in enumerate(self._pairs(), start=1)
        ]
        return table(("", "step", "what changes", "clauses"), rows)

    def _repr_html_(self) -> str:
        return self.as_markup()

    def _pairs(self) -> Iterator[tuple[Mapping[str, str] | None, PathStep]]:
        before: dict[str, str] | None = None
        for step in self.steps:
            yield before, step
            before = {**(before or {}), **cells(step.state)}


def _run(steps: tuple[PathStep, ...] | None) -> NotebookRun | None:
    return None if steps is None else NotebookRun(steps)


def _changes(before: Mapping[str, str] | None, step: PathStep) -> dict[str, str]:
    """What a step changes, as ``from -> to``; the first state as it is."""
    after = cells(step.state)
    if before is None:
        return after
    return {
        cell: f"{before.get(cell, 'unknown')} -> {held}"
        for cell, held in after.items()
        if before.get(cell) != held
    }


def _shown(before: Mapping[str, str] | None, step: PathStep) -> Markup:
    changes = _changes(before, step)
    if before is None:
        told = {cell: held for cell, held in changes.items() if held not in ("false", "0")}
        return folding("the state at the beginning", _listed(told))
    return _listed(changes) if changes else text("(no cell changes)")


def _listed(values: Mapping[str, str]) -> Markup:
    return joined([joined([code(cell), f" {held}"]) for cell, held in values.items()], "<br>")


def _action(step: PathStep) -> Markup:
    arguments = ", ".join(f"{name}={spoken(value)}" for name, value in step.arguments.items())
    return joined([element("b", step.action), f"({arguments})" if arguments else ""])
