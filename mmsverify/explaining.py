"""The composition root of an explanation: a recording and a sample in, the shortest legal way out."""

from __future__ import annotations

from pathlib import Path

from mmsverify.audit.replay import FRAMEWORK, SAMPLES, Replay
from mmsverify.audit.vr import SCAN, Stage
from mmsverify.errors import InputError, UsageError
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.profiles import from_metadata, load_profile, within_framework
from mmsverify.results import Explanation, Finding, PathStep

__all__ = ["explain_sample"]


def explain_sample(
    path: Path, index: int, *, profile: Path | None = None, variant: str = "repaired"
) -> Explanation:
    """How the message ``index`` of a recording, a sample of VR cells, follows from the sample before it.

    ``index`` counts from 0 over all messages in event order, as findings do. Raises ``UsageError`` where no
    such message stands there, or none that shows VR cells.
    """
    trace = read_trace(path)
    tables = load_profile(profile) if profile is not None else from_metadata(trace.profile, str(path))
    replay = Replay(trace, within_framework({**load_profile(None), **tables}), FRAMEWORK, variant)
    last = -1
    for message in trace:
        last = message.index
        if message.schema_name == SAMPLES:
            controller = replay.controller(message)
            findings = tuple(controller.sample(message))
            if message.index == index:
                return _explanation(trace.path, message, controller.way(), findings)
        elif message.index == index:
            raise UsageError(
                f"message {index} shows no VR cells", place="INDEX", cure="give the index of a sample"
            )
    if last < 0:
        raise InputError("holds no messages", place=trace.path)
    raise UsageError(f"there is no message {index}", place="INDEX", cure=f"give one of 0 to {last}")


def _explanation(
    path: str, message: TraceMessage, way: tuple[Stage, ...] | None, findings: tuple[Finding, ...]
) -> Explanation:
    steps = None if way is None else tuple(map(_step, way))
    scan = message.metadata.get("sampling") == SCAN
    return Explanation(path, message.index, message.metadata.get("controller", ""), scan, steps, findings)


def _step(stage: Stage) -> PathStep:
    name = stage.row.on.service if stage.row.answer else stage.row.name
    cited = stage.clause.ids + stage.clause.readings
    return PathStep(name, {}, cited, {"mode": stage.mode, "status": stage.status})
