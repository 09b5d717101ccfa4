"""The relay: octets pass unchanged, ends pass as they came, and the trace says what happened."""

from __future__ import annotations

import asyncio
import random
import socket
import struct
from pathlib import Path

import pytest
from capture_wire import CC, CR, STATUS, STATUS_ANSWER, dt
from wire import HOST, relaying, serving, told_port

from mmsverify.formats.mcap import TraceWriter
from mmsverify.recording import Address, Log, Relay

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


def test_what_cannot_be_read_passes_unchanged_and_is_recorded(tmp_path: Path) -> None:
    garbage = random.Random(7).randbytes(200_000)

    async def talk() -> None:
        async with serving(echo) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write(garbage)
            assert await reader.readexactly(len(garbage)) == garbage
            writer.close()
        said = b"".join(data for topic, data in made.rows if topic == CLIENT and isinstance(data, bytes))
        assert said == garbage
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


def test_what_a_slow_client_has_not_read_yet_reaches_it(tmp_path: Path) -> None:
    long = bytes(3_000_000)

    async def pours(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await reader.read()
        writer.write(long)
        writer.close()

    async def talk() -> None:
        async with serving(pours) as port, relaying(tmp_path / "t.mcap", port) as made:
            reader, writer = await asyncio.open_connection(HOST, made.port)
            writer.write_eof()
            await asyncio.sleep(2.5)
            assert len(await reader.read(-1)) == len(long)
            writer.close()

    asyncio.run(talk())


@pytest.mark.parametrize("ticks", range(25))
def test_a_relay_ends_whenever_it_is_told_to(ticks: int, tmp_path: Path) -> None:
    async def talk() -> None:
        async with serving(answer) as port:
            log, told = Log(TraceWriter(tmp_path / "t.mcap"), "cell7"), list[str]()
            relay = Relay(Address(HOST, 0), Address(HOST, port), "modbus", log, told.append)
            work = asyncio.create_task(relay.work())
            _, writer = await asyncio.open_connection(HOST, await told_port(told))
            for _ in range(ticks):
                await asyncio.sleep(0)
            work.cancel()
            done, _ = await asyncio.wait([work], timeout=3)
            assert done
            writer.close()

    asyncio.run(talk())


def test_a_relay_that_would_relay_to_itself_turns_the_client_away(tmp_path: Path) -> None:
    async def talk() -> None:
        log, told = Log(TraceWriter(tmp_path / "t.mcap"), "cell7"), list[str]()
        with socket.socket() as free:
            free.bind((HOST, 0))
            port = free.getsockname()[1]
        relay = Relay(Address("0.0.0.0", port), Address(HOST, port), "modbus", log, told.append)
        work = asyncio.create_task(relay.work())
        reader, writer = await asyncio.open_connection(HOST, await told_port(told))
        with pytest.raises(ConnectionResetError):
            await reader.read()
        writer.close()
        work.cancel()
        await asyncio.wait([work])
        assert log.refused == 2  # the client, and the relay as its own client

    asyncio.run(talk())
