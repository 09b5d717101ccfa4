"""Many recordings on several processes: the same results, whatever becomes of a process.

Those of a Dask cluster are killed here, too, in the middle of a run of the command.
"""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from fleets import always_killed, once_killed, recordings, refuses, timeless, twice_killed, workers

from mmsverify.auditing import audit_traces
from mmsverify.cli import main
from mmsverify.fleet.processes import shared
from mmsverify.resources import traces_dir

SAMPLES = sorted(traces_dir().glob("*.mcap"))


def test_a_killed_process_takes_nothing_with_it(tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(12)]
    done = [*shared(once_killed, paths, jobs=2)]
    assert sorted(number for number, _ in done) == [*range(12)]
    assert {number: each.path for number, (each, _) in done if each} == dict(enumerate(map(str, paths)))


def test_a_recording_whose_process_was_killed_twice_is_not_blamed(tmp_path: Path) -> None:
    paths = [tmp_path / str(number) for number in range(12)]
    done = dict(shared(twice_killed, paths, jobs=2))
    assert {number: each.path for number, (each, _) in done.items() if each} == dict(
        enumerate(map(str, paths))
    )


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
        "from mmsverify.auditing import audit_traces\n"
        f"audit_traces({[*map(str, SAMPLES[:2])]!r}, profile=None, model=None, jobs=2)\n"
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


@pytest.fixture(scope="module")
def fleet(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("fleet") / "many"
    recordings(folder, 40)
    return folder


@pytest.fixture(scope="module")
def alone(fleet: Path) -> object:
    """The result of one process."""
    return timeless(run(fleet).communicate()[0])


HEEDING = """
import signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)
if __name__ == "__main__":
    from mmsverify.cli import main
    sys.exit(main())
"""


def run(fleet: Path, *options: str) -> subprocess.Popen[str]:
    """An audit that heeds interrupts, though whoever runs the tests may have been begun deaf to them."""
    command = [sys.executable, "-c", HEEDING, "audit", str(fleet), "--format", "json", *options]
    return subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, start_new_session=True
    )


def finished(kept: Path, count: int) -> None:
    """Wait until so many recordings are finished."""
    deadline = time.monotonic() + 60
    while len([*kept.glob("*.json")]) < count:
        assert time.monotonic() < deadline
        time.sleep(0.01)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
@pytest.mark.parametrize("engine", [[], ["--engine", "dask"]])
def test_a_process_killed_in_the_middle_changes_nothing(
    engine: list[str], fleet: Path, alone: object, tmp_path: Path
) -> None:
    with run(fleet, "--jobs", "2", *engine, "--resume", str(tmp_path / "kept")) as process:
        finished(tmp_path / "kept", 5)
        os.kill(workers(process.pid)[0], signal.SIGKILL)
        out, err = process.communicate()
    assert (process.returncode, err) == (1, "")
    assert timeless(out) == alone


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc").is_dir(), reason="looks for processes in /proc")
@pytest.mark.parametrize("pause", [0, 0.2, 0.3, 0.4, 0.5])
def test_two_processes_killed_within_half_a_second_change_nothing(
    pause: float, fleet: Path, alone: object, tmp_path: Path
) -> None:
    with run(fleet, "--jobs", "2", "--resume", str(tmp_path / "kept")) as process:
        finished(tmp_path / "kept", 5)
        before = workers(process.pid)
        os.kill(before[0], signal.SIGKILL)
        time.sleep(pause)
        while not (later := [each for each in workers(process.pid) if each not in before]):
            time.sleep(0.001)
        os.kill(later[0], signal.SIGKILL)
        out, err = process.communicate()
    assert (process.returncode, err) == (1, "")
    assert timeless(out) == alone


@pytest.mark.slow
@pytest.mark.parametrize("engine", [[], ["--jobs", "2"], ["--jobs", "2", "--engine", "dask"]])
def test_a_run_that_was_killed_goes_on_where_it_was(
    engine: list[str], fleet: Path, alone: object, tmp_path: Path
) -> None:
    kept = tmp_path / "kept"
    with run(fleet, *engine, "--resume", str(kept)) as process:
        finished(kept, 5)
        process.kill()
    before = {path: path.stat().st_mtime_ns for path in kept.glob("*.json")}
    assert 5 <= len(before) < 39
    out, _ = run(fleet, *engine, "--resume", str(kept)).communicate()
    assert timeless(out) == alone
    assert {path: path.stat().st_mtime_ns for path in before} == before
    assert len([*kept.glob("*.json")]) == 39


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="no group of processes to interrupt there")
@pytest.mark.parametrize("engine", [[], ["--engine", "dask"]])
def test_an_interrupt_of_all_processes_ends_them_without_a_word(
    engine: list[str], fleet: Path, tmp_path: Path
) -> None:
    with run(fleet, "--jobs", "2", *engine, "--resume", str(tmp_path / "kept")) as process:
        finished(tmp_path / "kept", 2)
        os.killpg(process.pid, signal.SIGINT)
        out, err = process.communicate()
    assert (process.returncode, out, err) == (130, "", "")
