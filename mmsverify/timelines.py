"""The composition root of timelines: a recording of VR cells goes in, a picture comes out."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mmsverify.audit.parts import FRAMEWORK
from mmsverify.audit.replay import SAMPLES
from mmsverify.auditing import audit_traces
from mmsverify.errors import DecodeError, InputError, UsageError
from mmsverify.formats import vr
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.trace import TraceMessage
from mmsverify.model import load
from mmsverify.model.load import made_for
from mmsverify.profiles import for_recording
from mmsverify.resources import models_dir

if TYPE_CHECKING:
    from mmsverify.report.timeline import Line

__all__ = ["timeline_svg"]


def timeline_svg(path: Path, *, profile: Path | None = None, variant: str = "repaired") -> str:
    """Mode, status, commands and findings of each controller over time, as SVG.

    Changes alone are kept, so that the picture grows with what happens, not with the samples. Raises
    ``UsageError`` without the extra ``viz``, ``InputError`` for a recording without VR samples.
    """
    try:
        from mmsverify.report import timeline
    except ImportError as error:
        raise UsageError("pictures need matplotlib", cure="pip install 'mmsverify[viz]'") from error
    lines = _lines(path, profile, timeline.Line)
    if not lines:
        raise InputError(
            "shows no VR cells", place=str(path), cure="give a recording with samples of a controller"
        )
    findings = audit_traces([path], profile=profile, model=FRAMEWORK, variant=variant).findings
    return timeline.svg(timeline.draw(lines, findings))


def _lines(path: Path, profile: Path | None, line: type[Line]) -> list[Line]:
    trace = read_trace(path)
    tables = _tables(for_recording(profile, trace.profile, str(path))[FRAMEWORK])
    order = [*dict.fromkeys((*tables["C_RunMD"].values(), *tables["CS_RunSTA"].values()))]
    found: dict[str, Line] = {}
    for message in trace:
        if message.schema_name == SAMPLES:
            name = message.metadata.get("controller", "")
            drawn = found.setdefault(name, line(name, order, begin=message.time))
            drawn.end = message.time
            _go_on(drawn, message, tables)
    return list(found.values())


def _tables(profile: Mapping[str, Any]) -> dict[str, dict[float, str]]:
    """The words for the numbers of the three cells that are drawn, of the machine of a profile."""
    numbers = made_for(load(FRAMEWORK, models_dir(), "repaired"), profile).options["numbers"]
    statuses = numbers["status"](profile["sub_action_status"]).items()
    return {
        "C_RunMD": {number: str(word) for number, word in numbers["mode"].items()},
        "CS_RunSTA": {number: " or ".join(dict.fromkeys(map(str, words))) for number, words in statuses},
        "C_Cmd": {0: "", **numbers["command"]},
    }


def _go_on(drawn: Line, message: TraceMessage, tables: dict[str, dict[float, str]]) -> None:
    """What a sample changes; one that is no sample changes nothing, and is told as a finding."""
    try:
        cells = vr.decode(message.data).cells
    except DecodeError:
        return
    for cell, told in (("C_RunMD", drawn.modes), ("CS_RunSTA", drawn.statuses), ("C_Cmd", drawn.commands)):
        if cell in cells:
            word = tables[cell].get(vr.plain(cells[cell]), f"{vr.plain(cells[cell])}?")
            if not told or told[-1][1] != word:
                told.append((message.time, word))
