"""A relay and servers of a test's own, all on the loopback address. What stands here claims nothing."""

from __future__ import annotations

import asyncio
import json
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager
from pathlib import Path

from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.formats.trace import Role
from mmsverify.recording import Address, Log, Recorded, Relay

HOST = "127.0.0.1"
Handler = Callable[[asyncio.StreamReader, asyncio.StreamWriter], Awaitable[None]]
Change = Callable[[bytes], bytes]


async def told_port(told: list[str]) -> int:
    """The port that a relay has said that it listens on."""
    while not told:
        await asyncio.sleep(0.01)
    return int(told[0].split(",")[0].rpartition(":")[2])


class Recording:
    """What a relay recorded: ``recorded`` once it has ended, and what it said meanwhile."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self.told: list[str] = []
        self.port = 0
        self.recorded: Recorded | None = None

    @property
    def rows(self) -> list[tuple[str, bytes | str]]:
        """Topic and message; of link events connection and event."""
        return rows(self.path)


def rows(path: Path) -> list[tuple[str, bytes | str]]:
    """The messages of a trace: topic and octets; of link events connection and event."""
    found: list[tuple[str, bytes | str]] = []
    for message in read_trace(path):
        if message.schema_name == "link.Event":
            event = json.loads(message.data)
            found.append((message.topic, f"{event['connection']} {event['event']}"))
        else:
            found.append((message.topic, message.data))
    return found


@asynccontextmanager
async def relaying(path: Path, server: int, role: Role = "modbus") -> AsyncIterator[Recording]:
    """A relay to a port of this machine; the trace is whole at the end."""
    made = Recording(path)
    log = Log(TraceWriter(path, indexed=False), "cell7")
    relay = Relay(Address(HOST, 0), Address(HOST, server), role, log, made.told.append)
    work = asyncio.create_task(relay.work())
    made.port = await told_port(made.told)
    try:
        yield made
        await asyncio.sleep(0.05)  # what is still on its way
    finally:
        work.cancel()
        await asyncio.gather(work, return_exceptions=True)
        made.recorded = log.end()


@asynccontextmanager
async def serving(handler: Handler) -> AsyncIterator[int]:
    """A server of the test's own; gives its port."""
    server = await asyncio.start_server(handler, HOST, 0)
    try:
        yield server.sockets[0].getsockname()[1]
    finally:
        server.close()


@asynccontextmanager
async def corrupting(server: int, change: Change) -> AsyncIterator[int]:
    """A wire that changes what the server says; gives the port of its near end."""

    async def passed(
        reader: asyncio.StreamReader, writer: asyncio.StreamWriter, how: Change | None = None
    ) -> None:
        while octets := await reader.read(1 << 16):
            writer.write(how(octets) if how else octets)
            await writer.drain()
        writer.close()

    async def joined(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        back, forth = await asyncio.open_connection(HOST, server)
        await asyncio.gather(passed(reader, forth), passed(back, writer, change), return_exceptions=True)

    async with serving(joined) as port:
        yield port


def nth(number: int, change: Change) -> Change:
    """Change only one of the octet strings that pass, by its place from 1."""
    count = 0

    def changed(octets: bytes) -> bytes:
        nonlocal count
        count += 1
        return change(octets) if count == number else octets

    return changed
