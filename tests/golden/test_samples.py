"""The shipped sample recordings: made again octet for octet, and what an audit finds in each."""

from __future__ import annotations

from functools import cache
from pathlib import Path

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.formats import vr
from mmsverify.formats.mcap import read_trace
from mmsverify.resources import traces_dir
from mmsverify.results import Audit
from mmsverify.samples.__main__ import main
from mmsverify.samples.library import SAMPLES, write_samples

Told = tuple[int | None, str, str, tuple[str, ...]]
"""Index, severity, rule, clauses."""

UNLISTED = ("R-7.5.2.4-2", "R-7.5.1.4-5")

LACKING = (
    "R-9.2.2.2.1-1", "R-9.2.2.2.1-3", "R-9.2.2.2.1-4", "R-9.2.2.2.1-6", "R-9.2.2.2.1-9", "R-9.1-1",
    "R-9.2.2.2.2.1-1", "R-9.2.2.2.2.2-1", "R-9.2.2.2.2.1-2", "R-9.2.2.1-1", "R-9.2.3.1-1",
)  # fmt: skip

FINDINGS: dict[str, list[Told]] = {
    "annex-a.mcap": [
        (1, "warning", "conformance.services", LACKING),
        (7, "error", "negotiation.service", UNLISTED),
        (9, "error", "negotiation.service", UNLISTED),
        (11, "error", "negotiation.service", UNLISTED),
        # The standard's own example spells the domain in two ways: no download of that name is going on.
        (12, "error", "download.not-begun", ("R-A5.1-3", "R-9.2.2.2.2.1-1")),
        (13, "error", "negotiation.service", UNLISTED),
        (15, "error", "negotiation.service", UNLISTED),
        # The action R_ARM gives the attributes of R_ARM, and these call it CONTROLLING.
        (24, "error", "attributes.arm-control", ("R-8.3.1-6", "R-7.3.3.9.2.2-1")),
        (26, "error", "status.paused-unselected", ("R-6.3.4.6-2", "R-7.3.2.1.1.4-1")),
    ],
    "faulty-select.mcap": [
        (41, "error", "select.selected-active", ("R-7.4.4.2-e",)),
        (57, "error", "start.not-selected", ("R-7.3.3.3.3-d0", "R-5.3.1.3.3.7-2")),
    ],
    "faulty-vmd-stop.mcap": [
        (42, "error", "attributes.state", ("R-7.3.3.9-1", "R-7.4.2.2-4")),
        (44, "error", "vmd-reset.intervention", ("R-5.3.1.3.3.13-2",)),
    ],
    "faulty-press.mcap": [
        (117, "error", "home.while-running", ("V-CHK-3", "V-CHK-2", "V-DO-01", "V-CMD-01", "V-CTL02-N")),
        (311, "error", "org.unhomed", ("V-SM-5", "V-FUN-2", "V-CHK-2", "V-DO-02", "V-CMD-02", "V-CTL02-N")),
    ],
    "faulty-signals.mcap": [
        (13, "error", "access.dedicated", ("M-2.3.2-2", "M-2.3.2-3")),
        (17, "error", "access.not-inputs", ("M-2.3.1-1", "M-2.3.1-2", "M-2.3.1-3")),
        (19, "error", "modbus.unasked", ("M-2-S3b", "M-2.2-8", "M-2.2-5")),
    ],
    "cell-incident.mcap": [
        (246, "error", "access.dedicated", ("M-2.3.2-2", "M-2.3.2-3")),
        (261, "error", "home.while-running", ("V-CHK-3", "V-CHK-2", "V-DO-01", "V-CMD-01", "V-CTL02-N")),
        (314, "error", "attributes.state", ("R-7.3.3.9-1", "R-7.4.2.2-4")),
        (431, "error", "vmd-reset.intervention", ("R-5.3.1.3.3.13-2",)),
    ],
    "firmware-4.2.1.mcap": [
        (43, "error", "select.selected-active", ("R-7.4.4.2-e",)),
        (53, "error", "start.not-selected", ("R-7.3.3.3.3-d0", "R-5.3.1.3.3.7-2")),
        (69, "error", "vmd-reset.intervention", ("R-5.3.1.3.3.13-2",)),
    ],
    "firmware-4.3.0.mcap": [
        (65, "error", "attributes.state", ("R-7.3.3.9-1", "R-7.4.2.2-4")),
        (67, "error", "vmd-reset.intervention", ("R-5.3.1.3.3.13-2",)),
    ],
    "press-day.mcap": [],
    "two-clients.mcap": [(29, "error", "stop.without-control", ("R-7.3.3.4.1-b",))],
}


@cache
def audited(name: str) -> Audit:
    return audit_traces([traces_dir() / name], profile=None, model=None)


def told(name: str) -> list[Told]:
    return [(f.index, f.severity, f.rule, f.clauses) for f in audited(name).findings]


@pytest.fixture(scope="module")
def made_again(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("samples")
    write_samples(folder)
    return folder


@pytest.mark.parametrize("name", SAMPLES)
def test_a_sample_is_made_again_octet_for_octet(name: str, made_again: Path) -> None:
    assert (made_again / name).read_bytes() == (traces_dir() / name).read_bytes()


def test_the_folder_holds_these_samples_and_no_other() -> None:
    assert {path.name for path in traces_dir().glob("*.mcap")} == set(SAMPLES)


@pytest.mark.parametrize("name", SAMPLES)
def test_the_readme_tells_of_every_sample(name: str) -> None:
    assert f"`{name}`" in (traces_dir() / "README.md").read_text(encoding="utf-8")


def test_the_command_writes_them_all(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path)]) == 0
    assert capsys.readouterr().out.split() == [str(tmp_path / name) for name in SAMPLES]


def test_the_command_wants_a_folder_that_exists(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path / "none")]) == 2
    assert "usage" in capsys.readouterr().err


@pytest.mark.parametrize("name", FINDINGS)
def test_an_audit_of_a_sample_finds_exactly_this(name: str) -> None:
    assert told(name) == FINDINGS[name]


@pytest.mark.parametrize("name", FINDINGS)
def test_every_finding_points_to_earlier_messages(name: str) -> None:
    for finding in audited(name).findings:
        assert finding.index is not None
        assert all(related < finding.index for related in finding.related)


@pytest.mark.slow
def test_a_whole_shift_without_a_fault_has_no_finding() -> None:
    assert told("production-run.mcap") == []
    assert audited("production-run.mcap").inputs[0].messages == 349


def test_the_day_of_a_press_shows_every_mode_that_the_text_sets_and_every_status() -> None:
    samples = [vr.decode(message.data).cells for message in read_trace(traces_dir() / "press-day.mcap")]
    assert {cells["C_RunMD"] for cells in samples} == {*range(10), *range(13, 17)}
    assert {cells["CS_RunSTA"] for cells in samples} == set(range(15))
    assert {cells["C_Cmd"] for cells in samples} == {*range(11), 101, 203, 305, 402}
