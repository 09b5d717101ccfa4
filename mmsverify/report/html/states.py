"""The path of a device through its states: what states it was known to be in, and how often it went where."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence, Set
from itertools import pairwise
from math import cos, hypot, pi, sin
from typing import NamedTuple

from mmsverify.incident import Change, DeviceLine, Lane
from mmsverify.report.html.text import element, text

STATES = ("robot state, reported", "robot state", "mode")
"""The lanes of which the path is drawn."""
APART, DOWN = 24, 15
"""Pixels: of the circle's radius for each state, and half the height of a box."""
MOST = 14


class Box(NamedTuple):
    """The middle of a state's box, and half its width."""

    x: float
    y: float
    half: float


def path(line: DeviceLine, odd: Set[int]) -> str:
    """The diagram of one device; transitions at the messages ``odd``, which have findings, stand out."""
    lane = next((lane for lane in line.lanes if lane.name in STATES and len(lane.changes) > 1), None)
    return "" if lane is None else _drawn(lane, odd)


def _drawn(lane: Lane, odd: Set[int]) -> str:
    steps: Counter[tuple[str, str]] = Counter()
    wrong: set[tuple[str, str]] = set()
    for one, other in pairwise(lane.changes):
        if _sure(one) and _sure(other):  # what was between, where it is not known, nobody can say
            steps[one.words, other.words] += 1
            if other.index in odd:
                wrong.add((one.words, other.words))
    sure = list(filter(_sure, lane.changes))
    states = list(dict.fromkeys(change.words for change in sure))[:MOST]
    if len(states) < 2:
        return ""
    places = _places(states)
    arrows = [
        _arrow(places[one], places[other], count, odd=(one, other) in wrong)
        for (one, other), count in steps.items()
        if one in places and other in places
    ]
    last = sure[-1].words
    boxes = [_box(name, places[name], last=name == last) for name in states]
    width = 2 * round(max(abs(x) + half for x, _, half in places.values()) + 30)
    height = 2 * round(max(abs(y) for _, y, _ in places.values()) + DOWN + 30)
    drawn = element(
        "svg", "\n".join([*arrows, *boxes]), class_="states", role="img", width=width, height=height,
        viewBox=f"{-width // 2} {-height // 2} {width} {height}",
        aria_label=f"The path through the values of {lane.name}",
    )  # fmt: skip
    key = "numbers: how often; red: with a finding; bold frame: the last one"
    return f'<p class="key">{text(lane.name)} ({key})</p>{drawn}'


def _sure(change: Change) -> bool:
    return bool(change.words) and " | " not in change.words


def _places(states: Sequence[str]) -> dict[str, Box]:
    """The boxes on an ellipse, the first at its top, in the order in which they were first known."""
    turn, radius = 2 * pi / len(states), 60 + APART * len(states) / 2
    return {
        name: Box(1.7 * radius * sin(n * turn), -radius * cos(n * turn), 3.6 * len(name) + 12)
        for n, name in enumerate(states)
    }


def _box(name: str, box: Box, *, last: bool) -> str:
    return (
        f'<g class="state{" last" if last else ""}"><rect x="{box.x - box.half:.0f}" y="{box.y - DOWN:.0f}" '
        f'width="{2 * box.half:.0f}" height="{2 * DOWN}" rx="7"/>'
        f'<text x="{box.x:.0f}" y="{box.y + 4:.0f}" text-anchor="middle">{text(name)}</text></g>'
    )


def _arrow(one: Box, other: Box, count: int, *, odd: bool) -> str:
    """Bent to its left, so that there and back are two arrows."""
    (x1, y1, _), (x2, y2, _) = one, other
    long = hypot(x2 - x1, y2 - y1)
    aside, along = ((y1 - y2) / long, (x2 - x1) / long), ((x2 - x1) / long, (y2 - y1) / long)
    bend = 26 + long / 12
    middle = ((x1 + x2) / 2 + bend * aside[0], (y1 + y2) / 2 + bend * aside[1])
    begin, end = _edge(one, middle), _edge(other, middle)
    head = _head(end, middle)
    kind = "step odd" if odd else "step"
    title = element("title", f"{count} times" + (", with a finding" if odd else ""))
    at = (middle[0] * 0.5 + (begin[0] + end[0]) * 0.25, middle[1] * 0.5 + (begin[1] + end[1]) * 0.25)
    label = f'<text x="{at[0] + 4 * along[1]:.0f}" y="{at[1] + 4:.0f}" text-anchor="middle">{count}</text>'
    return (
        f'<g class="{kind}">{title}<path d="M{begin[0]:.0f} {begin[1]:.0f} Q{middle[0]:.0f} {middle[1]:.0f} '
        f'{end[0]:.0f} {end[1]:.0f}"/><path class="tip" d="{head}"/>{label}</g>'
    )


def _edge(box: Box, towards: tuple[float, float]) -> tuple[float, float]:
    """Where the way out of a box leaves it."""
    dx, dy = towards[0] - box.x, towards[1] - box.y
    scale = min((box.half + 3) / abs(dx) if dx else 9, (DOWN + 3) / abs(dy) if dy else 9, 1)
    return box.x + dx * scale, box.y + dy * scale


def _head(end: tuple[float, float], behind: tuple[float, float]) -> str:
    dx, dy = end[0] - behind[0], end[1] - behind[1]
    long = hypot(dx, dy) or 1
    ux, uy = dx / long, dy / long
    left = end[0] - 9 * ux - 4 * uy, end[1] - 9 * uy + 4 * ux
    right = end[0] - 9 * ux + 4 * uy, end[1] - 9 * uy - 4 * ux
    return f"M{end[0]:.0f} {end[1]:.0f} L{left[0]:.0f} {left[1]:.0f} L{right[0]:.0f} {right[1]:.0f} z"
