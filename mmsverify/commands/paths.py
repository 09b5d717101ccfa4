"""Traces as the command line names them: files, folders (searched for ``*.mcap``) and glob patterns."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

SUFFIX = ".mcap"


def trace_paths(arguments: Iterable[str]) -> list[Path]:
    """The traces meant, in the order given, folders and patterns in alphabetical order, each once.

    An argument that leads to no trace stays as it is: whoever opens it says what is wrong with it.
    """
    return list(dict.fromkeys(path for argument in arguments for path in _meant(argument)))


def _meant(argument: str) -> Iterator[Path]:
    # Most shells expand patterns themselves; a quoted one they leave to us. A file whose name happens to hold
    # a bracket is that file.
    if not os.path.lexists(argument) and any(mark in argument for mark in "*?["):
        matches = sorted(glob.glob(argument, recursive=True))
    else:
        matches = []
    for match in matches or [argument]:
        yield from _inside(Path(match))


def _inside(path: Path) -> list[Path]:
    if not os.path.isdir(path):
        return [path]
    found = (Path(folder, name) for folder, _, names in os.walk(path) for name in names)
    return sorted(trace for trace in found if trace.suffix.lower() == SUFFIX) or [path]
