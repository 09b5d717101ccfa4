"""Views as text that other tools draw: Mermaid state diagrams and DOT. Nothing is computed here."""

from __future__ import annotations

import re
from collections.abc import Sequence

from mmsverify.graph.views import View


def mermaid(views: Sequence[View]) -> str:
    """One Mermaid ``stateDiagram-v2``; several views become states that contain their diagram."""
    lines = ["stateDiagram-v2"]
    for number, view in enumerate(views):
        inner = _mermaid_lines(view, f"v{number}_")
        if len(views) == 1:
            lines += [f"    {line}" for line in inner]
        else:
            lines += [
                f'    state "{view.title}" as v{number} {{',
                *(f"        {line}" for line in inner),
                "    }",
            ]
    return "\n".join(lines) + "\n"


def _mermaid_lines(view: View, prefix: str) -> list[str]:
    names = {value: prefix + re.sub(r"\W", "_", value) for value in view.values}
    lines = [f'state "{value}" as {name}' for value, name in names.items()]
    lines += [f"[*] --> {names[value]}" for value in view.initial]
    lines += [f"{names[a.source]} --> {names[a.target]}: {', '.join(a.rows)}" for a in view.arrows]
    return lines


def dot(views: Sequence[View]) -> str:
    """One DOT digraph with a cluster for each view; the clauses of an edge are its tooltip."""
    lines = [
        "digraph model {",
        "    rankdir=LR;",
        '    node [shape=box, style=rounded, fontname="sans-serif"];',
    ]
    lines += ['    edge [fontname="sans-serif", fontsize=10];']
    for number, view in enumerate(views):
        lines += [f"    subgraph cluster_{number} {{", f"        label={_quoted(view.title)};"]
        lines += [f"        {line}" for line in _dot_lines(view, f"{number}:")]
        lines += ["    }"]
    return "\n".join([*lines, "}"]) + "\n"


def _dot_lines(view: View, prefix: str) -> list[str]:
    lines = []
    for value in view.values:
        weight = ", penwidth=2" if value in view.initial else ""
        lines.append(f"{_quoted(prefix + value)} [label={_quoted(value)}{weight}];")
    for arrow in view.arrows:
        ends = f"{_quoted(prefix + arrow.source)} -> {_quoted(prefix + arrow.target)}"
        said = f"label={_quoted(', '.join(arrow.rows))}, tooltip={_quoted(' '.join(arrow.clauses))}"
        lines.append(f"{ends} [{said}];")
    return lines


def _quoted(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'
