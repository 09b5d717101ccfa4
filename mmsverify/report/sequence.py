"""What was said, as a sequence chart: clients on the left, the device on the right, one message a row.

An arrow goes from who says it to whom it is said; a bar at who answers joins a request and its answer.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from typing import Any

import altair as alt

from mmsverify.incident import CLIENT, Saying
from mmsverify.report.carried import carried
from mmsverify.report.markup import COLOURS
from mmsverify.report.picture import Picture
from mmsverify.report.wording import instant, printable
from mmsverify.results import Finding

WIDTH, ROW, TIMES = 640, 24, 0.46
"""Points: the width and the height of a row; how far left of the first line the times stand, in columns."""
INK, LINE = "#2f5d83", "#9aa5b1"
LONGEST, MOST_VALUES, MOST_OCTETS = 46, 3, 64
"""Letters beside a title, values among them, and octets that are shown."""
Row = dict[str, Any]


def sequence(
    sayings: Sequence[Saying], findings: Sequence[Finding], title: str, *, apart: int = 0
) -> Picture:
    """The messages of one device in their order; those with findings in the colour of the worst one.

    Before and after each of the first ``apart`` messages others of the device may be left out.
    """
    columns = _columns(sayings)
    worst = {f.index: f for f in sorted(findings, key=lambda f: f.severity != "error", reverse=True)}
    rows = [
        _row(at, said, _carried(said, sayings[:at]), columns, worst.get(said.index))
        for at, said in enumerate(sayings)
    ]
    layers = [*_lifelines(columns, sayings), *_pairs(rows, sayings), *_messages(rows)]
    layers += _skips(sayings, apart)
    chart = alt.layer(*layers).properties(width=WIDTH, height=ROW * (len(rows) + 1))
    return Picture(chart.configure_view(stroke=None), title)


def _columns(sayings: Sequence[Saying]) -> dict[str, int]:
    """Where the lines of the partners stand, from the left; the device's is the last, of no name."""
    partners = list(dict.fromkeys(said.partner for said in sayings if said.sender))
    return {name: at for at, name in enumerate([*partners, ""])} if partners else {"": 1}


def _row(at: int, said: Saying, carried: str, columns: Mapping[str, int], found: Finding | None) -> Row:
    device = columns[""]
    partner = columns.get(said.partner, device) if said.sender else device
    begin, end = (partner, device) if said.sender == CLIENT else (device, partner)
    shown = f"{said.title} {carried}".strip()
    return {
        "row": at,
        "from": begin,
        "to": end,
        "middle": (partner + device) / 2 if said.sender else device - 0.5,
        "alone": not said.sender,
        "right": end > begin,
        "said": printable(shown),
        "time": instant(said.time)[11:23],
        "index": f"#{said.index}",
        "colour": COLOURS[found.severity] if found else INK,
        "found": printable(found.message) if found else "",
        "at": instant(said.time),
        "carries": printable(", ".join(f"{name} = {value}" for name, value in said.fields)),
        "octets": said.octets[:MOST_OCTETS].hex(" ") + (" ..." if len(said.octets) > MOST_OCTETS else ""),
        "fault": printable(said.fault),
    }


def _carried(said: Saying, before: Sequence[Saying]) -> str:
    """What a message is about, or its first values; of a sample, what has changed; cut off if long."""
    held = [pair for last in before[-1:] for pair in last.fields]
    told = carried(said, held=held)[:MOST_VALUES]
    named = [value if said.sender else f"{name} = {value}" for name, value in told if value]
    text = said.fault or said.about or ", ".join(named)
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"


# What is drawn.


def _y(field: str = "row:Q") -> alt.Y:
    return alt.Y(field, axis=None)


def _x(field: str, columns: int) -> alt.X:
    return alt.X(field, axis=None).scale(domain=[-TIMES, columns + 0.1], nice=False)


def _lifelines(columns: Mapping[str, int], sayings: Sequence[Saying]) -> Iterator[alt.Chart]:
    last, rows = columns[""], len(sayings)
    device = next((said.device for said in sayings if said.device), "device")
    lines = [
        {"x": at, "top": -0.7, "bottom": rows - 0.3, "name": printable(name or device)}
        for name, at in columns.items()
    ]
    base = alt.Chart(alt.InlineData(values=lines)).encode(x=_x("x:Q", last))
    y = alt.Y("top:Q", axis=None).scale(domain=[rows - 0.3, -1.5], nice=False)
    yield base.mark_rule(color=LINE, strokeWidth=1.2).encode(y=y, y2="bottom:Q")
    yield base.mark_text(fontWeight="bold", baseline="bottom", dy=-3).encode(y=y, text="name:N")


def _pairs(rows: Sequence[Row], sayings: Sequence[Saying]) -> Iterator[alt.Chart]:
    at = {said.index: row for said, row in zip(sayings, rows, strict=True)}
    bars = [
        {"x": at[said.answers]["to"], "begin": at[said.answers]["row"], "end": row["row"]}
        for said, row in zip(sayings, rows, strict=True)
        if said.answers in at
    ]
    if bars:
        drawn = alt.Chart(alt.InlineData(values=bars)).mark_rule(color="#b9cfe2", strokeWidth=8, opacity=0.9)
        yield drawn.encode(x=alt.X("x:Q"), y=_y("begin:Q"), y2="end:Q")


def _messages(rows: Sequence[Row]) -> Iterator[alt.Chart]:
    names = ("index", "at", "said", "found", "carries", "octets", "fault")
    told = [alt.Tooltip(f"{name}:N") for name in names]
    base = alt.Chart(alt.InlineData(values=list(rows))).encode(
        y=_y(), color=alt.Color("colour:N").scale(None), tooltip=told
    )
    spoken = base.transform_filter(alt.FieldEqualPredicate(field="alone", equal=False))
    words: Row = {"baseline": "bottom", "dy": -2, "fontSize": 11}
    halo = alt.Chart(alt.InlineData(values=[row for row in rows if not row["alone"]])).encode(y=_y())
    halo = halo.mark_text(**words, stroke="#ffffff", strokeWidth=4)
    # Under the arrows, and over the lines of others.
    yield halo.encode(x=alt.X("middle:Q"), text="said:N")
    yield spoken.mark_rule(strokeWidth=1.5).encode(x=alt.X("from:Q"), x2="to:Q")
    for right in (True, False):
        side = spoken.transform_filter(alt.FieldEqualPredicate(field="right", equal=right))
        shape, aside = ("triangle-right", -5) if right else ("triangle-left", 5)
        head = side.mark_point(shape=shape, filled=True, size=70, opacity=1, xOffset=aside)
        yield head.encode(x=alt.X("to:Q"))
    alone = base.transform_filter(alt.FieldEqualPredicate(field="alone", equal=True))
    yield alone.mark_point(filled=True, size=40, opacity=1).encode(x=alt.X("to:Q"))
    yield spoken.mark_text(**words).encode(x=alt.X("middle:Q"), text="said:N")
    yield alone.mark_text(align="right", dx=-8, fontSize=11).encode(x=alt.X("to:Q"), text="said:N")
    left = base.mark_text(align="left", fontSize=10).encode(x=alt.datum(-TIMES))
    yield left.encode(text="time:N")
    yield left.mark_text(align="left", fontSize=10, dx=74).encode(text="index:N")


def _skips(sayings: Sequence[Saying], apart: int) -> Iterator[alt.Chart]:
    """Where time passes unseen: messages of the device between two that are shown are left out."""
    rows = [
        {"row": at + 0.42}
        for at, (said, after) in enumerate(pairwise(sayings[: apart + 1]))
        if after.index > said.index + 1
    ]
    if rows:
        drawn = alt.Chart(alt.InlineData(values=rows)).mark_rule(strokeDash=[2, 4], color=LINE)
        yield drawn.encode(y=_y())
