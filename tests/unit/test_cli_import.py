"""``mmsverify import``: what it passes on, prints and leaves behind. The capture reader is replaced here."""

from __future__ import annotations

import json
import sys
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

from mmsverify.cli import main
from mmsverify.errors import InputError
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.report import render_import


@dataclass(frozen=True)
class Ports:
    mms: frozenset[int] = frozenset({102})
    modbus: frozenset[int] = frozenset({502})


@dataclass(frozen=True)
class Fault:
    packet: int
    layer: str
    reason: str


@dataclass(frozen=True)
class Read:
    path: str = "line.pcap"
    frames: int = 22
    pdus: Mapping[str, int] = field(default_factory=lambda: {"mms": 8, "modbus": 0, "vr": 0})
    undecoded: tuple[Fault, ...] = (Fault(10, "session", "cut\x1b[2J"), Fault(0, "file", "cut off"))
    remarks: tuple[str, ...] = ()


@pytest.fixture
def calls(monkeypatch: pytest.MonkeyPatch) -> list[dict[str, Any]]:
    """The calls of a reader that finds the same in every capture."""
    made: list[dict[str, Any]] = []

    def import_captures(paths: list[Path], writer: TraceWriter, **options: Any) -> list[Read]:
        made.append({"paths": paths, "written": writer.count, **options})
        if any("bad" in path.name for path in paths):
            raise InputError("is no capture", place=str(paths[0]))
        return [Read()]

    module = ModuleType("mmsverify.formats.capture")
    vars(module).update(Ports=Ports, import_captures=import_captures)
    monkeypatch.setitem(sys.modules, module.__name__, module)
    return made


def test_a_capture_becomes_a_trace_and_a_report(
    calls: list[dict[str, Any]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.mcap"
    assert main(["import", "line.pcap", "-o", str(out)]) == 0
    printed = capsys.readouterr()
    assert printed.out.splitlines() == [
        "line.pcap: 22 frames, 8 mms PDUs; 2 undecoded",
        "  packet 10  session  cut\\x1b[2J",
        "  whole file  file  cut off",
    ]
    assert printed.err == f"wrote {out}\n"
    assert [path.name for path in tmp_path.iterdir()] == ["out.mcap"]
    assert out.read_bytes().startswith(b"\x89MCAP0\r\n")
    assert len(calls) == 1


def test_the_report_as_json_has_the_keys_of_its_schema() -> None:
    assert json.loads(render_import([Read(undecoded=(Fault(10, "session", "cut"),))], "json")) == {
        "schema": "mmsverify.import/1",
        "inputs": [
            {
                "path": "line.pcap",
                "frames": 22,
                "pdus": {"mms": 8, "modbus": 0, "vr": 0},
                "undecoded": [{"packet": 10, "layer": "session", "reason": "cut"}],
            }
        ],
    }


def test_ports_and_names_are_passed_on(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    ports = ["--mms-port", "10102", "--modbus-port", "1502", "--modbus-port", "1503"]
    names = ["--name", "10.0.0.5=cell7", "--name", "fe80::1=cell8"]
    assert main(["import", "a.pcap", "-o", str(tmp_path / "out.mcap"), "-q", *ports, *names]) == 0
    assert calls[0]["ports"] == Ports(frozenset({102, 10102}), frozenset({502, 1502, 1503}))
    assert calls[0]["hosts"] == {"10.0.0.5": "cell7", "fe80::1": "cell8"}


def test_a_folder_stands_for_its_captures(calls: list[dict[str, Any]], tmp_path: Path) -> None:
    for name in ("b.pcapng", "a.pcap", "a.mcap", "readme.txt"):
        (tmp_path / name).touch()
    main(["import", str(tmp_path), "-o", str(tmp_path / "out.mcap")])
    assert calls[0]["paths"] == [tmp_path / "a.pcap", tmp_path / "b.pcapng"]


def test_a_failed_import_leaves_no_file_and_spares_the_old_one(
    calls: list[dict[str, Any]], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out.mcap"
    out.write_bytes(b"of yesterday")
    assert main(["import", "bad.pcap", "-o", str(out)]) == 2
    assert capsys.readouterr().err == "mmsverify: bad.pcap: is no capture\n"
    assert [path.name for path in tmp_path.iterdir()] == ["out.mcap"]
    assert out.read_bytes() == b"of yesterday"
    assert calls[0]["written"] == 0


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (["a.pcap"], "missing option '-o' / '--output'"),
        (["a.pcap", "-o", "out.mcap", "--name", "cell7"], "--name: cannot read 'cell7'"),
        (["a.pcap", "-o", "out.mcap", "--name", "10.0.0.5=a/b"], "--name: cannot read '10.0.0.5=a/b'"),
        (["a.pcap", "-o", "out.mcap", "--mms-port", "70000"], "invalid value for '--mms-port'"),
        (
            ["a.pcap", "-o", "out.mcap", "--format", "html"],
            "--format: no format 'html' here (one of text, json)",
        ),
        (["a.pcap", "-o", "/nowhere/out.mcap"], "/nowhere/out.mcap: its folder does not exist"),
    ],
)
def test_a_bad_request_is_one_line_and_status_2(
    arguments: list[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["import", *arguments]) == 2
    assert capsys.readouterr().err.startswith(f"mmsverify: {line}")
