"""The logs of the benchmarks are what they are said to be: conforming, faulty, or ever new."""

from __future__ import annotations

from collections.abc import Iterator
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.formats import mms
from mmsverify.formats.mcap import read_trace
from mmsverify.samples.cell import Cell
from mmsverify.samples.recording import Recording

BENCH = Path(__file__).parents[2] / "bench"
COUNT, LONGER = 300, 600
NAMES = (
    "routine", "mid-operation", "diverse", "VR, scan", "VR, polled", "Modbus, polls",
)  # fmt: skip


@pytest.fixture(autouse=True)
def _found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.syspath_prepend(str(BENCH))


def written(name: str, folder: Path, count: int = COUNT) -> Path:
    path = folder / "log.mcap"
    import_module("logs").LOGS[name].write(path, count)
    return path


def said(path: Path) -> Iterator[tuple[Any, bytes]]:
    for message in read_trace(path):
        if message.message_encoding == "mms-ber":
            yield mms.decode(message.data), message.data


@pytest.mark.parametrize("name", NAMES)
def test_nothing_but_notes_is_found_in_a_log_that_is_clean(name: str, tmp_path: Path) -> None:
    audit = audit_traces([written(name, tmp_path)], profile=None, model=None)
    assert import_module("logs").LOGS[name].clean
    assert [one.rule for one in audit.findings if one.severity != "note"] == []
    assert audit.inputs[0].messages >= COUNT


def test_faults_are_found_all_the_time(tmp_path: Path) -> None:
    audit = audit_traces([written("faulty", tmp_path, LONGER)], profile=None, model=None)
    places = sorted({one.index for one in audit.findings if one.index is not None})
    assert len({one.rule for one in audit.findings}) >= 5
    assert all(later - earlier <= 100 for earlier, later in pairwise(places))


def test_every_message_of_the_diverse_log_is_another(tmp_path: Path) -> None:
    octets = [data for _, data in said(written("diverse", tmp_path))]
    assert len(set(octets)) == len(octets)


def test_the_diverse_log_has_less_than_a_thousand_classes_of_events() -> None:
    rendering, batches = import_module("rendering"), import_module("batches")
    cell = batches.Logger(Recording("weld1"))
    lines = [*rendering.script(cell, *batches.BEGINNING), *rendering.script(cell, batches.diverse)]
    classes = {(line.channel.topic, line.heads, line.rest, line.fills) for line in lines}
    assert len(classes) * 4 < 1000  # an invokeID has one to four octets


def test_invoke_ids_of_the_diverse_log_run_through_all_that_there_are(tmp_path: Path) -> None:
    found = {pdu.invoke_id for pdu, _ in said(written("diverse", tmp_path)) if pdu.invoke_id is not None}
    assert min(found) < 1 << 24
    assert max(found) > 1 << 30


def test_what_is_written_again_differs_in_its_invoke_id_only(tmp_path: Path) -> None:
    cell = Cell(Recording("weld1"))
    rendering, shift = import_module("rendering"), import_module("batches").routine
    lines = rendering.script(cell, shift)
    path = tmp_path / "twice.mcap"
    with import_module("logs").TraceWriter(path) as trace:
        player = rendering.Player(trace, stride=40_000)
        player.play(lines)
        player.play(lines)
    told = [mms.decode(octets) for _, _, octets in cell.recording.messages]
    again = [pdu for pdu, _ in said(path)]
    bare = [(pdu.kind, pdu.service, pdu.body, pdu.detail) for pdu in again]
    assert bare == 2 * [(pdu.kind, pdu.service, pdu.body, pdu.detail) for pdu in told]
    requests = [pdu.invoke_id for pdu in again if pdu.kind == "confirmed-RequestPDU"]
    assert len(set(requests)) == len(requests)
    answers = [pdu.invoke_id for pdu in again if pdu.kind == "confirmed-ResponsePDU"]
    assert answers == requests
