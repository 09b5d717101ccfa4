"""Results that are kept for a run that goes on: which count, which do not, and where they may stand."""

from __future__ import annotations

import os
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest
from fleets import SAMPLES, entry, timeless
from report_samples import SELECT, START, UNREADABLE

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.errors import UsageError
from mmsverify.fleet import kept
from mmsverify.fleet.kept import MARK, Kept
from mmsverify.fleet.tasks import Done, here


@dataclass
class Manner:
    variant: str = "repaired"


@pytest.fixture
def traces(tmp_path: Path) -> list[Path]:
    paths = [tmp_path / name for name in ("a.mcap", "b.mcap")]
    for path in paths:
        path.write_bytes(b"recorded")
    return paths


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "kept"


def audited(folder: Path, paths: list[Path], manner: Manner | None = None) -> tuple[list[str], list[Done]]:
    """The names of the recordings that were audited, and all results in their order."""
    names: list[str] = []

    def task(path: Path) -> Done:
        names.append(path.name)
        if not path.exists():
            return None, [UNREADABLE]
        return entry(path), [SELECT, START]

    done = dict(Kept(folder, manner or Manner()).around(here)(task, paths))
    return names, [done[number] for number in range(len(paths))]


def test_what_is_finished_is_put_back_unchanged(folder: Path, traces: list[Path]) -> None:
    first = audited(folder, traces)
    assert first == (["a.mcap", "b.mcap"], [(entry(path), [SELECT, START]) for path in traces])
    assert audited(folder, traces) == ([], first[1])
    assert audited(folder, traces[1:]) == ([], first[1][1:])


def longer(path: Path) -> None:
    path.write_bytes(b"recorded more")


def later(path: Path) -> None:
    os.utime(path, ns=(1, 1))


@pytest.mark.parametrize("change", [longer, later])
def test_a_recording_that_was_changed_is_audited_anew(
    change: Callable[[Path], None], folder: Path, traces: list[Path]
) -> None:
    audited(folder, traces)
    change(traces[1])
    assert audited(folder, traces)[0] == ["b.mcap"]
    assert len([*folder.glob("*.json")]) == 2


def test_another_manner_and_another_program_are_another_result(
    folder: Path, traces: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    audited(folder, traces)
    assert audited(folder, traces, Manner("as-written"))[0] == ["a.mcap", "b.mcap"]
    assert audited(folder, traces)[0] == []
    monkeypatch.setattr(kept, "__version__", "9.9")
    assert audited(folder, traces)[0] == ["a.mcap", "b.mcap"]


def test_the_same_name_elsewhere_is_another_recording(
    folder: Path, traces: list[Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(traces[0].parent)
    assert audited(folder, [Path("a.mcap")])[0] == ["a.mcap"]
    other = folder.parent / "other"
    other.mkdir()
    (other / "a.mcap").write_bytes(b"recorded")
    state = traces[0].stat()
    os.utime(other / "a.mcap", ns=(state.st_atime_ns, state.st_mtime_ns))
    monkeypatch.chdir(other)
    assert audited(folder, [Path("a.mcap")])[0] == ["a.mcap"]


@pytest.mark.parametrize(
    "text", ["", "{", "[]", "null", '{"schema": "mmsverify.kept/1"}', "\udc80", "[" * 5000]
)
def test_a_result_that_is_not_whole_is_none(text: str, folder: Path, traces: list[Path]) -> None:
    audited(folder, traces[:1])
    [file] = folder.glob("*.json")
    whole = file.read_bytes()
    file.write_bytes(text.encode("utf-8", "surrogateescape"))
    assert audited(folder, traces[:1])[0] == ["a.mcap"]
    assert file.read_bytes() == whole


def test_what_could_not_be_read_is_tried_again(folder: Path, traces: list[Path]) -> None:
    missing = traces[0].with_name("none.mcap")
    assert [audited(folder, [missing])[0] for _ in range(2)] == [["none.mcap"]] * 2

    def broken_off(path: Path) -> Done:
        return entry(path), [UNREADABLE]

    list(Kept(folder, Manner()).around(here)(broken_off, traces))
    assert audited(folder, traces)[0] == ["a.mcap", "b.mcap"]


def test_a_folder_that_holds_other_things_is_refused(folder: Path) -> None:
    folder.mkdir()
    (folder / "thesis.txt").write_text("mine")
    with pytest.raises(UsageError, match=f"^{folder}: holds other things than results"):
        Kept(folder, Manner())
    assert [path.name for path in folder.iterdir()] == ["thesis.txt"]


@pytest.mark.parametrize("place", ["a.mcap", "a.mcap/x", "none/x"])
def test_a_place_that_cannot_be_a_folder_is_refused(place: str, traces: list[Path]) -> None:
    folder = traces[0].parent / place
    with pytest.raises(UsageError, match=f"^{folder}: cannot hold results: "):
        Kept(folder, Manner())


def test_a_folder_that_cannot_be_written_is_refused(folder: Path, traces: list[Path]) -> None:
    folder.mkdir()
    (folder / MARK).mkdir()
    with pytest.raises(UsageError, match="holds other things"):
        Kept(folder, Manner())
    (folder / MARK).rmdir()
    store = Kept(folder, Manner())
    (folder / MARK).unlink()
    folder.rmdir()
    with pytest.raises(UsageError, match="cannot be written: No such file"):
        list(store.around(here)(lambda path: (entry(path), []), traces))


def test_a_profile_that_was_changed_is_another_manner(folder: Path, tmp_path: Path) -> None:
    profile = tmp_path / "robot.toml"
    for text in ("", "# the same\n", "[mms-robot]\nnest = 3\n"):
        profile.write_text(text)
        audit_traces([SAMPLES[0]], profile=profile, model=None, resume=folder)
    assert len([*folder.glob("*.json")]) == 2


def test_the_command_line_resumes(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    told = []
    for options in ([], ["--resume", str(folder)], ["--resume", str(folder)]):
        assert main(["audit", *map(str, SAMPLES[:2]), "--format", "json", *options]) == 1
        told.append(capsys.readouterr().out)
    assert timeless(told[0]) == timeless(told[1])
    assert told[1] == told[2]
    assert main(["audit", str(SAMPLES[0]), "--resume", str(SAMPLES[0].parent)]) == 2
    assert "holds other things than results" in capsys.readouterr().err
