"""The judge of one input: what may come of it, how long it may take, how much memory.

Time is the processor's: another program on the machine is no hang. An input that waits without working is
one too, after `PATIENCE`.
"""

from __future__ import annotations

import resource
import signal
import time
import traceback
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from mmsverify.errors import MmsverifyError
from mmsverify.formats import ber
from mmsverify.formats.capture.faults import UnreadableError

LONGEST = 1.0
"""Seconds of the processor's time that an input may take."""
PATIENCE = 10.0
"""Seconds by the clock on the wall."""
LARGEST = 1024
"""MiB that the process may hold at any time."""
_REFUSALS = (MmsverifyError, ber.Fault, UnreadableError)


class Hang(BaseException):
    """The input took too long. It is no `Exception`: what is watched must not catch it."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """What became of one input; ``fault`` is empty where nothing is wrong."""

    accepted: bool
    milliseconds: float
    fault: str = ""


class Watch:
    """Runs inputs one by one in this process, and the main thread of it; a context manager for its alarm.

    ``largest``: the MiB that the process may hold, ``None`` where its size is not looked at. ``longest``: the
    seconds that an input may take.
    """

    def __init__(self, largest: float | None = LARGEST, longest: float = LONGEST) -> None:
        self._longest = longest
        self._began = self._began_wall = 0.0
        self._running = False
        self._largest = largest

    def __enter__(self) -> Watch:
        self._before = signal.signal(signal.SIGALRM, self._late)
        return self

    def __exit__(self, *_: object) -> None:
        signal.signal(signal.SIGALRM, self._before)

    def judge(self, run: Callable[[bytes], bool], octets: bytes) -> Judgement:
        """What becomes of an input.

        ``run`` says whether it accepts it, or raises one of the documented errors.
        """
        signal.setitimer(signal.ITIMER_REAL, self._longest, self._longest / 4)
        self._began, self._began_wall = time.process_time(), time.monotonic()
        accepted, fault, before = False, "", peak()
        try:
            accepted = self._watched(run, octets)
        except _REFUSALS:
            pass
        except Hang:
            fault = "hang"
        except BaseException as error:  # whatever it is, it is what is looked for
            fault = told(error)
        seconds = time.process_time() - self._began
        signal.setitimer(signal.ITIMER_REAL, 0)
        if not fault and seconds > self._longest:
            fault = "hang"
        if not fault and self._largest is not None and peak() > max(self._largest, before):
            fault = "memory"
        return Judgement(accepted, 1000 * seconds, fault)

    def _watched(self, run: Callable[[bytes], bool], octets: bytes) -> bool:
        self._running = True
        try:
            return run(octets)
        finally:
            self._running = False  # an alarm that comes from here on interrupts nothing

    def _late(self, number: int, frame: FrameType | None) -> None:  # noqa: ARG002
        if not self._running:
            return
        waited = time.monotonic() - self._began_wall
        if time.process_time() - self._began > self._longest or waited > PATIENCE:
            raise Hang


def peak() -> float:
    """The most memory that this process has held, in MiB."""
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    return _own_peak() or most if most > LARGEST else most


def _own_peak() -> float:
    """The same without what the process that started this one has held, where the system tells it."""
    try:
        lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    except OSError:
        return 0.0
    return sum(int(line.split()[1]) for line in lines if line.startswith("VmHWM")) / 1024


def told(error: BaseException) -> str:
    """An error and where it was raised, in one line."""
    frames = [each for each in traceback.extract_tb(error.__traceback__) if "mmsverify" in each.filename]
    where = f" at {frames[-1].filename.rpartition('mmsverify/')[2]}:{frames[-1].lineno}" if frames else ""
    return f"{type(error).__name__}: {str(error)[:120]}{where}"
