"""The composition root of an audit: files in, findings out.

Each recording is replayed device by device, event by event; a file that cannot be read spoils no other.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any, cast

from mmsverify.audit.annotate import annotate
from mmsverify.audit.kept import of_thread
from mmsverify.audit.replay import Replay
from mmsverify.audit.spoken import Listener
from mmsverify.audit.watching import FETCHING, Stages, Watcher, stage
from mmsverify.errors import InputError, MmsverifyError, ProfileError
from mmsverify.events import MmsEvent
from mmsverify.formats.locations import Location, Url, located
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.profiles import for_recording, load_profile, within_framework
from mmsverify.results import Audit, AuditedInput, Finding

__all__ = ["annotate", "audit_traces", "read_events"]

UNREADABLE = "input.unreadable"
"""The rule of a file that is no recording, or of the point at which one cannot be read on."""


@dataclass(frozen=True, slots=True)
class Manner:
    """How recordings are to be audited.

    ``exact``: each message is judged by itself, and not by what was learned from those before: slow, and the
    same findings. ``kernel``: whether compiled loops (extra ``fast``) follow what was learned; ``None``:
    where they are installed and the recording is long.
    """

    profile: Path | None = None
    model: str | None = None
    variant: str = "repaired"
    exact: bool = False
    kernel: bool | None = None


def audit_traces(
    paths: Sequence[str | Path | Url],
    *,
    profile: Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Watcher | None = None,
    exact: bool = False,
    kernel: bool | None = None,
    jobs: int = 1,
) -> Audit:
    """Replay every trace against its model. An unreadable file is a finding; the others are audited.

    A string such as ``s3://bucket/x.mcap`` is the URL of one file, which fsspec opens (extra ``remote``).
    ``exact`` as in `Manner`; ``jobs``: so many processes share the work. The result is the same.
    """
    manner = Manner(profile, model, variant, exact, kernel)
    load_profile(profile)  # a bad one is told before any work is done
    locations = [located(path) for path in paths]
    if jobs > 1 and len(paths) > 1:
        from mmsverify.audit.sharing import shared

        told = None if progress is None else lambda _: progress.finish()
        # A URL stands for a path there: it is passed on and shown, no more.
        done = shared(partial(audit_trace, manner=manner), cast("list[Path]", locations), jobs, told)
    else:
        done = [_announced(location, manner, progress) for location in locations]
    inputs: list[AuditedInput] = []
    findings: list[Finding] = []
    for entry, found in done:
        inputs += [entry] if entry is not None else []
        findings += found
    return Audit(inputs, findings)


def _announced(
    path: Location, manner: Manner, progress: Watcher | None
) -> tuple[AuditedInput | None, list[Finding]]:
    if progress is None:
        return audit_trace(path, manner)
    progress.begin(path)
    done = audit_trace(path, manner, progress.passed)
    progress.finish()
    return done


def audit_trace(
    path: Location, manner: Manner, passed: Stages | None = None
) -> tuple[AuditedInput | None, list[Finding]]:
    """Replay one trace; of one that cannot be read there is a finding that says so, and nothing else."""
    try:
        trace = read_trace(path, fetched=stage(FETCHING, passed))
        tables = for_recording(manner.profile, trace.profile, str(path))
        return _audit(trace, tables, manner, passed)
    except (InputError, ProfileError) as error:
        if manner.profile is not None and isinstance(error, ProfileError):
            raise
        return None, [_unreadable(str(path), error)]


def read_events(path: str | Path | Url) -> Iterator[MmsEvent]:
    """The MMS messages of a recording as flat data, answers paired with requests; nothing is judged."""
    return Listener().events(read_trace(path))


def _audit(
    trace: McapTrace, tables: Mapping[str, Mapping[str, Any]], manner: Manner, passed: Stages | None
) -> tuple[AuditedInput, list[Finding]]:
    begin = time.perf_counter()
    replay = Replay(
        trace,
        within_framework(tables),
        manner.model,
        manner.variant,
        exact=manner.exact,
        kept=None if manner.exact else of_thread(),
        kernel=manner.kernel,
        passed=passed,
    )
    findings = list(_findings(replay, trace.path))
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


def _findings(replay: Replay, path: str) -> Iterator[Finding]:
    """What the replay finds, up to the point at which the recording cannot be read on."""
    try:
        yield from replay.run()
    except InputError as error:
        yield _unreadable(path, error)


def _unreadable(path: str, error: MmsverifyError) -> Finding:
    return Finding(
        path=path, index=None, time=None, topic=None, vmd=None, severity="error", rule=UNREADABLE,
        clauses=("R-7.3.1-2",), message=str(error),
    )  # fmt: skip
