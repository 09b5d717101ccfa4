"""``mmsverify timeline``: draw what a controller's cells held over time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Output, Profile, Quiet, Variant
from mmsverify.commands.output import emit, require_writable


def timeline(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="An MCAP file with samples of VR cells.")],
    *,
    profile: Profile = None,
    variant: Variant = "repaired",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Draw mode, status, commands and findings of each controller over time, as SVG."""
    require_writable(output, [trace])
    from mmsverify.timelines import timeline_svg

    emit(timeline_svg(trace, profile=profile, variant=variant), output)
    return 0
