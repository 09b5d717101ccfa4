"""``mmsverify explain``: the shortest legal way to a sample, or why there is none."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Literal

import pytest

from mmsverify.cli import main
from mmsverify.errors import UsageError
from mmsverify.explaining import explain_sample
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.resources import traces_dir


def polled(path: Path, *modes: int) -> Path:
    """Samples of mode and status, with any number of scans between them."""
    channel = Channel.vr("press", "polled")
    with TraceWriter(path) as trace:
        for number, mode in enumerate(modes):
            trace.add(1_000_000 * number, channel, json.dumps({"C_RunMD": mode, "CS_RunSTA": mode}).encode())
    return path


def test_from_debugging_to_a_run_the_way_leads_over_home_and_origin(tmp_path: Path) -> None:
    found = explain_sample(polled(tmp_path / "made.mcap", 1, 6), 1)
    assert found.way is not None
    assert [step.action for step in found.way if step.action != "set_pre_mode"] == [
        "home", "home_ends", "org", "org_ends", "run",
    ]  # fmt: skip
    assert found.way[-1].state == {"mode": "Run", "status": "RunAuto"}
    assert {"V-DO-01", "V-NEXT-02", "V-DO-03"} <= {cited for step in found.way for cited in step.clauses}


def test_a_sample_like_the_one_before_needs_nothing(tmp_path: Path) -> None:
    assert explain_sample(polled(tmp_path / "made.mcap", 5, 5), 1).way == ()


def test_where_no_way_leads_the_finding_says_why(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = polled(tmp_path / "made.mcap", 5, 0)
    assert main(["explain", str(path), "1"]) == 1
    told = capsys.readouterr().out
    assert "mode.next" in told
    assert "no legal way leads to it" in told


def test_a_way_is_printed_with_clauses(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(polled(tmp_path / "made.mcap", 3, 5)), "1"]) == 0
    told = capsys.readouterr().out
    assert "any number of scans after the one before" in told
    assert "V-DO-02" in told


@pytest.mark.parametrize("index", ["9", "-2"])
def test_an_index_beyond_the_recording_is_a_bad_request(
    index: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["explain", str(polled(tmp_path / "made.mcap", 1, 1)), "--", index]) == 2
    assert "there is no message" in capsys.readouterr().err


def test_a_message_of_a_robot_has_no_way() -> None:
    with pytest.raises(UsageError, match="message 3 shows no VR cells"):
        explain_sample(traces_dir() / "faulty-vmd-stop.mcap", 3)


TABLE = """[[vr-template.commands]]
number = 110
name = "open gripper"
sub_mode = 1

[[vr-template.commands]]
number = 111
name = "shut gripper"
sub_mode = 2
"""


def own(folder: Path, sampling: Literal["scan", "polled"], *cells: dict[str, int]) -> tuple[Path, Path]:
    """A recording of these samples and the profile of a machine with two commands of its own."""
    channel = Channel.vr("press", sampling)
    with TraceWriter(folder / "made.mcap") as trace:
        for number, held in enumerate(cells):
            trace.add(1_000_000 * number, channel, json.dumps(held).encode())
    (folder / "table.toml").write_text(TABLE, encoding="utf-8")
    return folder / "made.mcap", folder / "table.toml"


def test_the_way_obeys_the_command_that_c_submd_shows(tmp_path: Path) -> None:
    samples = [{"C_RunMD": 1, "CS_RunSTA": 1, "C_SubMD": 0}, {"C_RunMD": 13, "CS_RunSTA": 13, "C_SubMD": 2}]
    path, table = own(tmp_path, "polled", *samples)
    way = explain_sample(path, 1, profile=table).way
    assert way is not None
    assert [step.action for step in way if step.action != "set_pre_mode"] == ["shut_gripper_111"]


def test_a_wrong_c_submd_leaves_no_way(tmp_path: Path) -> None:
    ready = {"C_RunMD": 1, "CS_RunSTA": 1, "C_SubMD": 0, "C_Cmd": 0}
    acting = {"C_RunMD": 13, "CS_RunSTA": 13, "C_SubMD": 7, "C_Cmd": 0}
    path, table = own(
        tmp_path, "scan", ready, {**ready, "C_Cmd": 110}, {**acting, "CS_RunSTA": 1}, acting, acting
    )
    found = explain_sample(path, 2, profile=table)
    assert [finding.rule for finding in found.findings if finding.severity == "error"] == ["sub-mode.number"]
    assert found.way is None


def test_of_the_first_sample_nothing_is_explained(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(polled(tmp_path / "made.mcap", 5)), "0"]) == 0
    assert "the first one\na recording may begin at any time\n" in capsys.readouterr().out


def test_an_explanation_is_told_as_json(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["explain", str(polled(tmp_path / "made.mcap", 3, 5)), "1", "--format", "json"]) == 0
    told = json.loads(capsys.readouterr().out)
    assert (told["schema"], told["sampling"], told["violations"]) == ("mmsverify.explanation/1", "polled", [])
    assert told["way"][-1]["state"] == {"mode": "OrgRdy", "status": "OrgRdy"}
