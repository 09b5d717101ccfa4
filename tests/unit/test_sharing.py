"""Many recordings on several processes: the same results, whatever becomes of a process."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.fleet.processes import shared
from mmsverify.fleet.tasks import Done
from mmsverify.resources import traces_dir
from mmsverify.results import AuditedInput

SAMPLES = sorted(traces_dir().glob("*.mcap"))


def entry(path: Path) -> AuditedInput:
    return AuditedInput(str(path), 1, 1, 0, False, 0.0)


def once_killed(path: Path) -> Done:
    """Kills its process the first time that it sees a certain path."""
    mark = path.parent / "seen"
    if path.name == "7" and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return entry(path), []


def always_killed(path: Path) -> Done:
    if path.name == "3":
        os.kill(os.getpid(), signal.SIGKILL)
    return entry(path), []


def refuses(path: Path) -> Done:
    raise ValueError(path.name)


def test_a_killed_process_takes_nothing_with_it(tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(12)]
    done = [*shared(once_killed, paths, jobs=2)]
    assert sorted(number for number, _ in done) == [*range(12)]
    assert {number: each.path for number, (each, _) in done if each} == dict(enumerate(map(str, paths)))


def test_a_recording_that_kills_its_process_is_told(tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(6)]
    done = dict(shared(always_killed, paths, jobs=2))
    assert [done[number][0] is None for number in range(6)] == [number == 3 for number in range(6)]
    [finding] = done[3][1]
    assert finding.rule == "input.unreadable"
    assert "was killed" in finding.message


def test_an_error_of_a_task_is_an_error(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="0"):
        [*shared(refuses, [tmp_path / "0"], jobs=2)]


def test_two_processes_find_what_one_finds(tmp_path: Path) -> None:
    broken = tmp_path / "broken.mcap"
    broken.write_bytes(b"no recording")
    paths = [*SAMPLES, broken]
    one, two = (audit_traces(paths, profile=None, model=None, jobs=jobs) for jobs in (1, 2))
    assert one.findings == two.findings
    assert [each.path for each in one.inputs] == [each.path for each in two.inputs]


def test_the_command_line_takes_jobs(capsys: pytest.CaptureFixture[str]) -> None:
    traces = [str(path) for path in SAMPLES[:2]]
    told = []
    for more in ([], ["--jobs", "2"], ["--exact"]):
        assert main(["audit", *traces, "-q", "--format", "junit", *more]) == 1
        told.append(capsys.readouterr().out.split("time=")[0])
    assert told[0] == told[1] == told[2]


def test_a_script_that_cannot_be_started_again_is_told_so(tmp_path: Path) -> None:
    script = tmp_path / "unguarded.py"
    script.write_text(
        "from pathlib import Path\n"
        "from mmsverify.auditing import audit_traces\n"
        f"audit_traces([Path({str(SAMPLES[0])!r})] * 2, profile=None, model=None, jobs=2)\n"
    )
    done = subprocess.run([sys.executable, script], capture_output=True, text=True, check=False)
    assert "UsageError: jobs: other processes cannot be started" in done.stderr


@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
def test_processes_end_with_the_one_that_started_them(tmp_path: Path) -> None:
    script = tmp_path / "killed.py"
    script.write_text(
        "import os, sys, time\n"
        "from pathlib import Path\n"
        "from mmsverify.fleet.processes import shared\n"
        "def task(path):\n"
        "    print(os.getpid(), flush=True)\n"
        "    time.sleep(60)\n"
        "if __name__ == '__main__':\n"
        "    [*shared(task, [Path('a'), Path('b')], jobs=2)]\n"
    )
    with subprocess.Popen([sys.executable, script], stdout=subprocess.PIPE, text=True) as parent:
        assert parent.stdout is not None
        workers = [int(parent.stdout.readline()) for _ in range(2)]
        parent.kill()
    deadline = time.monotonic() + 10
    while any(Path(f"/proc/{worker}").exists() for worker in workers) and time.monotonic() < deadline:
        time.sleep(0.05)
    assert not any(Path(f"/proc/{worker}").exists() for worker in workers)
