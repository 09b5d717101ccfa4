"""Messages around a finding as a sequence chart: clients at the left, the device at the right.

An answer is joined to its request by the bar on the device's line: so long was the request under way there.
"""

from __future__ import annotations

from collections.abc import Sequence, Set
from itertools import pairwise

from mmsverify.incident import CLIENT, Saying
from mmsverify.report.html.text import element, text
from mmsverify.report.wording import instant

STEP, TOP, LEFT = 30, 46, 210
"""Pixels: from message to message, above the first, and left of the first line."""
ACROSS, BETWEEN = 460, 130
"""Pixels from the last client's line to the device's, and between those of two clients."""
LETTERS, WIDE = 64, 100
"""Characters of a title, and of what a sample shows, for which there is room in the chart."""


def chart(said: Sequence[Saying], finding: int, related: Set[int]) -> str:
    """The chart of these messages; the one with the finding and those that led up to it are marked."""
    partners = sorted({each.partner for each in said if each.sender})
    at = {partner: LEFT + BETWEEN * number for number, partner in enumerate(partners)}
    device = LEFT + BETWEEN * (len(partners) - 1) + ACROSS if partners else LEFT
    width = device + 110 if partners else device + 7 * WIDE
    rows = _rows(said)
    height = TOP + STEP * (len(said) + len(_breaks(said))) + 10
    name = next((each.device for each in said if each.device), "device")
    parts = [_line(x, height, partner) for partner, x in at.items()] + [_line(device, height, name)]
    parts += [_bar(device, rows[each.answers], rows[each.index]) for each in said if each.answers in rows]
    parts += [_break(rows[index], missing, width) for index, missing in _breaks(said).items()]
    known: dict[str, str] = {}
    for each in said:
        y, new = rows[each.index], _news(each, known)
        mark = " finding" if each.index == finding else " related" if each.index in related else ""
        shown = _sent(each, y, at[each.partner], device) if each.sender else _beside(new, y, device)
        place = f'<text class="index" x="8" y="{y + 4}">{each.index}</text>'
        place += f'<text class="when" x="72" y="{y + 4}">{instant(each.time)[11:23]}</text>'
        parts.append(f'<g class="say{mark}">{element("title", text(_whole(each)))}{place}{shown}</g>')
    label = f"Sequence chart of {len(said)} messages around message {finding}"
    drawn = element(
        "svg", "\n".join(parts), class_="sequence", role="img", aria_label=label,
        viewBox=f"0 0 {width} {height}", width=width, height=height,
    )  # fmt: skip
    return element("div", drawn, class_="scroll", tabindex=0) + "\n"


def _breaks(said: Sequence[Saying]) -> dict[int, int]:
    """The messages before which others of the device are left out, with how many."""
    return {
        other.index: other.number - one.number - 1
        for one, other in pairwise(said)
        if other.number > one.number + 1
    }


def _rows(said: Sequence[Saying]) -> dict[int, int]:
    """How far down each message stands; above one, there may be room for those that are left out."""
    breaks, down = _breaks(said), TOP
    rows = {}
    for each in said:
        down += STEP if each.index in breaks else 0
        rows[each.index] = down
        down += STEP
    return rows


def _break(y: int, missing: int, width: int) -> str:
    at = y - STEP
    return (
        f'<line class="left-out" x1="8" x2="{width}" y1="{at}" y2="{at}"/>'
        f'<text class="left-out" x="72" y="{at + 4}">{missing} not shown</text>'
    )


def _line(x: int, height: int, name: str) -> str:
    shown = text(name if len(name) <= 18 else f"{name[:17]}...")
    return (
        f'<line class="life" x1="{x}" x2="{x}" y1="26" y2="{height}"/>'
        f'<text class="name" x="{x}" y="16" text-anchor="middle">{shown}</text>'
    )


def _bar(x: int, begin: int, end: int) -> str:
    return f'<rect class="served" x="{x - 4}" width="8" y="{begin}" height="{end - begin}"/>'


def _sent(each: Saying, y: int, partner: int, device: int) -> str:
    """An arrow from who sends it to who gets it."""
    title = f"{each.title}: {each.about}" if each.about else each.title
    title = title if len(title) <= LETTERS else f"{title[: LETTERS - 1]}..."
    begin, end = (partner, device) if each.sender == CLIENT else (device, partner)
    tip = end - 8 if end > begin else end + 8
    middle = (max(partner, device - ACROSS) + device) // 2
    return (
        f'<line class="arrow" x1="{begin}" x2="{tip}" y1="{y}" y2="{y}"/>'
        f'<path class="tip" d="M{end} {y} L{tip} {y - 4} L{tip} {y + 4} z"/>'
        f'<text x="{middle}" y="{y - 5}" text-anchor="middle">{text(title)}</text>'
    )


def _beside(new: str, y: int, device: int) -> str:
    """What nobody sends: a sample, or what happened to a connection."""
    shown = new if len(new) <= WIDE else f"{new[: WIDE - 1]}..."
    return (
        f'<rect class="beside" x="{device - 5}" y="{y - 5}" width="10" height="10"/>'
        f'<text x="{device + 14}" y="{y + 4}">{text(shown)}</text>'
    )


def _news(each: Saying, known: dict[str, str]) -> str:
    """What a sample shows that the one before did not; all of it for the first, nothing new said as such."""
    if each.sender or not each.fields:
        return f"{each.title} {each.partner}"
    new = [f"{name}={value}" for name, value in each.fields if known.get(name) != value]
    known.update(each.fields)
    return ", ".join(new) or "as before"


def _whole(each: Saying) -> str:
    values = "; ".join(f"{name} = {value}" for name, value in each.fields)
    return f"{instant(each.time)} {each.title} {each.fault or values}"
