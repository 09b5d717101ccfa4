"""Options that cannot be honoured as they are given: one line, and nothing is done."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.errors import UsageError

ELSEWHERE = "is on another machine, where nothing is written (give a path of this one)"
EMPTY = "is empty (give a path, or leave it out)"


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (["audit", "a.mcap", "-o", "http://me:geheim@h/x"], f"-o: http://me:***@h/x {ELSEWHERE}"),
        (["audit", "a.mcap", "-o", "s3://b/x", "--format", "parquet"], f"-o: s3://b/x {ELSEWHERE}"),
        (["audit", "a.mcap", "-o", ""], f"-o: {EMPTY}"),
        (["audit", "a.mcap", "--resume", ""], f"--resume: {EMPTY}"),
        (["audit", "a.mcap", "--resume", "http://h/x"], f"--resume: http://h/x {ELSEWHERE}"),
        (["audit", "a.mcap", "--annotate", ""], f"--annotate: {EMPTY}"),
        (["check", "--counterexamples", ""], f"--counterexamples: {EMPTY}"),
        (["diagram", "mms-robot", "-o", "http://h/x"], f"-o: http://h/x {ELSEWHERE}"),
        (["import", "a.pcap", "-o", ""], f"-o: {EMPTY}"),
        (["record", "modbus", "h:1", "--map", "m", "-o", "http://h/x"], f"-o: http://h/x {ELSEWHERE}"),
        (
            ["audit", "a.mcap", "--kernel", "--no-kernel"],
            "--kernel: not with --no-kernel (leave out one of them)",
        ),
        (
            ["audit", "a.mcap", "--no-kernel", "--kernel"],
            "--kernel: not with --no-kernel (leave out one of them)",
        ),
        (
            ["audit", "a.mcap", "--engine", "dask", "--scheduler", ""],
            "--scheduler: is empty (give an address, or local)",
        ),
        (["audit", ""], "an input is an empty text (name a file, a folder, a pattern or a URL)"),
    ],
)
def test_what_cannot_be_honoured_is_one_line(
    arguments: list[str],
    told: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(arguments) == 2
    assert capsys.readouterr() == ("", f"mmsverify: {told}\n")
    assert [*tmp_path.iterdir()] == []


@pytest.mark.parametrize("given", ["", [""]])
def test_an_empty_text_is_no_folder(given: str | list[str]) -> None:
    with pytest.raises(UsageError, match="an input is an empty text"):
        audit_traces(given, profile=None, model=None)
