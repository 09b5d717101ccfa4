"""Where boxes, arrows and labels of a view go on the page: plain geometry, no markup.

Values stand on an ellipse, ordered so that those with many changes between them are neighbours. Arrows are
curves that bend away from each other and from other boxes; a label stands on its curve where it covers
least.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations

import networkx as nx

from mmsverify.graph.views import Arrow, View

Point = tuple[float, float]

_BENDS = (0.16, 0.26, 0.08, 0.38, -0.16, 0.52, -0.3)
_PLACES = (0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8)
_SAMPLES = 40


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle by its centre and its size."""

    x: float
    y: float
    width: float
    height: float

    def holds(self, point: Point, margin: float = 0.0) -> bool:
        """Whether a point lies inside, or within ``margin`` of it."""
        return (
            abs(point[0] - self.x) <= self.width / 2 + margin
            and abs(point[1] - self.y) <= self.height / 2 + margin
        )

    def meets(self, other: Box, margin: float = 0.0) -> bool:
        """Whether two rectangles overlap, or come closer than ``margin``."""
        return (
            abs(self.x - other.x) < (self.width + other.width) / 2 + margin
            and abs(self.y - other.y) < (self.height + other.height) / 2 + margin
        )


@dataclass(frozen=True, slots=True)
class Curve:
    """A quadratic Bezier curve from ``start`` to ``end``."""

    start: Point
    control: Point
    end: Point

    def at(self, t: float) -> Point:
        """The point at parameter ``t`` from 0 to 1."""
        a, b, c = (1 - t) ** 2, 2 * t * (1 - t), t * t
        return (
            a * self.start[0] + b * self.control[0] + c * self.end[0],
            a * self.start[1] + b * self.control[1] + c * self.end[1],
        )

    def points(self) -> list[Point]:
        """Evenly spread points from start to end."""
        return [self.at(i / _SAMPLES) for i in range(_SAMPLES + 1)]

    def between(self, first: float, last: float) -> Curve:
        """The part of the curve from one parameter to another."""
        tangent = (
            (1 - first) * (1 - last),
            first * (1 - last) + last * (1 - first),
            first * last,
        )
        control = tuple(
            tangent[0] * s + tangent[1] * c + tangent[2] * e
            for s, c, e in zip(self.start, self.control, self.end, strict=True)
        )
        return Curve(self.at(first), (control[0], control[1]), self.at(last))


@dataclass(frozen=True, slots=True)
class Routed:
    """An arrow with its curve and the rectangle of its label."""

    arrow: Arrow
    curve: Curve
    label: Box


def ordered(view: View) -> list[str]:
    """The values in the order in which they go round: exchanged where that brings ends of arrows closer."""
    values = list(view.values)
    pairs = {frozenset((a.source, a.target)) for a in view.arrows}

    def length() -> int:
        place = {value: i for i, value in enumerate(values)}
        spans = (abs(place[min(pair)] - place[max(pair)]) for pair in pairs)
        return sum(min(span, len(values) - span) ** 2 for span in spans)

    best, improved = length(), True
    while improved:
        improved = False
        for i, j in combinations(range(1, len(values)), 2):
            values[i], values[j] = values[j], values[i]
            found = length()
            if found < best:
                best, improved = found, True
            else:
                values[i], values[j] = values[j], values[i]
    return values


def boxes(values: Sequence[str], width: float, height: float) -> dict[str, Box]:
    """A box for each value, on an ellipse; the first is at the top."""
    across = max(300.0, 66.0 * len(values))
    down = max(180.0, 44.0 * len(values))
    if len(values) == 1:
        across = down = 0.0
    places = nx.circular_layout(nx.path_graph(len(values)))
    if len(values) == 2:
        return {value: Box(across * (i - 0.5), 0.0, width, height) for i, value in enumerate(values)}
    return {
        value: Box(across * float(places[i][1]), -down * float(places[i][0]), width, height)
        for i, value in enumerate(values)
    }


def routed(view: View, placed: dict[str, Box], labels: Sequence[tuple[float, float]]) -> list[Routed]:
    """A curve and a place for the label of every arrow; ``labels`` gives their widths and heights."""
    done: list[Routed] = []
    for arrow, size in zip(view.arrows, labels, strict=True):
        options = [
            (_cost(option, placed, done), i, option) for i, option in enumerate(_options(arrow, placed, size))
        ]
        done.append(min(options, key=lambda option: option[:2])[2])
    return done


def _options(arrow: Arrow, placed: dict[str, Box], size: tuple[float, float]) -> Iterator[Routed]:
    source, target = placed[arrow.source], placed[arrow.target]
    for bend in _BENDS:
        curve = _clipped(_bent(source, target, bend), source, target)
        for t in _PLACES:
            yield Routed(arrow, curve, Box(*curve.at(t), *size))


def _bent(source: Box, target: Box, bend: float) -> Curve:
    """From centre to centre, bent to the left of the way; opposite arrows so bend apart."""
    across, down = target.x - source.x, target.y - source.y
    middle = ((source.x + target.x) / 2 + 2 * bend * down, (source.y + target.y) / 2 - 2 * bend * across)
    return Curve((source.x, source.y), middle, (target.x, target.y))


def _clipped(curve: Curve, source: Box, target: Box) -> Curve:
    """The part of a curve that lies outside the boxes at its ends."""
    steps = [i / 200 for i in range(201)]
    first = next((t for t in steps if not source.holds(curve.at(t), 2)), 0.0)
    last = next((t for t in reversed(steps) if not target.holds(curve.at(t), 5)), 1.0)
    return curve.between(first, last)


def _cost(option: Routed, placed: dict[str, Box], done: Sequence[Routed]) -> float:
    """What speaks against an option: covered boxes first, then covered labels and lines."""
    ends = (option.arrow.source, option.arrow.target)
    points = option.curve.points()
    others = [box for value, box in placed.items() if value not in ends]
    cost = 200.0 * sum(box.holds(point, 6) for box in others for point in points)
    cost += 400.0 * sum(option.label.meets(box, 4) for box in placed.values())
    for other in done:
        cost += 150.0 * option.label.meets(other.label, 3)
        cost += 12.0 * sum(option.label.holds(point, 2) for point in other.curve.points())
        cost += 12.0 * sum(other.label.holds(point, 2) for point in points)
    return cost
