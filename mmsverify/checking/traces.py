"""Counterexamples and witnesses as recordings that ``mmsverify audit`` reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from mmsverify.checking.robot_trace import conversation, profile_of
from mmsverify.errors import UsageError
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.mms import encode
from mmsverify.formats.trace import Channel
from mmsverify.results import ModelCheck, PathStep

ROBOT = "mms-robot"
BEGIN, PAUSE = 1_764_000_000_000_000_000, 10_000_000
"""The capture time of the first message, and the time between two, in ns."""


def write_counterexamples(checks: Sequence[ModelCheck], directory: Path) -> list[Path]:
    """One recording for each counterexample and witness of the robot model; the paths that were written.

    The messages of other models do not follow from their rows: where nothing else is asked for, that is a
    ``UsageError``.
    """
    robots = [check for check in checks if check.model == ROBOT]
    if not robots:
        raise UsageError("only runs of mms-robot can be written as traces", place="--counterexamples",
                         cure="leave the option out; the runs stand in the result")  # fmt: skip
    try:
        directory.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        cause = f"cannot be made: {error.strerror}"
        raise UsageError(cause, place=str(directory), cure="name a folder") from None
    return [write_run(steps, directory / name) for check in robots for name, steps in _runs(check)]


def _runs(check: ModelCheck) -> list[tuple[str, tuple[PathStep, ...]]]:
    return [
        (f"{check.model}.{check.variant}.{verdict.name}.{kind}.mcap", steps)
        for verdict in check.verdicts
        for kind, steps in (("counterexample", verdict.counterexample), ("witness", verdict.witness))
        if steps
    ]


def write_run(steps: Sequence[PathStep], path: Path) -> Path:
    """One run of the robot model as a recording of the device ``robot``."""
    with TraceWriter(path) as trace:
        trace.add_profile(profile_of(steps[0]))
        for number, sent in enumerate(conversation(steps)):
            channel = Channel.mms("robot", sent.association, sent.sender)
            trace.add(BEGIN + number * PAUSE, channel, encode(sent.pdu))
    return path
