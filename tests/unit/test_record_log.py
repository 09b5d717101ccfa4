"""The trace in the making: whatever goes wrong with it, the traffic goes on."""

from __future__ import annotations

import errno
import io
from typing import Any

import pytest

from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.mcap import TraceWriter
from mmsverify.recording import Log

ASKED = bytes.fromhex("000100000006010100000008")
ANSWERED = bytes.fromhex("000100000004010101ff")


class Full(io.BytesIO):
    """A disk on which nothing fits any more after the first ``room`` octets."""

    room = 400

    def write(self, octets: Any, /) -> int:
        if self.tell() + len(octets) > self.room:
            raise OSError(errno.ENOSPC, "No space left on device")
        return super().write(octets)


def test_a_full_disk_ends_the_recording_and_not_the_traffic() -> None:
    log = Log(TraceWriter(Full(), compress=False), "cell7")
    live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
    for _ in range(100):
        live.data("client", ASKED)
        log.flush()
    live.end("close")
    recorded = log.end()
    assert recorded.broken == "No space left on device"
    assert 0 < recorded.pdus["modbus"] < 100


def test_a_fault_of_a_reader_is_told_and_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> list[bytes]:
        raise ZeroDivisionError("never so")

    log = Log(TraceWriter(io.BytesIO()), "cell7")
    live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
    monkeypatch.setattr(live.talk.reader, "feed", fails)
    live.data("client", ASKED)
    monkeypatch.undo()
    live.data("client", ASKED)
    recorded = log.end()
    assert [(each.layer, each.reason) for each in recorded.undecoded] == [
        ("recording", "ZeroDivisionError: never so")
    ]
    assert recorded.pdus["modbus"] == 1


def test_names_are_used_again_so_that_a_recorder_may_run_for_years() -> None:
    log = Log(TraceWriter(io.BytesIO(), indexed=False), "cell7")
    names = []
    for _ in range(70_000):
        live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
        names.append(live.talk.name)
        live.end("close")
    assert set(names) == {"c1"}
    assert log.end().broken == ""


def test_any_fault_of_the_writer_ends_the_recording_and_not_the_traffic(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def fails(*_: object) -> None:
        raise MemoryError("no more")

    writer = TraceWriter(io.BytesIO())
    log = Log(writer, "cell7")
    live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
    monkeypatch.setattr(writer, "flush", fails)
    log.flush()
    live.data("client", ASKED)
    live.end("close")
    assert log.end().broken == "no more"
