"""Targets that take a file: importers, the reader of recordings, profiles, and whole audits.

The file stands in memory where the system has such a place, and is the same one for every input.
"""

from __future__ import annotations

import io
import os
import tempfile
from functools import cache
from pathlib import Path

from mmsverify.auditing import audit_traces, read_events
from mmsverify.formats.capture import import_captures
from mmsverify.formats.mcap import read_trace
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.profiles import ROBOT_TABLE, judge, load_profile
from mmsverify.report import AUDIT_FORMATS, render_audit, render_import

_MEMORY = Path("/dev/shm")


@cache
def _folder(process: int) -> tempfile.TemporaryDirectory[str]:  # noqa: ARG001 - a fork must not share it
    return tempfile.TemporaryDirectory(dir=_MEMORY if _MEMORY.is_dir() else None, prefix="fuzz-")


def written(octets: bytes, name: str) -> Path:
    """The input as a file of that name."""
    path = Path(_folder(os.getpid()).name) / name
    path.write_bytes(octets)
    return path


def capture(octets: bytes) -> bool:
    """A capture becomes a recording; what could be read, and what not, is told."""
    return _import(written(octets, "x.pcap"))


def table(octets: bytes) -> bool:
    """A table becomes a recording."""
    return _import(written(octets, "x.csv"))


def _import(path: Path) -> bool:
    with TraceWriter(io.BytesIO()) as writer:
        done = import_captures([path], writer)
    render_import(done, "text").encode()
    render_import(done, "json").encode()
    return any(sum(one.pdus.values()) for one in done)


def recording(octets: bytes) -> bool:
    """A recording is read from end to end."""
    return sum(len(batch) for batch in read_trace(written(octets, "x.mcap")).batches()) > 0


def events(octets: bytes) -> bool:
    """The MMS messages of a recording, answers paired with requests."""
    return len(list(read_events(written(octets, "x.mcap")))) > 0


def profile(octets: bytes) -> bool:
    """A profile is read, completed, and judged."""
    judge(load_profile(written(octets, "x.toml"))[ROBOT_TABLE])
    return True


def audit(octets: bytes) -> bool:
    """A recording is audited, and the findings told in every format."""
    found = audit_traces([written(octets, "x.mcap")], profile=None, model=None)
    for form in AUDIT_FORMATS:
        render_audit(found, form).encode()
    return bool(found.inputs)
