"""The relay: octets pass unchanged, ends pass as they came, and the trace says what happened."""

from __future__ import annotations

import asyncio
import errno
import io
import os
import random
import signal
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from capture_wire import CC, CR, STATUS, STATUS_ANSWER, dt
from wire import HOST, relaying, rows, serving

from mmsverify.cli import main
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.recording import Log

ASKED = bytes.fromhex("000100000006010100000008")
ANSWERED = bytes.fromhex("000100000004010101ff")
CLIENT, SERVER, LINK = "/cell7/modbus/c1/client", "/cell7/modbus/c1/server", "/cell7/link"


async def echo(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while octets := await reader.read(1000):
        writer.write(octets)
        await writer.drain()
    writer.close()


async def answer(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    while await reader.read(1000):
        writer.write(ANSWERED)
    writer.close()


async def reset(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
    await reader.read(1000)
    held = writer.get_extra_info("socket")
    held.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, struct.pack("ii", 1, 0))
    writer.transport.abort()


def test_a_conversation_is_recorded_between_open_and_close(tmp_path: Path) -> None:
    async def talk() -> None:
        async with serving(answer) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(ASKED)
            assert await reader.read(1000) == ANSWERED
            writer.close()
            assert await reader.read() == b""
        assert made.rows == [(LINK, "c1 open"), (CLIENT, ASKED), (SERVER, ANSWERED), (LINK, "c1 close")]
        assert made.recorded is not None
        assert made.recorded.pdus == {"mms": 0, "modbus": 2, "vr": 0}

    asyncio.run(talk())


def test_what_cannot_be_read_passes_unchanged_and_is_told_as_a_gap(tmp_path: Path) -> None:
    garbage = random.Random(7).randbytes(200_000)

    async def talk() -> None:
        async with serving(echo) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(garbage)
            assert await reader.readexactly(len(garbage)) == garbage
            writer.close()
        assert (LINK, "c1 gap") in made.rows
        assert made.recorded is not None
        assert {each.layer for each in made.recorded.undecoded} == {"modbus"}

    asyncio.run(talk())


def test_a_half_close_passes_as_a_half_close(tmp_path: Path) -> None:
    async def last_word(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        assert await reader.read() == ASKED  # to the end, and only then
        writer.write(ANSWERED)
        writer.close()

    async def talk() -> None:
        async with serving(last_word) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(ASKED)
            writer.write_eof()
            assert await reader.read() == ANSWERED
            writer.close()

    asyncio.run(talk())


def test_a_reset_passes_as_a_reset(tmp_path: Path) -> None:
    async def talk() -> None:
        async with serving(reset) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(ASKED)
            with pytest.raises(ConnectionResetError):
                await reader.read()
            writer.close()
        assert made.rows[-1] == (LINK, "c1 reset")

    asyncio.run(talk())


def test_several_connections_do_not_mix(tmp_path: Path) -> None:
    async def one(port: int, number: int) -> None:
        reader, writer = await asyncio.open_connection(HOST, port)
        for step in range(20):
            asked = struct.pack(">HHHBBHH", number << 8 | step, 0, 6, 1, 1, 0, 8)
            writer.write(asked)
            assert await reader.readexactly(12) == asked
        writer.close()

    async def talk() -> None:
        async with serving(echo) as port, relaying(tmp_path / "t.mcap", port) as made:
            await asyncio.gather(*(one(made.port, number) for number in range(5)))
        said: dict[str, set[int]] = {}
        for topic, data in made.rows:
            if isinstance(data, bytes):
                said.setdefault(topic, set()).add(data[0])
        assert len(said) == 10
        assert all(len(numbers) == 1 for numbers in said.values())

    asyncio.run(talk())


def test_a_server_that_cannot_be_reached_turns_clients_away(tmp_path: Path) -> None:
    with socket.socket() as taken:
        taken.bind((HOST, 0))
        nobody = taken.getsockname()[1]

    async def talk() -> None:
        async with relaying(tmp_path / "t.mcap", nobody) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            with pytest.raises(ConnectionResetError):
                await reader.read()
            writer.close()
        assert made.recorded is not None
        assert (made.recorded.refused, made.recorded.connections) == (1, 0)
        assert "cannot be reached" in made.told[1]

    asyncio.run(talk())


def test_mms_is_taken_out_of_its_layers(tmp_path: Path) -> None:
    async def confirm(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await reader.readexactly(len(CR))
        writer.write(CC)
        await reader.readexactly(len(dt(STATUS)))
        writer.write(dt(STATUS_ANSWER))
        await reader.read()
        writer.close()

    async def talk() -> None:
        async with serving(confirm) as port, relaying(tmp_path / "t.mcap", port, "mms") as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(CR)
            await reader.readexactly(len(CC))
            whole = dt(STATUS)
            for octet in whole:  # TCP may cut anywhere
                writer.write(bytes([octet]))
                await writer.drain()
            await reader.readexactly(len(dt(STATUS_ANSWER)))
            writer.close()
        pdus = [row for row in made.rows if isinstance(row[1], bytes)]
        assert pdus == [("/cell7/mms/a1/client", STATUS), ("/cell7/mms/a1/server", STATUS_ANSWER)]

    asyncio.run(talk())


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


class Full(io.BytesIO):
    """A disk on which nothing fits any more after the first ``room`` octets."""

    room = 400

    def write(self, octets: Any, /) -> int:
        if self.tell() + len(octets) > self.room:
            raise OSError(errno.ENOSPC, "No space left on device")
        return super().write(octets)


def test_a_full_disk_ends_the_recording_and_not_the_traffic() -> None:
    log = Log(TraceWriter(Full(), compress=False))
    live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
    for _ in range(100):
        live.data("client", ASKED)
        log.flush()
    live.end("close")
    recorded = log.end()
    assert recorded.broken == "No space left on device"
    assert 0 < recorded.pdus["modbus"] < 100


def test_a_fault_of_a_reader_is_told_and_stops_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*_: object) -> list[bytes]:
        raise ZeroDivisionError("never so")

    log = Log(TraceWriter(io.BytesIO()))
    live = log.connection("modbus", Endpoint("client", 1), Endpoint("server", 2))
    monkeypatch.setattr(live.talk.reader, "feed", fails)
    live.data("client", ASKED)
    monkeypatch.undo()
    live.data("client", ASKED)
    recorded = log.end()
    assert [(each.layer, each.reason) for each in recorded.undecoded] == [
        ("recording", "ZeroDivisionError: never so")
    ]
    assert recorded.pdus["modbus"] == 1
