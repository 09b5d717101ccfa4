"""Timelines of devices: what is drawn of a recording, and what cannot be."""

from __future__ import annotations

import sys
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from mmsverify.cli import main
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.resources import traces_dir
from mmsverify.timelines import timeline_svg

FAULTY = traces_dir() / "faulty-press.mcap"
PICTURE = Path(__file__).parents[2] / "docs" / "faulty-press.svg"


def words(svg: str) -> list[str]:
    return [
        " ".join(each.itertext()).strip()
        for each in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")
    ]


def made(path: Path, controller: str, *samples: bytes) -> Path:
    with TraceWriter(path) as trace:
        for number, data in enumerate(samples):
            trace.add(1_000_000 * number, Channel.vr(controller, "scan"), data)
    return path


def test_modes_commands_and_findings_stand_in_the_picture() -> None:
    told = words(timeline_svg(FAULTY))
    assert {
        "press3",
        "Run",
        "Home",
        "RunAuto",
        "home",
        "#117 home.while-running",
        "#311 org.unhomed",
    } <= set(told)


def test_the_picture_of_the_readme_shows_what_an_audit_finds_today() -> None:
    assert words(PICTURE.read_text(encoding="utf-8")) == words(timeline_svg(FAULTY))


def test_the_same_recording_gives_the_same_picture() -> None:
    assert timeline_svg(FAULTY) == timeline_svg(FAULTY)


def test_numbers_without_a_word_and_samples_that_are_none_leave_the_rest_as_it_is(tmp_path: Path) -> None:
    path = made(
        tmp_path / "made.mcap",
        "p",
        b'{"C_RunMD": 99}',
        b"{",
        b'{"C_RunMD": 1.5, "C_Cmd": 250}',
        b'{"C_RunMD": 1}',
        b'{"C_RunMD": 1}',
    )
    told = words(timeline_svg(path))
    assert "DbgRdy" in told
    assert sum(word.startswith("#") for word in told) >= 3


def test_a_name_can_neither_be_markup_nor_mathematics(tmp_path: Path) -> None:
    path = made(tmp_path / "made.mcap", "<b>$x$<b>", b'{"C_RunMD": 1}')
    svg = timeline_svg(path)
    assert "<b>" not in svg
    assert "<b>$x$<b>" in words(svg)


def test_the_commands_of_a_machine_have_their_names(tmp_path: Path) -> None:
    path = made(tmp_path / "made.mcap", "p", b'{"C_RunMD": 1, "C_Cmd": 101}')
    assert "jog_ram_101" in words(timeline_svg(path, profile=Path("press")))


def test_every_kind_of_device_is_drawn() -> None:
    told = words(timeline_svg(traces_dir() / "cell-incident.mcap"))
    assert {"weld5", "weld5-signals", "press3", "MANUAL-INTERVENTION-REQUIRED", "gap"} <= set(told)


def test_a_recording_without_a_device_is_a_bad_request(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["timeline", str(made(tmp_path / "made.mcap", "p"))]) == 2
    assert "no device is in it" in capsys.readouterr().err


def test_without_altair_one_line_says_what_to_install(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.delattr("mmsverify.report.charts", raising=False)
    monkeypatch.setitem(sys.modules, "mmsverify.report.charts", None)
    assert main(["timeline", str(FAULTY)]) == 2
    assert "pictures need Altair (pip install 'mmsverify[viz]')" in capsys.readouterr().err
