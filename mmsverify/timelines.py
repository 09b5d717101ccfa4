"""The composition root of timelines: a recording goes in, a picture comes out."""

from __future__ import annotations

from pathlib import Path

from mmsverify.auditing import audit_traces
from mmsverify.errors import InputError, UsageError
from mmsverify.incidents import timeline

__all__ = ["timeline_svg"]


def timeline_svg(path: Path, *, profile: Path | None = None, variant: str = "repaired") -> str:
    """What is known of each device over time, with findings and gaps, as SVG.

    Changes alone are kept, so that the picture grows with what happens, not with the messages. Raises
    ``UsageError`` without the extra ``viz``, ``InputError`` for a recording that no device is in.
    """
    try:
        from mmsverify.report import charts
    except ImportError as error:
        raise UsageError("pictures need Altair", cure="pip install 'mmsverify[viz]'") from error
    lines = timeline(path, profile=profile, variant=variant)
    if not lines:
        raise InputError("no device is in it", place=str(path), cure="give a recording of MMS, VR or Modbus")
    findings = audit_traces([path], profile=profile, model=None, variant=variant).findings
    return charts.timeline(lines, findings).svg()
