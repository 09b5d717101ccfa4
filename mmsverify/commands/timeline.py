"""``mmsverify timeline``: draw what is known of the devices of a recording over time."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Output, Profile, Quiet, Variant
from mmsverify.commands.output import emit, require_writable


def timeline(
    trace: Annotated[Path, typer.Argument(metavar="TRACE", help="An MCAP file.")],
    *,
    profile: Profile = None,
    variant: Variant = "repaired",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Draw what is known of each device over time, with findings and gaps, as SVG."""
    require_writable(output, [trace])
    from mmsverify.timelines import timeline_svg

    emit(timeline_svg(trace, profile=profile, variant=variant), output)
    return 0
