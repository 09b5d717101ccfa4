"""Diagrams of a model by name: load it, explore a small scope, draw the views that it declares.

Ties loading, exploration and drawing together; the drawing itself is ``graph``'s.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from mmsverify.concrete import Machine, Scope, scope_for
from mmsverify.errors import UsageError
from mmsverify.graph import View, dot, mermaid, svg, view_names, views
from mmsverify.model import ModelData, load
from mmsverify.resources import models_dir

DRAWINGS: Mapping[str, Callable[[Sequence[View]], str]] = {"mermaid": mermaid, "dot": dot, "svg": svg}

MAX_STATES = 5000
"""How many states are expanded: enough for every small model, a fair sample of a large one."""

DIAGRAM_BOUNDS = (0, 1)
"""The bounds of integers without bounds: a diagram shows that a counter changes, not how far it counts."""


def draw(model: str, *, variant: str, format: str) -> str:
    """The views of a model as ``mermaid``, ``dot`` or ``svg``.

    ``model`` is a name or a path. The scope is the model's option ``diagram`` (``{"sizes": ..., "profile":
    ...}``), else two of each sort.
    """
    if format not in DRAWINGS:
        raise UsageError(f"no diagrams in the format {format!r}", cure=f"use one of {', '.join(DRAWINGS)}")
    loaded = load(model, models_dir(), variant)
    machine = Machine(loaded, diagram_scope(loaded))
    return DRAWINGS[format](views(machine, view_names(loaded), max_states=MAX_STATES))


def diagram_scope(model: ModelData) -> Scope:
    """The small scope in which a model is drawn."""
    asked: Mapping[str, Any] = model.options.get("diagram", {})
    sizes = asked.get("sizes", {sort.short: 2 for sort in model.sorts.values()})
    scope = scope_for(model, sizes, asked.get("profile", {}))
    return Scope(scope.elements, scope.facts, DIAGRAM_BOUNDS)
