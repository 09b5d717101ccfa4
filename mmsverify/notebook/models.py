"""A model in a notebook: its properties, its state diagram, and the check of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path

import pandas as pd

from mmsverify.model import load
from mmsverify.notebook.checks import NotebookCheck, checked
from mmsverify.report.drawing import Drawing
from mmsverify.report.markup import element, table
from mmsverify.resources import models_dir


class NotebookModel:
    """A model in one variant. ``data`` is what the engines read."""

    def __init__(self, name: str, variant: str | None = None) -> None:
        self._asked = name
        self.data = load(name, models_dir(), variant)
        self.name = self.data.name
        self.variant = self.data.variant

    @cached_property
    def properties(self) -> pd.DataFrame:
        """What the model claims, a row for each: name, kind, clauses, and what it says."""
        rows = [(c.title, c.kind, c.clause.ids + c.clause.readings, c.says) for c in self.data.claims]
        frame = pd.DataFrame(rows, columns=["name", "kind", "clauses", "statement"])
        return frame.astype({"kind": "category"})

    def diagram(self) -> Drawing:
        """The state diagrams that the model declares, from an exploration of a small scope."""
        from mmsverify.diagrams import draw  # it needs networkx

        drawn = draw(self._asked, variant=self.variant, format="svg")
        return Drawing(drawn, f"state diagrams of {self.name}, {self.variant}")

    def check(
        self,
        *,
        properties: Sequence[str] = (),
        scope: Mapping[str, int] | None = None,
        unbounded: bool = False,
        depth: int | None = None,
        timeout: float | None = None,
        profile: str | Path | None = None,
    ) -> NotebookCheck:
        """As ``mmsverify.check`` does, in this variant."""
        return checked(
            self._asked,
            variant=self.variant,
            properties=properties,
            scope=scope,
            unbounded=unbounded,
            depth=depth,
            timeout=timeout,
            profile=profile,
        )

    def __repr__(self) -> str:
        return f"<model {self.name}, {self.variant}>"

    def _repr_html_(self) -> str:
        data = self.data
        sorts = ", ".join(sort.short for sort in data.sorts.values())
        rows = [
            ("standard", data.standard or "none"),
            ("any number of", sorts or "one machine"),
            ("variables", len(data.signatures)),
            ("rows", len(data.rows)),
            ("properties", len(data.claims)),
        ]
        return element(
            "div", element("p", element("b", self.name), f", {self.variant}"), table(("", ""), rows)
        )
