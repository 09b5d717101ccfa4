"""``mmsverify diagram``: draw a model's state diagram."""

from __future__ import annotations

from typing import Annotated

import typer

from mmsverify.commands.options import Output, OwnVariant, Quiet
from mmsverify.commands.output import emit, require_writable
from mmsverify.report import require_format

FORMATS = ("mermaid", "dot", "svg")


def diagram(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="The name of a model, or a model file.")],
    variant: OwnVariant = None,
    format: Annotated[str, typer.Option("--format", metavar="|".join(FORMATS))] = "mermaid",
    output: Output = None,
    quiet: Quiet = False,  # noqa: ARG001 (every command takes it; this one has nothing to be quiet about)
) -> int:
    """Draw the state diagram of a model."""
    require_format(format, FORMATS)
    require_writable(output)
    from mmsverify.diagrams import draw

    drawing = draw(model, variant=variant, format=format)
    emit(drawing if drawing.endswith("\n") else drawing + "\n", output)
    return 0
