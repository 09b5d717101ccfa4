"""The messages of a recording in words, those alone that are asked for; and the same part of a timeline."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace

from mmsverify.audit.saying import Reader
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.incident import Change, DeviceLine, Saying

LEAD = 60_000_000_000
"""So many ns before the first message that is asked for, requests are listened to."""
SAMPLE = "sample"


def messages(path: str, begin: int | None, end: int | None, device: str | None) -> Iterator[Saying]:
    """The messages from ``begin`` to ``end`` (ns, both included) of one device, or of all, in event order.

    Of a sample of cells there are those fields alone that have changed.
    """
    reader = Reader()
    held: dict[str, dict[str, str]] = {}
    for message in read_trace(path):
        if end is not None and message.time > end:
            return
        early = begin is not None and message.time < begin
        if (early and begin is not None and message.time < begin - LEAD) or not _of(message, device):
            continue
        said = _changed(reader.saying(message), held)
        if not early:
            yield said


def _of(message: TraceMessage, device: str | None) -> bool:
    names = message.metadata
    return device is None or device in (names.get("vmd"), names.get("controller"), names.get("name"))


def _changed(said: Saying, held: dict[str, dict[str, str]]) -> Saying:
    if said.title != SAMPLE:
        return said
    known = held.setdefault(said.device, {})
    fields = tuple((name, value) for name, value in said.fields if known.get(name) != value)
    known.update(said.fields)
    return replace(said, fields=fields)


def narrowed(line: DeviceLine, begin: int | None, end: int | None) -> DeviceLine:
    """What is known of a device from ``begin`` to ``end`` (ns); what was known before goes on."""
    if begin is None and end is None:
        return line
    first = line.begin if begin is None else max(begin, line.begin)
    last = line.end if end is None else min(end, line.end)
    lanes = [replace(lane, changes=_part(lane.changes, first, last)) for lane in line.lanes]
    shown = [lane for lane in lanes if lane.changes]
    links = _linked(line.links, first, last)
    return replace(line, begin=first, end=max(first, last), lanes=shown, links=links)


def _part(changes: Sequence[Change], begin: int, end: int) -> list[Change]:
    before = [change for change in changes if change.time <= begin][-1:]
    within = [change for change in changes if begin < change.time <= end]
    return [replace(change, time=begin) for change in before] + within


def _linked(links: Sequence[Change], begin: int, end: int) -> list[Change]:
    partners = dict.fromkeys(link.words.partition(" ")[2] for link in links)
    kept = []
    for partner in partners:
        own = [link for link in links if link.words.partition(" ")[2] == partner]
        earlier = [link for link in own if link.time < begin and not link.words.startswith("gap")][-1:]
        kept += [replace(link, time=begin) for link in earlier]
        kept += [link for link in own if begin <= link.time <= end]
    return sorted(kept, key=lambda link: (link.time, link.index))
