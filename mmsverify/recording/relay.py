"""A transparent TCP relay: octets pass unchanged, whatever they are, and are written down as they pass.

The end of a connection is passed on as it came, a half-close as a half-close and a reset as a reset; only a
reset by a side that had ended its half before is not seen. Octets are passed on first, and written down
before anything else is read: in the trace, too, no answer comes before its request.
"""

from __future__ import annotations

import asyncio
import socket
import struct
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field

from mmsverify.errors import UsageError
from mmsverify.formats.capture.link import Endpoint
from mmsverify.formats.trace import Role, Sender
from mmsverify.recording.log import Live, Log
from mmsverify.recording.running import Address

_AT_ONCE = 1 << 14
_PATIENCE = 10.0  # seconds to reach the server
_GRACE = 2.0  # seconds for what is still to be sent when the relay itself ends
_NO_LINGER = struct.pack("ii", 1, 0)


@dataclass(slots=True)
class Relay:
    """Listens, and passes each connection on to the server. ``tell`` is told what a watcher may want.

    ``server`` is an address in numbers (`Address.resolved`).
    """

    listen: Address
    server: Address
    role: Role
    log: Log
    tell: Callable[[str], None]
    _tasks: set[asyncio.Task[None]] = field(default_factory=set)
    _ports: set[int] = field(default_factory=set)

    async def work(self) -> None:
        """Relay until cancelled; then every connection is closed. Raises ``UsageError`` at a port in use."""
        try:
            listener = await asyncio.start_server(self._accepted, *self.listen)
        except (OSError, UnicodeError, OverflowError) as error:
            cause = f"cannot listen there: {getattr(error, 'strerror', None) or error}"
            raise UsageError(cause, place=str(self.listen), cure="free the port, or name another") from None
        ends = [Address(*each.getsockname()[:2]) for each in listener.sockets]
        self._ports = {end.port for end in ends}
        where = " and ".join(map(str, ends))
        self.tell(f"listening on {where}, passing on to {self.server}; Ctrl-C ends the recording")
        try:
            await asyncio.Event().wait()
        finally:
            listener.close()
            for task in self._tasks:
                task.cancel()
            await asyncio.gather(*self._tasks, return_exceptions=True)

    async def _accepted(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        # A task of our own: asyncio reports a cancelled handler of its own as an error.
        task = asyncio.create_task(self._connection(_End("client", reader, writer)))
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _connection(self, client: _End) -> None:
        server = None
        try:
            server = await self._reached()
            live = self.log.connection(self.role, client.peer, Endpoint(*self.server))
        except OSError as error:  # TimeoutError is one
            self.log.refused += 1
            reason = error.strerror or str(error) or f"no answer in {_PATIENCE:g} s"
            client.reset()
            self.tell(f"{self.server}: cannot be reached: {reason}; a client was turned away")
            return
        finally:
            if server is None:
                client.reset()
        await _joined(client, server, live)

    async def _reached(self) -> _End:
        # Not wait_for: in Python 3.11 it may swallow a cancellation.
        async with asyncio.timeout(_PATIENCE):
            server = _End("server", *await asyncio.open_connection(*self.server))
        if server.peer.port in self._ports and server.peer.address == server.here.address:
            server.reset()
            raise OSError(0, "that is this relay itself")
        return server


@dataclass(slots=True)
class _End:
    """One end of the relay: the socket towards the client or the server."""

    sender: Sender
    reader: asyncio.StreamReader
    writer: asyncio.StreamWriter

    def __post_init__(self) -> None:
        # A peer that vanishes without a word is noticed in the end, by the system's own probes.
        self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)

    @property
    def _socket(self) -> socket.socket:
        return self.writer.get_extra_info("socket")  # type: ignore[no-any-return]

    @property
    def peer(self) -> Endpoint:
        """Who is there."""
        return Endpoint(*(self.writer.get_extra_info("peername") or ("unknown", 0))[:2])

    @property
    def here(self) -> Endpoint:
        """Our own end."""
        return Endpoint(*(self.writer.get_extra_info("sockname") or ("unknown", 0))[:2])

    def reset(self) -> None:
        """End the connection at once, so that the peer sees a reset and no orderly end."""
        with suppress(OSError):
            self._socket.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, _NO_LINGER)
        self.writer.transport.abort()

    async def close(self) -> None:
        """End the connection in order, once the peer has taken what was said to it."""
        self.writer.close()
        with suppress(OSError):
            await self.writer.wait_closed()


async def _joined(client: _End, server: _End, live: Live) -> None:
    """Pass on what both say, until both have ended or one was reset."""
    ways = [asyncio.create_task(_passed(*pair, live)) for pair in ((client, server), (server, client))]
    try:
        done, _ = await asyncio.wait(ways, return_when=asyncio.FIRST_EXCEPTION)
        if any(way.exception() for way in done):
            live.end("reset")
            client.reset()
            server.reset()
        live.end("close")
        await asyncio.gather(client.close(), server.close())
    except asyncio.CancelledError:  # the relay itself ends
        live.end("close")
        try:
            async with asyncio.timeout(_GRACE):
                await asyncio.gather(client.close(), server.close())
        except TimeoutError:
            client.reset()
            server.reset()
        raise
    finally:
        for way in ways:
            way.cancel()
        await asyncio.gather(*ways, return_exceptions=True)


async def _passed(source: _End, target: _End, live: Live) -> None:
    while octets := await source.reader.read(_AT_ONCE):
        target.writer.write(octets)
        live.data(source.sender, octets)
        await target.writer.drain()
    target.writer.write_eof()
