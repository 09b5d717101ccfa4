"""The composition root of an audit: files in, findings out.

Each recording is replayed device by device, event by event; a file that cannot be read spoils no other.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from mmsverify.audit.annotate import annotate
from mmsverify.audit.replay import Replay
from mmsverify.audit.spoken import Listener
from mmsverify.errors import InputError, MmsverifyError, ProfileError
from mmsverify.events import MmsEvent
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.profiles import from_metadata, load_profile, within_framework
from mmsverify.results import Audit, AuditedInput, Finding

__all__ = ["annotate", "audit_traces", "read_events"]

UNREADABLE = "input.unreadable"
"""The rule of a file that is no recording, or of the point at which one cannot be read on."""


def audit_traces(
    paths: Sequence[Path],
    *,
    profile: Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Callable[[str], None] | None = None,
    exact: bool = False,
) -> Audit:
    """Replay every trace against its model. An unreadable file is a finding; the others are audited.

    ``exact``: each message is judged by itself, and not by what was learned from those before: slow, and the
    same findings.
    """
    tables = load_profile(profile)
    inputs: list[AuditedInput] = []
    findings: list[Finding] = []
    for path in paths:
        if progress is not None:
            progress(f"auditing {path}")
        try:
            trace = read_trace(path)
            merged = tables if profile is not None else {**tables, **from_metadata(trace.profile, str(path))}
            entry, found = _audit(trace, merged, model, variant, exact=exact)
        except (InputError, ProfileError) as error:
            if profile is not None and isinstance(error, ProfileError):
                raise
            findings.append(_unreadable(path, error))
            continue
        inputs.append(entry)
        findings += found
    return Audit(inputs, findings)


def read_events(path: Path) -> Iterator[MmsEvent]:
    """The MMS messages of a recording as flat data, answers paired with requests; nothing is judged."""
    return Listener().events(read_trace(path))


def _audit(
    trace: McapTrace,
    tables: Mapping[str, Mapping[str, Any]],
    model: str | None,
    variant: str,
    *,
    exact: bool = False,
) -> tuple[AuditedInput, list[Finding]]:
    begin = time.perf_counter()
    replay = Replay(trace, within_framework(tables), model, variant, exact=exact)
    findings = list(_findings(replay, Path(trace.path)))
    if trace.truncated and not replay.messages and not findings:
        raise InputError(
            "cut off before the end of its first message",
            place=trace.path,
            cure="copy the recording again; one that still runs has its first messages after a second",
        )
    seconds = round(time.perf_counter() - begin, 3)
    return AuditedInput(
        trace.path, replay.messages, replay.events, replay.skipped, trace.truncated, seconds
    ), findings


def _findings(replay: Replay, path: Path) -> Iterator[Finding]:
    """What the replay finds, up to the point at which the recording cannot be read on."""
    try:
        yield from replay.run()
    except InputError as error:
        yield _unreadable(path, error)


def _unreadable(path: Path, error: MmsverifyError) -> Finding:
    return Finding(
        path=str(path), index=None, time=None, topic=None, vmd=None, severity="error", rule=UNREADABLE,
        clauses=("R-7.3.1-2",), message=str(error),
    )  # fmt: skip
