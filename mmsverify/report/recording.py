"""What a recording holds, and what on the wire could not be read: text and JSON (``mmsverify.record/1``)."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from typing import Protocol

from mmsverify.report.wording import counted, printable

SCHEMA = "mmsverify.record/1"


class Unread(Protocol):
    """Something that could not be read, and how often; ``connection`` as the trace names it."""

    @property
    def connection(self) -> str: ...
    @property
    def layer(self) -> str: ...
    @property
    def reason(self) -> str: ...
    @property
    def count(self) -> int: ...


class Recording(Protocol):
    """What was recorded; ``pdus`` counts the messages by kind, ``refused`` the clients turned away."""

    @property
    def connections(self) -> int: ...
    @property
    def pdus(self) -> Mapping[str, int]: ...
    @property
    def refused(self) -> int: ...
    @property
    def undecoded(self) -> Sequence[Unread]: ...
    @property
    def broken(self) -> str: ...


def render_json(path: str, recorded: Recording) -> str:
    told = {
        "schema": SCHEMA,
        "path": path,
        "connections": recorded.connections,
        "refused": recorded.refused,
        "pdus": dict(recorded.pdus),
        "undecoded": [
            {
                "connection": each.connection,
                "layer": each.layer,
                "reason": each.reason,
                "count": each.count,
            }
            for each in recorded.undecoded
        ],
        "broken": recorded.broken,
    }
    return json.dumps(told, indent=2, ensure_ascii=True) + "\n"


def render_text(path: str, recorded: Recording) -> str:
    return "".join(f"{line}\n" for line in _lines(path, recorded))


def _lines(path: str, recorded: Recording) -> Iterator[str]:
    kinds = {"mms": "MMS PDU", "modbus": "Modbus ADU", "vr": "VR sample"}
    taken = [counted(number, kinds[kind]) for kind, number in recorded.pdus.items() if number]
    yield f"{printable(path)}: {counted(recorded.connections, 'connection')}, {', '.join(taken) or 'nothing'}"
    if recorded.refused:
        yield f"  {counted(recorded.refused, 'client')} turned away: the server could not be reached"
    for each in recorded.undecoded:
        times = f"  ({each.count} times)" if each.count > 1 else ""
        yield f"  {printable(each.connection)}  {printable(each.layer)}  {printable(each.reason)}{times}"
