"""What the Python API of an audit takes: the same inputs as the command line, one or several."""

from __future__ import annotations

import shutil
from pathlib import Path
from typing import Any

import pytest

from mmsverify.auditing import audit_each, audit_traces
from mmsverify.formats.locations import Url
from mmsverify.formats.paths import trace_locations
from mmsverify.resources import traces_dir

SAMPLE = traces_dir() / "faulty-signals.mcap"


@pytest.fixture
def plant(tmp_path: Path) -> Path:
    folder = tmp_path / "plant"
    for name in ("b.mcap", "deep/a.mcap"):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(SAMPLE, folder / name)
    (folder / "notes.txt").write_text("none of ours")
    return folder


@pytest.mark.parametrize("shape", [str, Path, lambda folder: [str(folder)], lambda folder: iter([folder])])
def test_a_folder_means_the_recordings_in_it(plant: Path, shape: Any) -> None:
    wanted = [str(plant / "b.mcap"), str(plant / "deep/a.mcap")]
    result = audit_traces(shape(plant), profile=None, model=None)
    assert [entry.path for entry in result.inputs] == wanted
    each = [*audit_each(shape(plant), profile=None, model=None)]
    assert [audit.inputs[0].path for audit in each] == wanted


def test_a_pattern_means_what_matches(plant: Path) -> None:
    [entry] = audit_traces(f"{plant}/*/*.mcap", profile=None, model=None).inputs
    assert entry.path == str(plant / "deep/a.mcap")


@pytest.mark.parametrize("shape", [str, Path])
def test_one_recording_need_be_no_list(shape: Any) -> None:
    [entry] = audit_traces(shape(SAMPLE), profile=None, model=None).inputs
    assert entry.path == str(SAMPLE)


def test_a_recording_that_is_named_twice_is_audited_once(plant: Path) -> None:
    result = audit_traces([plant / "b.mcap", plant], profile=None, model=None)
    assert [Path(entry.path).name for entry in result.inputs] == ["b.mcap", "a.mcap"]


def test_a_url_that_was_found_is_taken_as_it_is() -> None:
    assert trace_locations(Url("nowhere://none/")) == [Url("nowhere://none/")]


def test_nothing_is_an_audit_of_nothing(tmp_path: Path) -> None:
    assert audit_traces([], profile=None, model=None).inputs == []
    [finding] = audit_traces(tmp_path, profile=None, model=None).findings
    assert (finding.rule, finding.path) == ("input.unreadable", str(tmp_path))


@pytest.mark.parametrize("jobs", [0, -1])
@pytest.mark.parametrize("more", [{}, {"scheduler": "local"}])
def test_fewer_than_one_process_is_refused_at_once(jobs: int, more: dict[str, str]) -> None:
    for audit in (audit_each, audit_traces):
        with pytest.raises(ValueError, match=rf"^jobs: {jobs} processes cannot share the work \(give 1 or"):
            audit(SAMPLE, profile=None, model=None, jobs=jobs, **more)  # type: ignore[arg-type]
