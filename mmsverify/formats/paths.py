"""Inputs as a user names them: files, folders (searched by suffix) and glob patterns; also URLs."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from mmsverify.errors import UsageError
from mmsverify.formats.locations import Location, Url, located
from mmsverify.formats.remote import listed

TRACES = (".mcap",)
CAPTURES = (".pcap", ".pcapng", ".cap", ".csv")
Given = str | os.PathLike[str] | Url
"""An input as it is named."""


def trace_locations(given: Given | Iterable[Given]) -> list[Location]:
    """The recordings meant by one input or several, as `input_paths` says, on this machine or on others.

    A `Url` is one file, and stays as it is. Raises :class:`UsageError` for an empty text, ``TypeError`` for
    what is no path.
    """
    several = [given] if isinstance(given, str | os.PathLike | Url) else given
    return list(dict.fromkeys(found for each in several for found in _located(each)))


def _located(given: Given) -> Iterable[Location]:
    location = located(given)
    if isinstance(given, Url):
        return [given]
    return listed(location, TRACES) if isinstance(location, Url) else _meant(os.fspath(given), TRACES)


def input_paths(arguments: Iterable[str], suffixes: tuple[str, ...] = TRACES) -> list[Path]:
    """The files meant, in the order given, folders and patterns in alphabetical order, each once.

    Of a folder, the files with one of ``suffixes`` at any depth. An argument that leads to no file stays as
    it is: whoever opens it says what is wrong with it.
    """
    return list(dict.fromkeys(path for argument in arguments for path in _meant(argument, suffixes)))


def _meant(argument: str, suffixes: tuple[str, ...]) -> Iterator[Path]:
    if not argument:  # of an empty variable; a Path makes the folder of it in which we are
        raise UsageError("an input is an empty text", cure="name a file, a folder, a pattern or a URL")
    # Most shells expand patterns themselves; a quoted one they leave to us. A file whose name happens to hold
    # a bracket is that file.
    if not os.path.lexists(argument) and any(mark in argument for mark in "*?["):
        matches = sorted(glob.glob(argument, recursive=True))
    else:
        matches = []
    for match in matches or [argument]:
        yield from _inside(Path(match), suffixes)


def _inside(path: Path, suffixes: tuple[str, ...]) -> list[Path]:
    if not os.path.isdir(path):
        return [path]
    found = (Path(folder, name) for folder, _, names in os.walk(path) for name in names)
    return sorted(file for file in found if file.suffix.lower() in suffixes) or [path]
