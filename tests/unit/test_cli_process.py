"""The command line as a process of its own: pipes that close, the module form, what a call for help loads."""

from __future__ import annotations

import signal
import subprocess
import sys

import pytest

AUDITED = """
import sys, types
from mmsverify.results import Audit, AuditedInput, Finding
from mmsverify.cli import main
error = Finding("a.mcap", 1, 0, "t", "v", "error", "r", ("R-1",), "m" * 1000)
module = types.ModuleType("mmsverify.auditing")
module.audit_traces = lambda *_, **__: Audit([AuditedInput("a.mcap", 1, 1, 0, False, 0.0)], [error] * 1000)
sys.modules["mmsverify.auditing"] = module
sys.exit(main(["audit", "a.mcap"]))
"""

WAITING = """
import signal, sys, time, types
signal.signal(signal.SIGINT, signal.default_int_handler)  # tests in the background inherit that it is ignored
from mmsverify.cli import main
def check_models(*_, **__):
    print("ready", flush=True)
    time.sleep(60)
module = types.ModuleType("mmsverify.checking")
module.check_models = check_models
sys.modules["mmsverify.checking"] = module
sys.exit(main(["check"]))
"""

HELP = """
import runpy, sys
sys.argv[1:] = ["--help"]
try:
    runpy.run_module("mmsverify", run_name="__main__")
except SystemExit as end:
    loaded = {"z3", "networkx", "pandas", "asn1tools", "mcap"} & set(sys.modules)
    sys.exit(f"loaded {loaded}" if loaded else end.code)
"""

SHORT = """
import sys
from mmsverify.cli import main
from mmsverify.resources import traces_dir
status = main(["audit", "-q", str(traces_dir() / "two-clients.mcap")])
heavy = {"z3", "networkx", "pandas", "numpy", "pyarrow", "asn1tools", "distributed", "multiprocessing"}
loaded = heavy & set(sys.modules)
sys.exit(f"loaded {loaded}" if loaded else status)
"""


def started(code: str) -> subprocess.Popen[str]:
    return subprocess.Popen(
        [sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )


def test_a_reader_that_stops_reading_changes_nothing_about_the_verdict() -> None:
    with started(AUDITED) as process:
        assert process.stdout is not None
        assert process.stderr is not None
        process.stdout.read(10)
        process.stdout.close()
        assert process.stderr.read() == ""
    assert process.returncode == 1


@pytest.mark.skipif(sys.platform == "win32", reason="no SIGINT to send there")
def test_an_interrupt_ends_with_130_and_without_a_traceback() -> None:
    with started(WAITING) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        process.send_signal(signal.SIGINT)
        _, err = process.communicate(timeout=30)
    assert "Traceback" not in err
    assert process.returncode == 130


@pytest.mark.skipif(sys.platform == "win32", reason="needs a POSIX shell")
def test_a_closed_stdout_is_one_line_and_status_2() -> None:
    shell = ["/bin/sh", "-c", 'exec "$0" -m mmsverify audit a.mcap >&-', sys.executable]
    run = subprocess.run(shell, capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (2, "mmsverify: stdout: is closed (name a file with -o)\n")


def test_the_module_runs_as_the_command_does_and_help_loads_no_engine() -> None:
    run = subprocess.run([sys.executable, "-c", HELP], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (0, "")
    assert run.stdout.startswith("Usage: mmsverify")


def test_an_audit_of_a_short_trace_loads_nothing_that_it_does_not_need() -> None:
    run = subprocess.run([sys.executable, "-c", SHORT], capture_output=True, text=True, check=False)
    assert (run.returncode, run.stderr) == (1, "")
