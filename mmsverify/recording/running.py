"""How a recording runs: until it is told to stop, or for a time; what it has is written out every second."""

from __future__ import annotations

import asyncio
import signal
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import NamedTuple, Protocol

from mmsverify.errors import UsageError
from mmsverify.recording.log import Log, Recorded

_EACH = 1.0  # seconds between two flushes: what a kill may cost


class Address(NamedTuple):
    """Where to listen or to connect to."""

    host: str
    port: int

    def __str__(self) -> str:
        return f"[{self.host}]:{self.port}" if ":" in self.host else f"{self.host}:{self.port}"


def address(text: str, place: str, port: int | None = None) -> Address:
    """``HOST:PORT`` or ``[IPV6]:PORT``; without a port, ``port`` if there is one.

    Raises ``UsageError``, which names ``place``.
    """
    cure = "write it like 10.0.0.5:502 or [::1]:502"
    host, colon, number = text.rpartition(":")
    if text.startswith("[") and text.endswith("]"):
        host, colon, number = text, "", ""
    elif not colon:
        host, number = text, ""
    if host.startswith("[") and host.endswith("]"):
        host = host[1:-1]
    elif ":" in host:
        raise UsageError(f"cannot read {text!r}", place=place, cure=cure)
    if not number and port is not None and not colon:
        number = str(port)
    if not host or not (number.isascii() and number.isdigit()) or int(number) > 65535:
        raise UsageError(f"cannot read {text!r}", place=place, cure=cure)
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
    stop = asyncio.Event()
    with _stopping(stop):
        tasks = [asyncio.create_task(work) for work in (source.work(), _flushing(log), stop.wait())]
        done, rest = await asyncio.wait(tasks, timeout=seconds, return_when=asyncio.FIRST_COMPLETED)
        for task in rest:
            task.cancel()
        await asyncio.gather(*rest, return_exceptions=True)
    for task in done:
        task.result()


async def _flushing(log: Log) -> None:
    while True:
        await asyncio.sleep(_EACH)
        log.flush()


@contextmanager
def _stopping(stop: asyncio.Event) -> Iterator[None]:
    loop = asyncio.get_running_loop()
    signals = (signal.SIGINT, signal.SIGTERM)
    with suppress(NotImplementedError, RuntimeError):  # no handlers on Windows, nor outside the main thread
        for number in signals:
            loop.add_signal_handler(number, stop.set)
    try:
        yield
    finally:
        with suppress(NotImplementedError, RuntimeError):
            for number in signals:
                loop.remove_signal_handler(number)
