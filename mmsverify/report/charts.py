"""What was known of devices over time, as a chart: a panel for each device, all on one axis of time.

A lane is an attribute; its bars are the times in which it held a value. Findings stand above the lanes, with
a line through them; where messages are missing, a broken line says so. Altair draws (extra ``viz``).
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any
from warnings import catch_warnings, simplefilter

import altair as alt

from mmsverify.incident import GAP, Change, DeviceLine, Lane
from mmsverify.report.markup import COLOURS
from mmsverify.report.order import ordered
from mmsverify.report.picture import Picture
from mmsverify.report.wording import counted, instant, printable
from mmsverify.results import Finding

WIDTH, ROW, LETTER = 820, 19, 6.8
"""Points: the width of the lanes, the height of each, the width of a letter."""
NARROW = 1.0
"""Bars narrower than so many points are drawn together, as one that says how many they are."""
MOST_MARKS, MOST_LABEL_ROWS = 300, 4
"""Findings of a device that are marked, and rows that their names may take."""
MILLION = 1_000_000
Row = dict[str, Any]
PALETTE: Sequence[tuple[str, str]] = (
    (r"\|", "#e4e6eb"),  # one of several: not known which
    (r"INTERVENTION|UNRUNNABLE|NEEDS|NO-STATE|INOPERABLE|^Err|error", "#f2a49b"),
    (r"EXECUTING|RUNNING|^Run(Auto)?$|^run$", "#9ed3a4"),
    (r"STOP|PAUSE|^Stop", "#f4d28a"),
    (r"START|RESET|RESUM|^Home$|^Org$|Sub", "#bcd5f0"),
    (r"changes$", "#8d939c"),
)
AS_FINE_AS_NEEDED = "utcFormat(datum.value, utcmilliseconds(datum.value) ? '%H:%M:%S.%L' : '%H:%M:%S')"
OTHERS = "#dde7f2"
"""Colours of bars, by what their words look like; all of them bear dark letters."""


def timeline(devices: Sequence[DeviceLine], findings: Sequence[Finding], title: str = "timeline") -> Picture:
    """The devices' lanes with the findings among them, from the first message to the last."""
    if not devices:
        empty = alt.Chart(alt.InlineData(values=[{}]), title="no device in the recording").mark_text()
        return Picture(empty, title)
    begin = min(line.begin for line in devices)
    span = begin, max(begin + MILLION, *(line.end for line in devices))
    panels = [_panel(line, [f for f in findings if f.vmd == line.device], span) for line in devices]
    with catch_warnings():
        simplefilter("ignore", UserWarning)  # that all panels are moved by one selection is meant
        chart = alt.vconcat(*panels, spacing=18).resolve_scale(x="shared")
    chart = chart.configure_view(stroke="#ccd2da")
    chart = chart.configure_axis(grid=False, labelLimit=230, labelFontSize=11)
    return Picture(chart, title)


def _panel(
    line: DeviceLine, findings: Sequence[Finding], span: tuple[int, int]
) -> alt.LayerChart | alt.FacetChart:
    marks = list(_marks(findings, span))
    bars = [bar for lane in _lanes(line) for bar in _bars(lane, max(line.end, line.begin + 1), span)]
    above = sorted({mark["lane"] for mark in marks}, key=len)
    lanes = [*above, *dict.fromkeys(bar["lane"] for bar in bars)] or ["messages"]
    heading = alt.TitleParams(
        text=printable(line.device) or "?",
        subtitle=f"{line.model}, {counted(line.messages, 'message')}",
        anchor="start",
        frame="group",
    )
    layers = [*_bar_layers(bars, lanes, span), *_gap_layers(line), *_mark_layers(marks, lanes)]
    return alt.layer(*layers, title=heading).properties(width=WIDTH, height=ROW * len(lanes))


# Lanes and their bars.


def _lanes(line: DeviceLine) -> Iterator[Lane]:
    """The device's lanes; above them, those of its connections."""
    partners: dict[str, list[Change]] = {}
    for link in line.links:
        event, _, partner = link.words.partition(" ")
        said = {"open": "open", GAP: "open"}.get(event, "")
        partners.setdefault(partner, []).append(Change(link.index, link.time, said))
    for partner, changes in partners.items():
        yield Lane(f"connection {partner}", changes)
    yield from line.lanes


def _bars(lane: Lane, end: int, span: tuple[int, int]) -> Iterator[Row]:
    """The times in which a lane held a value; the shortest ones drawn together."""
    point = (span[1] - span[0]) / WIDTH
    ends = [*(change.time for change in lane.changes[1:]), end]
    rooms = _rooms(lane, span[1])
    crowd: list[tuple[Change, int]] = []
    for change, until, room in zip(lane.changes, ends, rooms, strict=True):
        if until - change.time < NARROW * point and len(lane.changes) > WIDTH // 4:
            crowd.append((change, until))
            continue
        yield from _together(lane, crowd, span)
        crowd = []
        if change.words:
            yield _bar(lane, change, until, printable(change.words), span=span, room=room)
    yield from _together(lane, crowd, span)


def _together(lane: Lane, crowd: Sequence[tuple[Change, int]], span: tuple[int, int]) -> Iterator[Row]:
    if crowd:
        yield _bar(lane, crowd[0][0], crowd[-1][1], f"{len(crowd)} changes", span=span)


def _rooms(lane: Lane, end: int) -> list[int]:
    """For each change of a lane, until when its word may be written: up to the next one that has words."""
    rooms: list[int] = []
    for change in reversed(lane.changes):
        rooms.append(end)
        end = change.time if change.words else end
    return rooms[::-1]


def _bar(lane: Lane, change: Change, end: int, words: str, *, span: tuple[int, int], room: int = 0) -> Row:
    letters = int((max(end, room) - change.time) / (span[1] - span[0]) * WIDTH / LETTER)
    return {
        "lane": printable(lane.name),
        "words": words,
        "begin": change.time / MILLION,
        "end": end / MILLION,
        "label": words if len(words) <= letters else f"{words[: letters - 1]}…" if letters > 3 else "",
        "colour": next((colour for like, colour in PALETTE if re.search(like, words)), OTHERS),
        "since": instant(change.time),
        "until": instant(end),
        "message": change.index,
    }


def _bar_layers(bars: Sequence[Row], lanes: Sequence[str], span: tuple[int, int]) -> list[alt.Chart]:
    zoom = alt.selection_interval(name="zoom", bind="scales", encodings=["x"])
    x = alt.X("begin:T", title="UTC").scale(type="utc", domain=[time / MILLION for time in span], nice=False)
    axis = alt.Axis(labelExpr=AS_FINE_AS_NEEDED, tickCount=8, labelOverlap=True, labelFlush=False)
    base = alt.Chart(alt.InlineData(values=list(bars))).encode(x=x.axis(axis), y=_lane(lanes))
    told = [alt.Tooltip(f"{name}:N") for name in ("lane", "words", "since", "until", "message")]
    drawn = base.mark_bar(height=ROW - 4, stroke="#ffffff", strokeWidth=0.5)
    drawn = drawn.encode(x2="end", color=alt.Color("colour:N").scale(None), tooltip=told)
    words = base.mark_text(align="left", dx=3, fontSize=10, color="#1d2733", clip=True)
    return [drawn.add_params(zoom), words.encode(text="label:N", tooltip=told)]


def _lane(lanes: Sequence[str]) -> alt.Y:
    return alt.Y("lane:N", title=None, sort=None).scale(domain=list(lanes))


# Gaps and findings.


def _gap_layers(line: DeviceLine) -> list[alt.Chart]:
    rows = [
        {"begin": gap.time / MILLION, "gap": printable(gap.words), "at": instant(gap.time)}
        for gap in line.gaps[:MOST_MARKS]
    ]
    if not rows:
        return []
    drawn = alt.Chart(alt.InlineData(values=rows)).encode(
        x=alt.X("begin:T"), tooltip=[alt.Tooltip("gap:N"), alt.Tooltip("at:N")]
    )
    word = drawn.mark_text(text="gap", angle=270, baseline="bottom", dx=0, dy=-2, fontSize=10, y=ROW)
    return [drawn.mark_rule(strokeDash=[3, 3], strokeWidth=3, color="#6b7280"), word]


def _marks(findings: Sequence[Finding], span: tuple[int, int]) -> Iterator[Row]:
    """The findings that have a time, with their names in rows in which none stands on another."""
    taken = [float("-inf")] * MOST_LABEL_ROWS
    timed = [found for found in ordered(findings) if found.time is not None]
    for found in sorted(timed, key=lambda found: found.time or 0)[:MOST_MARKS]:
        time = found.time or 0
        at = (time - span[0]) / (span[1] - span[0]) * WIDTH
        name = f"#{found.index} {found.rule}"
        room = len(name) * LETTER + 16
        left = at + room > WIDTH
        free = [row for row, until in enumerate(taken) if until <= (at - room if left else at)]
        row = free[0] if free else 0
        taken[row] = max(taken[row], at if left else at + room)
        yield _mark(found, time, printable(name) if free else "", left=left) | {
            "lane": "findings" + " " * row
        }


def _mark(found: Finding, time: int, name: str, *, left: bool) -> Row:
    return {
        "begin": time / MILLION,
        "label": name,
        "left": left,
        "colour": COLOURS[found.severity],
        "finding": printable(found.message),
        "rule": printable(found.rule),
        "clauses": " ".join(found.clauses),
        "at": instant(time),
        "message": found.index,
    }


def _mark_layers(marks: Sequence[Mapping[str, Any]], lanes: Sequence[str]) -> list[alt.Chart]:
    if not marks:
        return []
    told = [alt.Tooltip(f"{name}:N") for name in ("finding", "rule", "clauses", "at", "message")]
    drawn = alt.Chart(alt.InlineData(values=[dict(mark) for mark in marks])).encode(
        x=alt.X("begin:T"), color=alt.Color("colour:N").scale(None), tooltip=told
    )
    point = drawn.mark_point(shape="triangle-down", filled=True, size=70, opacity=1).encode(y=_lane(lanes))
    layers = [drawn.mark_rule(strokeWidth=1.4), point]
    for left in (True, False):
        word = drawn.mark_text(align="right" if left else "left", dx=-8 if left else 8, fontSize=11)
        side = alt.FieldEqualPredicate(field="left", equal=left)
        layers.append(word.encode(text="label:N", y=_lane(lanes)).transform_filter(side))
    return layers
