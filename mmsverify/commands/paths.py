"""Inputs as the command line names them: files, folders (searched by suffix) and glob patterns; also URLs."""

from __future__ import annotations

import glob
import os
from collections.abc import Iterable, Iterator
from pathlib import Path

from mmsverify.formats.locations import Location, Url, is_url
from mmsverify.formats.remote import listed

TRACES = (".mcap",)
CAPTURES = (".pcap", ".pcapng", ".cap", ".csv")


def trace_locations(arguments: Iterable[str]) -> list[Location]:
    """The recordings meant, as `input_paths` says, on this machine or on others."""
    return list(dict.fromkeys(found for argument in arguments for found in _located(argument)))


def _located(argument: str) -> Iterable[Location]:
    return listed(Url(argument), TRACES) if is_url(argument) else _meant(argument, TRACES)


def input_paths(arguments: Iterable[str], suffixes: tuple[str, ...] = TRACES) -> list[Path]:
    """The files meant, in the order given, folders and patterns in alphabetical order, each once.

    Of a folder, the files with one of ``suffixes`` at any depth. An argument that leads to no file stays as
    it is: whoever opens it says what is wrong with it.
    """
    return list(dict.fromkeys(path for argument in arguments for path in _meant(argument, suffixes)))


def _meant(argument: str, suffixes: tuple[str, ...]) -> Iterator[Path]:
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
