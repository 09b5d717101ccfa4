"""Timelines of devices as SVG: a lane an attribute, findings and gaps as marks.

Places are percentages, so that the picture fills its room without a script. Each part also says which share
of the time it takes; the page's script zooms by that. Long timelines are thinned out: what is too short to be
seen becomes one part that says how much happened there.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from zlib import crc32

from mmsverify.incident import Change, DeviceLine, Lane
from mmsverify.report.html.numbered import Numbered
from mmsverify.report.html.text import clock, element, text
from mmsverify.report.wording import counted, instant

HEIGHT, LANE = 20, 24
"""Pixels: of a part, and from lane to lane."""
MOST_PARTS = 600
"""Parts of one lane; what is shorter than so small a share of the time is not drawn by itself."""
MOST_MARKS = 400
LETTER, WIDTH = 6.2, 1000
"""Pixels: of a letter, and of a usual timeline."""
COLOURS = 8
TELLING = {
    "ROBOT-EXECUTING": "runs", "RUNNING": "runs", "STARTING": "moves", "RESUMING": "moves", "Run": "runs",
    "RunAuto": "runs", "ROBOT-READY": "ready", "ROBOT-LOADED": "waits", "IDLE": "waits",
    "ROBOT-IDLE": "waits",
    "Idle": "waits", "ROBOT-MOTION-PAUSED": "paused", "STOPPED": "paused", "STOPPING": "moves",
    "RESETTING": "moves", "UNRUNNABLE": "bad", "MANUAL-INTERVENTION-REQUIRED": "bad", "OPERATIONAL": "ready",
    "STATE-CHANGES-ALLOWED": "ready", "none": "waits", "FALSE": "waits", "TRUE": "runs",
    "NON-EXISTENT": "gone",
}  # fmt: skip
"""Colours that mean something; all other words have one by their letters."""


@dataclass(frozen=True, slots=True)
class Part:
    """From ``begin`` to ``end`` (ns), ``words`` hold, or so many ``changes`` are drawn as one part."""

    begin: int
    end: int
    words: str
    index: int
    changes: int = 1


def timeline(line: DeviceLine, findings: Sequence[Numbered]) -> str:
    """The timeline of one device with the findings that are its own."""
    span = max(line.end - line.begin, 1)
    lanes = [lane for lane in line.lanes if lane.changes]
    rows = [_marks(line, findings, span), *(_lane(lane, line, span) for lane in lanes)]
    names = ["findings", *(lane.name for lane in lanes)]
    labels = "".join(element("div", text(name), class_="lane-name") for name in names)
    height = LANE * len(rows)
    drawn = "".join(f'<g transform="translate(0 {LANE * n})">{row}</g>\n' for n, row in enumerate(rows))
    gaps = "".join(_gap(gap, line.begin, span, height) for gap in line.gaps[:MOST_MARKS])
    picture = element(
        "svg", gaps + drawn, class_="lanes", role="img", height=height, width="100%",
        aria_label=f"Timeline of {line.device}",
    )  # fmt: skip
    about = f"{counted(line.messages, 'message')}, {counted(len(line.gaps), 'gap')}"
    ends = "".join(f"<span>{clock(_whole(line.begin + span * quarter // 4))}</span>" for quarter in range(5))
    inside = (
        f'<div class="lane-names">{labels}</div>'
        f'<div class="lanes-window" tabindex="0" role="group" aria-label="Timeline: plus and minus zoom, '
        f'arrows move, 0 shows all">{picture}</div>'
    )
    below = f'<p class="ends">{ends}</p><p class="key">{about}</p>'
    return element(
        "div", f'<div class="lanes-box">{inside}</div>{below}', class_="timeline",
        data_begin=line.begin, data_end=line.end,
    ) + "\n"  # fmt: skip


def _whole(time: int) -> int:
    """To the millisecond: the axis is no finer."""
    return time // 1_000_000 * 1_000_000


def _lane(lane: Lane, line: DeviceLine, span: int) -> str:
    return "".join(
        _part(part, line.begin, span) for part in thinned(lane.changes, line.end, max(span // MOST_PARTS, 1))
    )


def thinned(changes: Sequence[Change], end: int, least: int) -> Iterator[Part]:
    """The parts of a lane; of several that are shorter than ``least`` (ns), one together."""
    ends = [*(change.time for change in changes[1:]), end]
    some: list[Part] = []
    for change, until in zip(changes, ends, strict=True):
        part = Part(change.time, until, change.words, change.index)
        if some and (until - change.time >= least or until - some[0].begin >= least):
            yield _together(some)
            some = []
        if until - change.time >= least:
            yield part
        else:
            some.append(part)
    if some:
        yield _together(some)


def _together(some: Sequence[Part]) -> Part:
    if len(some) == 1:
        return some[0]
    return Part(some[0].begin, some[-1].end, f"{len(some)} changes", some[0].index, len(some))


def _part(part: Part, begin: int, span: int) -> str:
    if not part.words:
        return ""
    at, wide = (part.begin - begin) / span, max(part.end - part.begin, 0) / span
    title = element("title", f"{text(part.words)} from message {part.index}, {instant(part.begin)}")
    shape = f'<rect class="{_colour(part)}" width="100%" height="{HEIGHT}"/>'
    return (
        f'<svg class="part{_tight(part.words, wide)}" {_place(at, wide)} height="{HEIGHT}">{title}{shape}'
        f'<text x="3" y="14">{text(part.words)}</text></svg>'
    )


def _tight(words: str, wide: float) -> str:
    """Whether there is no room for the words: then they are read by pointing at the part."""
    return " tight" if LETTER * len(words) > wide * WIDTH else ""


def _place(at: float, wide: float) -> str:
    """Where something is: by percentages, and as shares for the script."""
    return f'x="{at:.4%}" width="{max(wide, 0.0005):.4%}" data-at="{at:.7f}" data-wide="{wide:.7f}"'


def _colour(part: Part) -> str:
    if part.changes > 1:
        return "many"
    if " | " in part.words:
        return "either"
    return TELLING.get(part.words) or f"c{crc32(part.words.encode()) % COLOURS}"


def _gap(gap: Change, begin: int, span: int, height: int) -> str:
    at = (gap.time - begin) / span
    title = element("title", f"messages missing before {instant(gap.time)}: {text(gap.words)}")
    shape = f'<rect width="100%" height="{height}"/>'
    return f'<svg class="gap" {_place(at, 0.003)} height="{height}">{title}{shape}</svg>'


def _marks(line: DeviceLine, findings: Iterable[Numbered], span: int) -> str:
    """The findings at their instants; those that would stand on each other are one mark."""
    timed = [each for each in findings if each.finding.time is not None]
    bins: dict[int, list[Numbered]] = {}
    for each in timed:
        bins.setdefault(((each.finding.time or 0) - line.begin) * MOST_MARKS // span, []).append(each)
    return "".join(_mark(some, line.begin, span) for some in bins.values())


def _mark(some: Sequence[Numbered], begin: int, span: int) -> str:
    first = some[0]
    at = ((first.finding.time or begin) - begin) / span
    severity = next(s for s in ("error", "warning", "note") if any(e.finding.severity == s for e in some))
    told = re.sub(r"\s+", " ", first.finding.message)
    more = f", and {len(some) - 1} more" if len(some) > 1 else ""
    title = element("title", f"{text(told)}{more}")
    label = f"finding {first.number}{more}"
    return (
        f'<a href="#{first.anchor}" class="mark {severity}" aria-label="{label}">'
        f'<svg {_place(at, 0.0)} overflow="visible" class="pin">{title}'
        f'<path d="M-6 3 h12 l-6 14 z"/><text x="8" y="14">#{first.number}</text></svg></a>'
    )
