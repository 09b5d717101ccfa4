"""``mmsverify record``: how it ends, and what is told of a bad request."""

from __future__ import annotations

import os
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

import pytest
from wire import HOST, rows

from mmsverify.cli import main
from mmsverify.formats.mcap import read_trace

ASKED = bytes.fromhex("000100000006010100000008")
ANSWERED = bytes.fromhex("000100000004010101ff")


class Process:
    """``mmsverify record proxy`` as a process of its own."""

    def __init__(self, server: int, output: Path) -> None:
        command = ["record", "proxy", "--listen", f"{HOST}:0", "--to", f"{HOST}:{server}"]
        command += ["--protocol", "modbus", "-o", str(output), "--name", "cell7"]
        self.process = subprocess.Popen(
            [sys.executable, "-m", "mmsverify", *command],
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        assert self.process.stderr is not None
        told = self.process.stderr.readline()
        self.port = int(told.split(",")[0].rpartition(":")[2])

    def asks(self, times: int) -> None:
        """Ask so many times, and wait for each answer."""
        with socket.create_connection((HOST, self.port)) as client:
            for _ in range(times):
                client.sendall(ASKED)
                assert client.recv(1000) == ANSWERED

    def ended(self, number: signal.Signals) -> tuple[int, str, str]:
        """Exit status, stdout and stderr after a signal."""
        self.process.send_signal(number)
        out, err = self.process.communicate(timeout=20)
        return self.process.returncode, out, err


class Server:
    """A server in a process of its own, for a test without an event loop."""

    CODE = """
import socket, threading
server = socket.create_server(("127.0.0.1", 0))
print(server.getsockname()[1], flush=True)
def serve(link):
    while link.recv(1000):
        link.sendall(bytes.fromhex("%s"))
while True:
    threading.Thread(target=serve, args=(server.accept()[0],), daemon=True).start()
"""

    def __enter__(self) -> int:
        self.process = subprocess.Popen(
            [sys.executable, "-c", self.CODE % ANSWERED.hex()], stdout=subprocess.PIPE, text=True
        )
        assert self.process.stdout is not None
        return int(self.process.stdout.readline())

    def __exit__(self, *_: object) -> None:
        self.process.kill()
        self.process.communicate()


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_ctrl_c_leaves_a_whole_trace_and_a_summary(tmp_path: Path) -> None:
    output = tmp_path / "t.mcap"
    with Server() as server:
        recorder = Process(server, output)
        recorder.asks(3)
        status, out, err = recorder.ended(signal.SIGINT)
    assert status == 0
    assert out == f"{output}: 1 connection, 6 Modbus ADUs\n"
    assert "Traceback" not in err
    assert not read_trace(output).truncated
    assert len(rows(output)) == 8


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_after_a_kill_the_trace_can_be_read(tmp_path: Path) -> None:
    output = tmp_path / "t.mcap"
    with Server() as server:
        recorder = Process(server, output)
        recorder.asks(3)
        time.sleep(1.5)  # what a kill may cost is a second
        recorder.ended(signal.SIGKILL)
    assert [data for _, data in rows(output) if isinstance(data, bytes)] == [ASKED, ANSWERED] * 3
    assert read_trace(output).truncated


def refused(capsys: pytest.CaptureFixture[str], *arguments: str) -> str:
    assert main(["record", *arguments]) == 2
    told = capsys.readouterr()
    assert told.out == ""
    assert told.err.count("\n") == 1
    return told.err


@pytest.mark.parametrize(
    ("change", "told"),
    [
        ({"--listen": "nowhere"}, "--listen: cannot read 'nowhere' (write it like 10.0.0.5:502"),
        ({"--listen": "::1:502"}, "--listen: cannot read '::1:502'"),
        ({"--to": "127.0.0.1:99999"}, "--to: cannot read"),
        ({"--to": "127.0.0.1:1502"}, "--listen: is the controller itself"),
        ({"--to": "127.0.0.1:0"}, "127.0.0.1:0: nobody listens on port 0"),
        ({"--to": "no.such.invalid:502"}, "no.such.invalid: is not known here"),
        ({"--listen": f"{HOST}:{'9' * 5000}"}, "--listen: cannot read"),
        ({"--listen": "..:1502"}, "..:1502: cannot listen there"),
        ({"--protocol": "profinet"}, "--protocol: no protocol 'profinet' here (mms or modbus)"),
        ({"--name": "a/b"}, "--name: 'a/b' cannot name a channel"),
        ({"-o": "/nowhere/at/all.mcap"}, "/nowhere/at/all.mcap: its folder does not exist"),
    ],
)
def test_a_bad_request_is_one_line(
    change: dict[str, str], told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    options = {"--listen": f"{HOST}:1502", "--to": f"{HOST}:502", "--protocol": "modbus"}
    options |= {"-o": str(tmp_path / "t.mcap"), **change}
    words = [word for pair in options.items() for word in pair]
    assert told in refused(capsys, "proxy", *words)
    assert list(tmp_path.iterdir()) == []


def test_a_port_in_use_is_told_and_leaves_no_file(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "t.mcap"
    with socket.create_server((HOST, 0)) as taken:
        here = f"{HOST}:{taken.getsockname()[1]}"
        line = refused(
            capsys, "proxy", "--listen", here, "--to", HOST, "--protocol", "mms", "-o", str(output)
        )
    assert line.startswith(f"mmsverify: {here}: cannot listen there: ")
    assert not output.exists()


def test_a_recording_is_never_overwritten(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "t.mcap"
    output.write_bytes(b"precious")
    arguments = ["--listen", f"{HOST}:0", "--to", HOST, "--protocol", "mms", "-o", str(output)]
    assert "exists already" in refused(capsys, "proxy", *arguments)
    assert output.read_bytes() == b"precious"


def test_what_exists_is_left_alone_whatever_it_is(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    output = tmp_path / "pipe"
    os.mkfifo(output)
    arguments = ["--listen", f"{HOST}:0", "--to", HOST, "--protocol", "mms", "-o", str(output)]
    assert "exists already" in refused(capsys, "proxy", *arguments)
    assert output.exists()
