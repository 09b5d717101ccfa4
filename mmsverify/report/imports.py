"""What an import took from captures, and what it could not read: text and JSON (``mmsverify.import/1``)."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

from mmsverify.report.wording import counted, printable

SCHEMA = "mmsverify.import/1"


class Unread(Protocol):
    """A frame, or a line of a table, that could not be read: ``packet`` counts from 1 (0: the whole file)."""

    @property
    def packet(self) -> int: ...
    @property
    def layer(self) -> str: ...
    @property
    def reason(self) -> str: ...


class Imported(Protocol):
    """What was found in one capture; ``pdus`` counts the messages taken, by kind."""

    @property
    def path(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def pdus(self) -> Mapping[str, int]: ...
    @property
    def undecoded(self) -> Sequence[Unread]: ...
    @property
    def remarks(self) -> Sequence[str]: ...


def render_json(inputs: Sequence[Imported]) -> str:
    told = [
        {
            "path": entry.path,
            "frames": entry.frames,
            "pdus": dict(entry.pdus),
            "undecoded": [
                {"packet": fault.packet, "layer": fault.layer, "reason": fault.reason}
                for fault in entry.undecoded
            ],
        }
        for entry in inputs
    ]
    return json.dumps({"schema": SCHEMA, "inputs": told}, indent=2, ensure_ascii=True) + "\n"


def render_text(inputs: Sequence[Imported]) -> str:
    return "".join(f"{line}\n" for entry in inputs for line in _lines(entry))


def _lines(entry: Imported) -> Iterator[str]:
    taken = ", ".join(f"{number} {kind}" for kind, number in entry.pdus.items() if number) or "no"
    unread = f"; {len(entry.undecoded)} undecoded" if entry.undecoded else ""
    if entry.pdus.get("vr"):
        yield f"{printable(entry.path)}: {counted(entry.pdus['vr'], 'VR sample')}{unread}"
    else:
        yield f"{printable(entry.path)}: {counted(entry.frames, 'frame')}, {taken} PDUs{unread}"
    yield from (f"  {printable(remark)}" for remark in entry.remarks)
    for fault in entry.undecoded:
        unit = "line" if fault.layer == "csv" else "packet"
        place = f"{unit} {fault.packet}" if fault.packet else "whole file"
        yield f"  {place}  {printable(fault.layer)}  {printable(fault.reason)}"
