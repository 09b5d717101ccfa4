"""A Modbus library's own server and client, recorded and audited: nothing to find, until the wire lies."""

from __future__ import annotations

import asyncio
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

import pytest
from pymodbus.client import AsyncModbusTcpClient
from pymodbus.exceptions import ModbusException
from pymodbus.server import ModbusTcpServer
from pymodbus.simulator import DataType, SimData, SimDevice
from wire import HOST, corrupting, nth, relaying

from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap import TraceWriter
from mmsverify.recording import Address, Log, Poller, PollMap
from mmsverify.recording.points import Point, Read
from mmsverify.results import Finding

COILS = SimData(1, values=[False] * 960, datatype=DataType.BITS)
INPUTS = SimData(1001, values=[True, False] * 480, datatype=DataType.BITS)
WORDS = SimData(0, values=list(range(1024)), datatype=DataType.REGISTERS)


@asynccontextmanager
async def controller() -> AsyncIterator[int]:
    """A server that opens signals and registers as the built-in profile has them; gives its port."""
    device = SimDevice(1, simdata=([COILS], [INPUTS], [WORDS], [WORDS]))
    server = ModbusTcpServer(device, address=(HOST, 0))
    await server.serve_forever(background=True)
    try:
        listening: Any = server.transport
        yield listening.sockets[0].getsockname()[1]
    finally:
        await server.shutdown()  # type: ignore[no-untyped-call]


async def session(port: int) -> None:
    """Reads and writes of each kind that the text opens, and some that it must refuse."""
    client = AsyncModbusTcpClient(HOST, port=port, retries=0, timeout=1, reconnect_delay=0)
    assert await client.connect()
    await client.write_coil(1, True)
    await client.write_coils(2, [True, False] * 8)
    await client.read_coils(1, count=100)
    await client.read_discrete_inputs(1001, count=33)
    await client.write_register(5, 77)
    await client.write_registers(6, [1, 2, 3])
    await client.read_holding_registers(0, count=125)
    await client.read_input_registers(100, count=10)
    for _ in range(50):
        await client.read_coils(1, count=8)
    assert (await client.read_coils(30000, count=8)).isError()
    client.close()


def findings(trace: Path) -> list[Finding]:
    return list(audit_traces([trace], profile=None, model=None).findings)


def recorded(tmp_path: Path, change: Callable[[bytes], bytes] | None = None) -> list[Finding]:
    """The findings of a session, the server's octets changed on the wire."""
    trace = tmp_path / "t.mcap"

    async def talk() -> None:
        async with (
            controller() as server,
            corrupting(server, change or bytes) as wire,
            relaying(trace, wire) as made,
        ):
            try:
                await session(made.port)
            except (ModbusException, AssertionError):
                assert change is not None

    asyncio.run(talk())
    return findings(trace)


def test_a_conforming_session_is_audited_without_findings(tmp_path: Path) -> None:
    assert recorded(tmp_path) == []


@pytest.mark.parametrize(
    ("number", "change", "rule"),
    [
        (1, lambda o: o[:8] + b"\x00\x02" + o[10:], "modbus.response"),
        (3, lambda o: o[:8] + bytes([o[8] ^ 1]) + o[9:], "modbus.response"),
        (4, lambda o: o[:7] + b"\x01" + o[8:], "modbus.function"),
        (4, lambda o: o[:1] + bytes([o[1] ^ 0x55]) + o[2:], "modbus.unasked"),
        (7, lambda o: o[:6] + b"\x09" + o[7:], "modbus.unit"),
        (4, lambda o: o[:2] + b"\x01" + o[3:], "modbus.undecodable"),
        (4, lambda o: o[:5] + b"\xff" + o[6:], "modbus.undecodable"),
        (4, lambda o: o[:5] + b"\x01" + o[6:], "modbus.undecodable"),
        (59, lambda o: o[:5] + b"\x04" + o[6:7] + b"\x01\x01\x00", "access.beyond"),
    ],
)
def test_a_session_that_the_wire_corrupts_is_flagged(
    number: int, change: Callable[[bytes], bytes], rule: str, tmp_path: Path
) -> None:
    found = recorded(tmp_path, nth(number, change))
    assert [finding.rule for finding in found if finding.severity == "error"] == [rule]


def test_what_is_polled_of_it_is_audited_without_findings(tmp_path: Path) -> None:
    trace, told = tmp_path / "t.mcap", list[str]()
    points = PollMap(
        (Point("CF_Home", "coil", 1),), (Read("coil", 1, 64), Read("discrete", 1001, 64)), period=0.02
    )

    async def polled() -> None:
        async with controller() as port:
            log = Log(TraceWriter(trace), "press")
            work = asyncio.create_task(Poller(Address(HOST, port), points, log, told.append).work())
            await asyncio.sleep(0.3)
            work.cancel()
            await asyncio.gather(work, return_exceptions=True)
            counts = log.end().pdus
            assert counts["vr"] >= 3
            assert counts["modbus"] >= 12

    asyncio.run(polled())
    assert findings(trace) == []
