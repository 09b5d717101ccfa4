"""Views as SVG: markup only; where things go is ``layout``'s.

A view with few changes has their row names on the arrows; one with many has numbers there and a legend
below. The clauses that the rows cite are the tooltip of an arrow.
"""

from __future__ import annotations

import textwrap
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

from mmsverify.graph.layout import Box, Routed, boxes, ordered, routed
from mmsverify.graph.views import Arrow, View

_FEW = 14
_LETTER, _VALUE_LETTER, _LEGEND_LETTER = 6.7, 8.4, 6.4
_LINE, _MARGIN, _TITLE = 14.0, 28.0, 18.0

_STYLE = """
  text { font-family: "DejaVu Sans", "Segoe UI", Helvetica, Arial, sans-serif; fill: #1d2733; }
  .title { font-size: 17px; font-weight: 600; }
  .note, .legend { font-size: 11px; fill: #46535f; }
  .value { font-size: 12px; font-weight: 600; text-anchor: middle; }
  .said { font-size: 11px; text-anchor: middle; }
  .number { font-size: 10px; font-weight: 600; text-anchor: middle; fill: #24506e; }
  .box { fill: #f3f7fb; stroke: #35678c; stroke-width: 1.4; }
  .start { fill: #dcecf7; stroke-width: 2.6; }
  .arrow { fill: none; stroke: #7b8a97; stroke-width: 1.3; }
  .badge { fill: #ffffff; stroke: #9fb4c4; stroke-width: 1; }
  .halo { fill: #ffffff; opacity: 0.92; }
"""


@dataclass(frozen=True, slots=True)
class _Panel:
    """One view drawn: its markup, with the top left corner at the origin, and its size."""

    markup: list[str]
    width: float
    height: float


def svg(views: Sequence[View]) -> str:
    """One SVG document with the views below each other."""
    panels = [_panel(view) for view in views]
    width, height = max(panel.width for panel in panels), sum(panel.height for panel in panels)
    lines = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
             f'width="{width:.0f}" height="{height:.0f}">', f"<style>{_STYLE}</style>", _ARROWHEAD,
             f'<rect width="{width:.0f}" height="{height:.0f}" fill="#ffffff"/>']  # fmt: skip
    down = 0.0
    for panel in panels:
        lines += [
            f'<g transform="translate({(width - panel.width) / 2:.1f} {down:.1f})">',
            *panel.markup,
            "</g>",
        ]
        down += panel.height
    return "\n".join([*lines, "</svg>"]) + "\n"


_ARROWHEAD = (
    '<defs><marker id="head" viewBox="0 0 10 10" refX="8.5" refY="5" markerWidth="8" markerHeight="8" '
    'orient="auto"><path d="M0 1 L9 5 L0 9 L2.5 5 z" fill="#5d6c79"/></marker></defs>'
)


def _panel(view: View) -> _Panel:
    labels = [_label(arrow, i, len(view.arrows)) for i, arrow in enumerate(view.arrows, 1)]
    across = max((len(value) for value in view.values), default=4) * _VALUE_LETTER + 26
    placed = boxes(ordered(view), across, 34.0)
    arrows = routed(view, placed, [_size(label) for label in labels])
    left, top, right, bottom = _extent(placed, arrows)
    width = max(right - left, len(view.title) * 10.0, 360.0) + 2 * _MARGIN
    shift = ((width - right - left) / 2, _TITLE + _MARGIN - top)
    markup = [f'<text class="title" x="{_MARGIN:g}" y="{_MARGIN:g}">{escape(view.title)}</text>']
    markup += [
        f'<g transform="translate({shift[0]:.1f} {shift[1]:.1f})">',
        *_drawn(view, placed, arrows, labels),
    ]
    markup += ["</g>"]
    below, height = _below(view, width, _TITLE + 2 * _MARGIN + bottom - top)
    return _Panel(markup + below, width, height)


def _label(arrow: Arrow, number: int, count: int) -> list[str]:
    """The lines on an arrow: its rows, or its number where the view has many arrows."""
    if count > _FEW:
        return [str(number)]
    return textwrap.wrap(", ".join(arrow.rows), 20, break_long_words=False)


def _size(label: Sequence[str]) -> tuple[float, float]:
    if len(label) == 1 and label[0].isdigit():
        return 20.0, 20.0
    return max(map(len, label)) * _LETTER + 6, len(label) * _LINE + 2


def _extent(placed: dict[str, Box], arrows: Sequence[Routed]) -> tuple[float, float, float, float]:
    """The least rectangle around all boxes, curves and labels: left, top, right, bottom."""
    around = [*placed.values(), *(arrow.label for arrow in arrows)]
    points = [
        (b.x + i * b.width / 2, b.y + j * b.height / 2) for b in around for i in (-1, 1) for j in (-1, 1)
    ]
    points += [point for arrow in arrows for point in arrow.curve.points()]
    across, down = [x for x, _ in points], [y for _, y in points]
    return min(across), min(down), max(across), max(down)


def _drawn(
    view: View, placed: dict[str, Box], arrows: Sequence[Routed], labels: Sequence[list[str]]
) -> list[str]:
    """Curves first, then boxes, then labels, so that nothing hides a word."""
    boxes_drawn = [line for value, box in placed.items() for line in _box(value, box, value in view.initial)]
    labels_drawn = [line for arrow, label in zip(arrows, labels, strict=True) for line in _said(arrow, label)]
    return [*map(_curve, arrows), *boxes_drawn, *labels_drawn]


def _curve(arrow: Routed) -> str:
    (x0, y0), (x1, y1), (x2, y2) = arrow.curve.start, arrow.curve.control, arrow.curve.end
    path = f"M{x0:.1f} {y0:.1f} Q{x1:.1f} {y1:.1f} {x2:.1f} {y2:.1f}"
    return f'<path class="arrow" d="{path}" marker-end="url(#head)">{_tooltip(arrow.arrow)}</path>'


def _tooltip(arrow: Arrow) -> str:
    said = f"{arrow.source} \u2192 {arrow.target}: {', '.join(arrow.rows)} ({' '.join(arrow.clauses)})"
    return f"<title>{escape(said)}</title>"


def _box(value: str, box: Box, start: bool) -> list[str]:
    look = "box start" if start else "box"
    return [
        f'<rect class="{look}" x="{box.x - box.width / 2:.1f}" y="{box.y - box.height / 2:.1f}" '
        f'width="{box.width:.1f}" height="{box.height:.1f}" rx="9"/>',
        f'<text class="value" x="{box.x:.1f}" y="{box.y + 4.2:.1f}">{escape(value)}</text>',
    ]


def _said(arrow: Routed, label: Sequence[str]) -> list[str]:
    at, tip = arrow.label, _tooltip(arrow.arrow)
    if at.width == at.height:
        badge = f'<circle class="badge" cx="{at.x:.1f}" cy="{at.y:.1f}" r="{at.width / 2:.1f}">{tip}</circle>'
        return [badge, f'<text class="number" x="{at.x:.1f}" y="{at.y + 3.6:.1f}">{label[0]}</text>']
    halo = (
        f'<rect class="halo" x="{at.x - at.width / 2:.1f}" y="{at.y - at.height / 2:.1f}" '
        f'width="{at.width:.1f}" height="{at.height:.1f}" rx="4">{tip}</rect>'
    )
    first = at.y - at.height / 2 + 11.5
    return [halo, *_lines("said", at.x, first, label)]


def _below(view: View, width: float, top: float) -> tuple[list[str], float]:
    """The legend (where arrows have numbers) and the note on what was explored; and where these end."""
    markup: list[str] = []
    if len(view.arrows) > _FEW:
        columns = _columns(view, int(((width - 2 * _MARGIN) / 2 - 20) / _LEGEND_LETTER))
        for i, column in enumerate(columns):
            markup += _lines("legend", _MARGIN + i * (width - 2 * _MARGIN) / 2, top + 4, column)
        top += _LINE * max(map(len, columns)) + 10
    if not view.complete:
        markup += _lines(
            "note", _MARGIN, top + 4, ["A part of the states was explored: other changes may exist."]
        )
        top += _LINE
    return markup, top + 14


def _columns(view: View, letters: int) -> tuple[list[str], list[str]]:
    """The legend's lines, in two columns of about equal length."""
    entries = [
        textwrap.wrap(
            f"{i} {a.source} \u2192 {a.target}: {', '.join(a.rows)}", letters, subsequent_indent="\u2003 "
        )
        for i, a in enumerate(view.arrows, 1)
    ]
    half, left = sum(map(len, entries)) / 2, list[str]()
    while entries and len(left) < half:
        left += entries.pop(0)
    return left, [line for entry in entries for line in entry]


def _lines(look: str, x: float, y: float, lines: Sequence[str]) -> list[str]:
    return [
        f'<text class="{look}" x="{x:.1f}" y="{y + i * _LINE:.1f}">{escape(line)}</text>'
        for i, line in enumerate(lines)
    ]
