"""Options that commands share, so that they are spelt and explained alike everywhere."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

import typer

from mmsverify.errors import UsageError
from mmsverify.formats.locations import is_url, without_secrets


def place(option: str) -> Callable[[str], Path]:
    """What reads where an option says that something is to be written: on this machine, and not nowhere.

    Raises ``UsageError`` for an empty text and for a URL.
    """

    def read(text: str) -> Path:
        if not text:
            raise UsageError("is empty", place=option, cure="give a path, or leave it out")
        if is_url(text):
            cause = f"{without_secrets(text)} is on another machine, where nothing is written"
            raise UsageError(cause, place=option, cure="give a path of this one")
        return Path(text)

    return read


Output = Annotated[
    Path | None,
    typer.Option(
        "-o",
        "--output",
        metavar="FILE",
        parser=place("-o"),
        help="Write the result to FILE instead of stdout.",
    ),
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
