"""The composition root of an explanation: a recording and a sample in, the shortest legal way out."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from mmsverify.audit.parts import FRAMEWORK
from mmsverify.audit.replay import SAMPLES, Replay
from mmsverify.audit.vr import SCAN, Controller, Stage
from mmsverify.errors import InputError, MmsverifyError, UsageError
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.profiles import for_recording, within_framework
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
    tables = for_recording(profile, trace.profile, str(path))
    replay = Replay(trace, within_framework(tables), FRAMEWORK, variant)
    messages = iter(trace)
    last, findings = -1, []
    for message in messages:
        last = message.index
        if message.schema_name == SAMPLES:
            controller = replay.controller(message.channel)
            findings = list(controller.sample(message))
        if last == index:
            break
    else:
        raise _no_such(trace.path, index, last)
    if message.schema_name != SAMPLES:
        raise UsageError(
            f"message {index} shows no VR cells", place="INDEX", cure="give the index of a sample"
        )
    way, first = controller.way(), controller.at_first
    findings += _told_later(replay, controller, messages)
    found = tuple(finding for finding in findings if finding.index == index)
    wrong = any(finding.severity == "error" for finding in found)
    steps = None if wrong or way is None else tuple(map(_step, way))
    scan, name = message.metadata.get("sampling") == SCAN, message.metadata.get("controller", "")
    return Explanation(trace.path, index, name, scan, steps, found, first)


def _told_later(
    replay: Replay, controller: Controller, messages: Iterator[TraceMessage]
) -> Iterator[Finding]:
    """What the controller's next sample shows to be wrong."""
    for message in messages:
        if message.schema_name == SAMPLES and replay.controller(message.channel) is controller:
            yield from controller.sample(message)
            return


def _no_such(path: str, index: int, last: int) -> MmsverifyError:
    if last < 0:
        return InputError("holds no messages", place=path)
    return UsageError(f"there is no message {index}", place="INDEX", cure=f"give one of 0 to {last}")


def _step(stage: Stage) -> PathStep:
    name = stage.row.on.service if stage.row.answer else stage.row.name
    cited = stage.clause.ids + stage.clause.readings
    return PathStep(name, {}, cited, {"mode": stage.mode, "status": stage.status})
