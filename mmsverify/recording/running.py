"""How a recording runs: until it is told to stop, or for a time; what it has is written out every second."""

from __future__ import annotations

import asyncio
import signal
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import NamedTuple, Protocol

from mmsverify.errors import UsageError
from mmsverify.recording.log import Log, Recorded

_EACH = 1.0  # seconds between two flushes: what a kill may cost
_GRACE = 5.0  # seconds for a source to let go of its connections


class Address(NamedTuple):
    """Where to listen or to connect to."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"

    def resolved(self) -> Address:
        """The same with an address in numbers, so that no name has to be looked up later.

        Raises ``UsageError`` for a name that nobody knows.
        """
        try:
            found = socket.getaddrinfo(*self, type=socket.SOCK_STREAM)
        except (OSError, UnicodeError) as error:
            cause = f"is not known here: {getattr(error, 'strerror', None) or error}"
            raise UsageError(cause, place=self.host[:80], cure="give an address") from None
        return Address(*found[0][4][:2])


def address(text: str, place: str, port: int | None = None) -> Address:
    """``HOST:PORT`` or ``[IPV6]:PORT``; without a port, ``port`` if there is one.

    Raises ``UsageError``, which names ``place``.
    """
    host, colon, number = text.rpartition(":")
    if not colon or text.endswith("]"):
        host, number = text, "" if port is None else str(port)
    bracketed = host.startswith("[") and host.endswith("]")
    host = host[1:-1] if bracketed else host
    digits = number.isascii() and number.isdigit() and len(number) <= 5
    if not host or (":" in host and not bracketed) or not digits or int(number) > 65535:
        cure = "write it like 10.0.0.5:502 or [::1]:502"
        raise UsageError(f"cannot read {text[:80]!r}", place=place, cure=cure)
    return Address(host, int(number))


class Source(Protocol):
    """What records: a relay, a poller. It works until it is cancelled, and then lets go of its connections.

    Raises ``UsageError`` where it cannot begin.
    """

    async def work(self) -> None: ...


def run(source: Source, log: Log, seconds: float | None = None) -> Recorded:
    """Record until Ctrl-C, SIGTERM or for ``seconds``, and finish the trace."""
    try:
        with suppress(KeyboardInterrupt):  # where signals cannot be handled, as on Windows
            asyncio.run(_until_stopped(source, log, seconds))
    finally:
        recorded = log.end()
    return recorded


async def _until_stopped(source: Source, log: Log, seconds: float | None) -> None:
    # Where the system is out of sockets, asyncio would tell each client that it cannot accept by a traceback.
    asyncio.get_running_loop().set_exception_handler(lambda *_: None)
    stop = asyncio.Event()
    work = asyncio.create_task(source.work())
    others = [asyncio.create_task(stop.wait()), asyncio.create_task(_flushing(log))]
    with _stopping(stop):
        await asyncio.wait([work, others[0]], timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        log.flush()
        for task in [work, *others]:
            task.cancel()
        await asyncio.wait([work, *others], timeout=_GRACE)
    if work.done() and not work.cancelled():
        work.result()


async def _flushing(log: Log) -> None:
    while True:
        await asyncio.sleep(_EACH)
        log.flush()


@contextmanager
def _stopping(stop: asyncio.Event) -> Iterator[None]:
    """Let a signal set ``stop``; the second one of its kind does what it does without us."""
    loop = asyncio.get_running_loop()
    numbers = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]

    def stopped(number: signal.Signals) -> None:
        stop.set()
        loop.remove_signal_handler(number)

    with suppress(NotImplementedError, RuntimeError):  # no handlers on Windows, nor outside the main thread
        for number in numbers:
            loop.add_signal_handler(number, stopped, number)
    try:
        yield
    finally:
        with suppress(NotImplementedError, RuntimeError):
            for number in numbers:
                loop.remove_signal_handler(number)
