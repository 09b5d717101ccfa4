"""The bar while recordings are audited: what it says, when, and that nobody is told who does not watch."""

from __future__ import annotations

import io
import sys
from itertools import groupby
from pathlib import Path

import fsspec
import pytest
from rich.console import Console

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.commands.bar import Bar, audit_bar, progress_on
from mmsverify.formats.locations import Location, Url
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.passing import AUDITING, FETCHING, LOOKING, Tick
from mmsverify.resources import traces_dir

SAMPLES = sorted(traces_dir().glob("*.mcap"))
ROBOT = traces_dir() / "two-clients.mcap"


class Clock:
    """Time that passes when it is told to."""

    def __init__(self) -> None:
        self.now = 100.0

    def __call__(self) -> float:
        return self.now


class Screen:
    """A bar on a terminal of so many columns."""

    def __init__(self, locations: list[Location], *, shared: bool = False, width: int = 120) -> None:
        self.clock = Clock()
        self._out = io.StringIO()
        console = Console(file=self._out, force_terminal=True, width=width, color_system=None)
        self._progress = progress_on(console, self.clock)
        self.bar = Bar(self._progress, locations, shared=shared)

    def line(self) -> str:
        """What stands there now, the bar itself left out."""
        self._out.seek(0)
        self._out.truncate()
        self._progress.console.print(self._progress.get_renderable())
        return " ".join(word for word in self._out.getvalue().split() if not set(word) <= set("━╸╺"))


class Terminal(io.StringIO):
    def isatty(self) -> bool:
        return True


class Watching:
    """Notes what it is told."""

    def __init__(self) -> None:
        self.begun: list[str] = []
        self.heard: list[tuple[str, int, int]] = []
        self.done = 0

    def begin(self, location: Location) -> None:
        self.begun.append(str(location))

    def passed(self, stage: str, octets: int, messages: int) -> None:
        self.heard.append((stage, octets, messages))

    def wait(self, text: str) -> None:
        raise AssertionError(text)

    def finish(self) -> None:
        self.done += 1


@pytest.fixture
def recordings(tmp_path: Path) -> list[Location]:
    """Two of 4 and of 8 million octets."""
    found: list[Location] = []
    for name, size in (("a[b].mcap", 4_000_000), ("c.mcap", 8_000_000)):
        (tmp_path / name).write_bytes(bytes(size))
        found.append(tmp_path / name)
    return found


def test_the_bar_goes_on_by_octets(recordings: list[Location]) -> None:
    screen = Screen(recordings)
    screen.bar.begin(recordings[0])
    assert screen.line() == "opening a[b].mcap 0/2 files -:--:--"
    screen.bar.passed(LOOKING, 1_000_000, 5_000)
    assert screen.line() == "looking over a[b].mcap: 25 % 0/2 files -:--:--"
    for second in range(3):
        screen.clock.now = 101.0 + second
        screen.bar.passed(AUDITING, second * 1_000_000, second * 3_000)
    screen.bar.passed(AUDITING, 2_000_000, 6_000)
    assert screen.line() == "a[b].mcap 0/2 files 2.0/12.0 MB 2,000 events/s 0:00:10"
    screen.clock.now = 105.0
    screen.bar.passed(AUDITING, 4_000_000, 10_000)
    screen.bar.finish()
    screen.bar.begin(recordings[1])
    assert screen.line() == "opening c.mcap 1/2 files 4.0/12.0 MB 2,000 events/s 0:00:08"
    screen.bar.finish()
    assert "2/2 files 12.0/12.0 MB" in screen.line()


def test_a_narrow_terminal_leaves_room_for_the_name(recordings: list[Location]) -> None:
    screen = Screen(recordings, width=80)
    screen.bar.begin(recordings[1])
    screen.clock.now += 10
    screen.bar.passed(AUDITING, 300_000, 12_345_670)
    assert screen.line() == "c.mcap 0/2 files 300.0 kB/12.0 MB 1,234,567 events/s -:--:--"


def test_of_one_recording_no_number_is_told(recordings: list[Location]) -> None:
    screen = Screen(recordings[:1])
    screen.bar.begin(recordings[0])
    assert screen.line() == "opening a[b].mcap -:--:--"


def test_several_processes_tell_the_number_of_recordings(recordings: list[Location]) -> None:
    screen = Screen(recordings * 2, shared=True)
    assert screen.line() == "auditing 4 recordings 0/4 files -:--:--"
    for second in range(1, 4):
        screen.clock.now = 100.0 + second
        screen.bar.finish()
    assert screen.line() == "auditing 4 recordings 3/4 files 0:00:01"


def test_a_remote_recording_is_measured_when_it_is_opened() -> None:
    fsspec.filesystem("memory").pipe("/bar/x.mcap", bytes(3_000_000))
    url = Url("memory://bar/x.mcap")
    screen = Screen([url])
    screen.bar.begin(url)
    screen.clock.now += 1
    screen.bar.passed(AUDITING, 1_500_000, 10)
    assert screen.line().startswith("x.mcap 1.5/3.0 MB 10 events/s")


def test_remote_recordings_of_unknown_size_are_counted(recordings: list[Location]) -> None:
    screen = Screen([Url("nowhere://x.mcap"), *recordings])
    screen.bar.begin(Url("nowhere://x.mcap"))
    screen.clock.now += 1
    screen.bar.passed(AUDITING, 1_500_000, 10)
    assert screen.line() == "x.mcap 0/3 files 1.5 MB 10 events/s -:--:--"


def test_what_is_fetched_is_told() -> None:
    watching = Watching()
    fsspec.filesystem("memory").pipe("/bar/robot.mcap", ROBOT.read_bytes())
    audit_traces(["memory://bar/robot.mcap"], profile=None, model=None, progress=watching)
    assert watching.heard[0] == (FETCHING, ROBOT.stat().st_size, 0)
    screen = Screen([Url("memory://bar/robot.mcap", 1_000)])
    screen.bar.begin(Url("memory://bar/robot.mcap", 1_000))
    screen.bar.passed(FETCHING, 500, 0)
    assert screen.line() == "fetching robot.mcap: 50 % -:--:--"


def test_what_has_vanished_is_nothing(tmp_path: Path) -> None:
    screen = Screen([tmp_path / "none.mcap"])
    screen.bar.begin(tmp_path / "none.mcap")
    screen.bar.finish()
    assert screen.line().startswith("opening none.mcap")


# --- who is told, and how often ---


def test_told_at_most_ten_times_a_second() -> None:
    clock, heard = Clock(), list[tuple[int, int]]()
    tick = Tick(lambda *far: heard.append(far), clock)
    for messages in range(1, 1001):
        tick(10 * messages, messages)
        clock.now += 0.01
    tick.end()
    tick.end()
    assert heard[0] == (0, 0)
    assert heard[-1] == (10_000, 1_000)
    assert heard == sorted(set(heard))
    assert 90 <= len(heard) <= 102


def test_nobody_need_be_told() -> None:
    tick = Tick(None)
    tick(1, 1)
    tick.end()


@pytest.mark.parametrize(("since", "stages"), [(0, [AUDITING]), (9, [AUDITING, LOOKING, AUDITING])])
def test_who_watches_a_recording_sees_what_is_done_with_it(
    since: int, stages: list[str], tmp_path: Path
) -> None:
    path = tmp_path / "robot.mcap"
    with TraceWriter(path) as writer:
        for message in list(read_trace(ROBOT))[since:]:
            writer.add(message.time, message.channel, message.data)
    watching = Watching()
    audit_traces([path], profile=None, model=None, progress=watching)
    assert watching.begun == [str(path)]
    assert [stage for stage, _ in groupby(stage for stage, _, _ in watching.heard)] == stages
    assert watching.heard[-1][2] == sum(1 for _ in read_trace(path))
    assert 0 < watching.heard[-1][1] <= path.stat().st_size
    assert watching.done == 1


def test_who_watches_changes_nothing() -> None:
    alone = audit_traces(SAMPLES[:4], profile=None, model=None)
    watched = audit_traces(SAMPLES[:4], profile=None, model=None, progress=Watching())
    assert watched.findings == alone.findings


def test_several_processes_tell_of_each_recording() -> None:
    watching = Watching()
    audit_traces(SAMPLES[:3], profile=None, model=None, progress=watching, jobs=2)
    assert (watching.done, watching.begun, watching.heard) == (3, [], [])


def test_the_bar_is_on_a_terminal_and_gone_in_the_end(monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setenv("TERM", "xterm")
    monkeypatch.setenv("COLUMNS", "120")
    assert main(["audit", str(ROBOT)]) == 1
    assert "two-clients.mcap" in terminal.getvalue()
    assert terminal.getvalue().endswith("\x1b[2K")


@pytest.mark.parametrize(("stream", "quiet"), [(Terminal(), True), (io.StringIO(), False), (None, False)])
def test_nobody_is_told_who_does_not_watch(
    monkeypatch: pytest.MonkeyPatch, stream: io.StringIO | None, quiet: bool
) -> None:
    monkeypatch.setattr(sys, "stderr", stream)
    with audit_bar([ROBOT], 1, quiet=quiet) as watcher:
        assert watcher is None
    assert stream is None or stream.getvalue() == ""
