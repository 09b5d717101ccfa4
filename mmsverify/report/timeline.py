"""Timelines of controllers as pictures: mode and status over time, commands and findings at their instants.

The only module that needs matplotlib, which the extra ``viz`` installs.
"""

from __future__ import annotations

import io
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from datetime import UTC, datetime
from typing import Any
from warnings import catch_warnings, simplefilter

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.dates import AutoDateLocator, ConciseDateFormatter, date2num
from matplotlib.figure import Figure

from mmsverify.report.wording import printable
from mmsverify.results import Finding

COLOURS: Mapping[str, str] = {"error": "#b3261e", "warning": "#b26a00", "note": "#5f6368"}
WIDTH, HEIGHT, PER_MODE = 10.0, 1.4, 0.22
"""Inches: the width of a picture, the height of an empty timeline, and of each mode in it."""


@dataclass(slots=True)
class Line:
    """What one controller's cells held: the instants in ns at which a word changed, and the new words."""

    controller: str
    order: Sequence[str]
    modes: list[tuple[int, str]] = field(default_factory=list)
    statuses: list[tuple[int, str]] = field(default_factory=list)
    commands: list[tuple[int, str]] = field(default_factory=list)
    begin: int = 0
    end: int = 0


def draw(lines: Sequence[Line], findings: Sequence[Finding]) -> Figure:
    """One timeline a controller; findings are vertical lines with the index of their message."""
    heights = [HEIGHT + PER_MODE * len(_levels(line)) for line in lines]
    figure = Figure(figsize=(WIDTH, sum(heights)), layout="constrained")
    for axes, line in zip(
        figure.subplots(len(lines), squeeze=False, height_ratios=heights).flat, lines, strict=True
    ):
        _draw(
            axes,
            line,
            [found for found in findings if found.vmd == line.controller and found.time is not None],
        )
    return figure


def svg(figure: Figure) -> str:
    """The picture as SVG; the same figure gives the same characters."""
    with mpl.rc_context({"svg.hashsalt": "mmsverify", "svg.fonttype": "none"}), catch_warnings():
        # A font without a name's letters: whoever shows the picture has one.
        simplefilter("ignore", UserWarning)
        figure.savefig(text := io.StringIO(), format="svg", metadata={"Date": None, "Creator": "mmsverify"})
    return text.getvalue()


def _draw(axes: Axes, line: Line, findings: Sequence[Finding]) -> None:
    levels = {word: number for number, word in enumerate(_levels(line))}
    for told, label, style in ((line.modes, "C_RunMD", "-"), (line.statuses, "CS_RunSTA", ":")):
        held = [*told, (line.end, told[-1][1])] if told else []
        instants, heights = [_instant(at) for at, _ in held], [levels[word] for _, word in held]
        axes.step(instants, heights, style, where="post", label=label)
    for at, command in line.commands:
        _write(axes, command, at, -0.4, rotation=90, va="top", fontsize=7)
    for found in findings:
        at, colour = found.time or 0, COLOURS[found.severity]
        axes.axvline(_instant(at), color=colour, linewidth=1)
        side = "right" if 2 * (at - line.begin) > line.end - line.begin else "left"
        _write(axes, f"#{found.index} {found.rule}", at, len(levels) - 0.3, color=colour, fontsize=8, ha=side)
    axes.set_yticks(list(levels.values()), list(map(printable, levels)))
    axes.set_ylim(-2.2 if line.commands else -0.5, len(levels) + 0.5)
    axes.set_title(printable(line.controller) or "controller", loc="left", fontsize=9, parse_math=False)
    axes.legend(loc="upper left", fontsize=7)
    axes.xaxis.axis_date(UTC)
    locator = AutoDateLocator(tz=UTC)  # type: ignore[no-untyped-call]
    axes.xaxis.set_major_locator(locator)
    axes.xaxis.set_major_formatter(ConciseDateFormatter(locator, tz=UTC))  # type: ignore[no-untyped-call]


def _write(axes: Axes, words: str, at: int, height: float, **style: Any) -> None:
    """Words beside an instant; a dollar sign in a name is no mathematics."""
    axes.text(_instant(at), height, f" {printable(words)} ", parse_math=False, **style)


def _levels(line: Line) -> list[str]:
    """The words that occur, in the order of their numbers."""
    held = {word for _, word in (*line.modes, *line.statuses)}
    return [*(word for word in line.order if word in held), *sorted(held - set(line.order))]


def _instant(ns: int) -> float:
    return float(date2num(datetime.fromtimestamp(ns / 1e9, UTC)))  # type: ignore[no-untyped-call]
