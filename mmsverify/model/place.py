"""Where in a model file something stands, and errors that say so."""

from __future__ import annotations

import sys
from pathlib import Path

from mmsverify.errors import ModelError

_HERE = str(Path(__file__).parent)


def caller() -> str:
    """``file:line`` of the innermost frame outside the language: the line of the model file being read."""
    frame = sys._getframe(1)
    while frame.f_back is not None and frame.f_code.co_filename.startswith((_HERE, "<frozen")):
        frame = frame.f_back
    return f"{frame.f_code.co_filename}:{frame.f_lineno}"


def mistake(cause: str, cure: str, place: str = "") -> ModelError:
    """The error for a line of a model file: where, what, and what to write instead."""
    return ModelError(cause, place=place or caller(), cure=cure)
