"""Options that commands share, so that they are spelt and explained alike everywhere."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

Output = Annotated[
    Path | None,
    typer.Option("-o", "--output", metavar="FILE", help="Write the result to FILE instead of stdout."),
]
Quiet = Annotated[bool, typer.Option("-q", "--quiet", help="No progress and no remarks on stderr.")]
Profile = Annotated[
    Path | None,
    typer.Option(
        "--profile", metavar="FILE|NAME", help="What the implementer decided (TOML, or a shipped profile)."
    ),
]
VARIANT_HELP = "as-written: the standard's text as it stands; repaired: with its faults mended."
Variant = Annotated[str, typer.Option("--variant", metavar="as-written|repaired", help=VARIANT_HELP)]
OwnVariant = Annotated[
    str | None, typer.Option("--variant", metavar="as-written|repaired", help=VARIANT_HELP)
]
"""Where none is named: repaired if the model has it, else its only one."""
