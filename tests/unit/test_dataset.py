"""Results of a fleet as Parquet: what is read back is what JSON tells, and nobody's folder is harmed."""

from __future__ import annotations

import json
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pyarrow.parquet as pq
import pytest
from fleets import recordings, timeless
from report_samples import AUDIT, CLEAN, HOSTILE, SELECT, START, UNREADABLE

from mmsverify.cli import main
from mmsverify.commands import dataset
from mmsverify.commands.dataset import MARK, Dataset
from mmsverify.results import Audit


def plain(value: Any) -> Any:
    """A cell as JSON has it."""
    if isinstance(value, pd.Timestamp):
        return value.value
    if hasattr(value, "tolist"):
        return value.tolist()
    return None if pd.isna(value) else value


def rows(folder: Path) -> list[dict[str, Any]]:
    records = pd.read_parquet(folder).to_dict("records")
    return [{str(name): plain(value) for name, value in record.items()} for record in records]


def written(folder: Path, *audits: Audit) -> Path:
    with Dataset(folder) as made:
        for audit in audits:
            made.add(audit)
    return folder


@pytest.mark.parametrize("options", [[], ["--jobs", "2"]])
def test_what_is_read_back_is_what_json_tells(
    options: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recordings(tmp_path / "many", 5)
    assert main(["audit", str(tmp_path / "many"), "--format", "json"]) == 1
    told = timeless(capsys.readouterr().out)
    out = tmp_path / "out"
    assert main(["audit", str(tmp_path / "many"), "--format", "parquet", "-o", str(out), *options]) == 1
    assert capsys.readouterr() == ("", f"wrote {out}: 5 recordings, {len(told['violations'])} findings\n")
    read = [{**row, "before": json.loads(row["before"])} for row in rows(out / "findings")]
    key = lambda row: (row["path"], -1 if row["index"] is None else row["index"])  # noqa: E731
    assert sorted(read, key=key) == [{"count": 1, **violation} for violation in told["violations"]]
    summaries = {row["path"]: row for row in rows(out / "inputs")}
    assert [path for path, row in summaries.items() if not row["read"]] == [str(tmp_path / "many/04.mcap")]
    for entry in told["inputs"]:
        assert entry.items() <= summaries[entry["path"]].items()
    for severity in ("errors", "warnings", "notes"):
        assert sum(row[severity] for row in summaries.values()) == told["summary"][severity]
    assert {path.name for path in out.iterdir()} == {"findings", "inputs"}


def test_the_columns_are_the_same_without_findings(tmp_path: Path) -> None:
    empty, full = written(tmp_path / "empty", CLEAN), written(tmp_path / "full", AUDIT)
    for part in ("findings", "inputs"):
        assert pq.read_schema(empty / part / "part-00000.parquet").equals(
            pq.read_schema(full / part / "part-00000.parquet"), check_metadata=True
        )
    frame = pd.read_parquet(empty / "findings")
    assert len(frame) == 0
    assert {name: str(frame[name].dtype) for name in ("index", "count", "time")} == {
        "index": "Int64", "count": "Int64", "time": "datetime64[ns, UTC]",
    }  # fmt: skip
    assert len(pd.read_parquet(written(tmp_path / "none") / "inputs")) == 0


def test_any_name_and_any_time_can_be_kept(tmp_path: Path) -> None:
    odd = replace(SELECT, path=HOSTILE, message=HOSTILE, time=2**64 - 1, before={HOSTILE: [HOSTILE]})
    folder = written(tmp_path / "out", Audit([], [odd, START, UNREADABLE]))
    read = {row["rule"]: row for row in rows(folder / "findings")}
    assert read[SELECT.rule]["path"] == HOSTILE.replace("\udc80", "\\udc80")
    assert read[SELECT.rule]["time"] is None
    assert json.loads(read[SELECT.rule]["before"]) == {HOSTILE: [HOSTILE]}
    assert read[START.rule]["time"] == START.time


def test_results_are_written_as_they_come(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(dataset, "MOST", 3)
    with Dataset(tmp_path / "out") as made:
        for _ in range(3):
            made.add(Audit(AUDIT.inputs, [SELECT, START]))
        assert len(rows(tmp_path / "out" / "findings")) == 6
        assert (tmp_path / "out" / MARK).exists()
        made.add(CLEAN)
    assert len(rows(tmp_path / "out" / "inputs")) == 4
    assert not (tmp_path / "out" / MARK).exists()


def test_a_dataset_that_was_broken_off_is_begun_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Dataset, "_write", lambda _: 1 / 0)
    with pytest.raises(ZeroDivisionError):
        written(tmp_path / "out", AUDIT)
    monkeypatch.undo()
    assert (tmp_path / "out" / MARK).exists()
    assert len(rows(written(tmp_path / "out", CLEAN) / "inputs")) == 1


@pytest.mark.parametrize(
    ("place", "said"),
    [
        ("mine", "holds other things (name a new folder with -o)"),
        ("file", "cannot hold a dataset: "),
        ("file/x", "cannot hold a dataset: "),
        ("none/x", "cannot hold a dataset: "),
        ("whole", "holds a dataset already (name another folder with -o, or delete this one before)"),
    ],
)
def test_a_folder_that_is_not_free_is_refused(
    place: str, said: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("mine")
    (tmp_path / "file").write_text("mine")
    written(tmp_path / "whole", CLEAN)
    assert main(["audit", "a.mcap", "--format", "parquet", "-o", str(tmp_path / place)]) == 2
    out, err = capsys.readouterr()
    assert out == ""
    assert err.startswith(f"mmsverify: {tmp_path / place}: {said}")
    assert err.count("\n") == 1


def test_a_folder_must_be_named(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["audit", "a.mcap", "--format", "parquet"]) == 2
    assert capsys.readouterr().err == "mmsverify: --format: parquet is a folder (name a new one with -o)\n"


def test_a_copy_with_findings_is_made_of_one_trace_by_itself(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = ["--format", "parquet", "-o", str(tmp_path / "x"), "--annotate", str(tmp_path / "y.mcap")]
    assert main(["audit", "a.mcap", *options]) == 2
    assert "--annotate: not with --format parquet" in capsys.readouterr().err


def test_a_fleet_of_which_nothing_can_be_read_is_a_bad_request(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    recordings(tmp_path / "many", 1)
    assert main(["audit", str(tmp_path / "many"), "--format", "parquet", "-o", str(tmp_path / "out")]) == 2
    assert "00.mcap" in capsys.readouterr().err
    assert [row["read"] for row in rows(tmp_path / "out" / "inputs")] == [False]


def test_without_pyarrow_one_line_says_what_to_install(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delattr("mmsverify.report.parquet", raising=False)
    monkeypatch.setitem(sys.modules, "mmsverify.report.parquet", None)
    assert main(["audit", "a.mcap", "--format", "parquet", "-o", str(tmp_path / "out")]) == 2
    assert capsys.readouterr().err == "mmsverify: Parquet needs pyarrow (pip install 'mmsverify[parquet]')\n"
    assert not (tmp_path / "out").exists()
