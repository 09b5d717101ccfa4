"""The composition root of an audit: files in, findings out.

Each recording is replayed device by device, event by event; a file that cannot be read spoils no other.
"""

from __future__ import annotations

import os
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mmsverify.audit.learning.lasting import of_thread
from mmsverify.audit.replay import Replay
from mmsverify.audit.spoken import Listener
from mmsverify.errors import InputError, MmsverifyError, ProfileError
from mmsverify.events import MmsEvent
from mmsverify.fleet.tasks import Done, Engine, Task, here, unreadable
from mmsverify.formats.locations import Location, Url
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.formats.passing import FETCHING, Stages, Watcher, stage
from mmsverify.formats.paths import Given, trace_locations
from mmsverify.profiles import from_metadata, load_profile, within_framework
from mmsverify.results import Audit, AuditedInput, Finding

if TYPE_CHECKING:
    from mmsverify.fleet.cluster import Client

__all__ = ["audit_each", "audit_traces", "read_events"]

Tables = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Manner:
    """How recordings are to be audited: all that a result depends on, beside the recording and the program.

    ``tables``: the profile, read once; ``given``: it was asked for, and what a recording says of itself does
    not count. ``exact``: each message is judged by itself, and not by what was learned from those before:
    slow, and the same findings. ``kernel``: whether compiled loops (extra ``fast``) follow what was learned;
    ``None``: where they are installed and the recording is long.
    """

    tables: Tables
    given: bool
    model: str | None = None
    variant: str = "repaired"
    exact: bool = False
    kernel: bool | None = None


@dataclass(frozen=True, slots=True)
class Sharing:
    """Who does the work: so many processes, or a Dask cluster, by its address or by a client of it.

    ``resume``: the folder in which finished results are kept. Raises ``ValueError`` for fewer than one of
    ``jobs``.
    """

    jobs: int | None = None
    scheduler: str | None = None
    client: Client | None = None
    resume: Path | None = None

    def __post_init__(self) -> None:
        if self.jobs is not None and self.jobs < 1:
            raise ValueError(f"jobs: {self.jobs} processes cannot share the work (give 1 or more, or None)")


def audit_traces(
    paths: Given | Iterable[Given],
    *,
    profile: str | Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Watcher | None = None,
    exact: bool = False,
    kernel: bool | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    client: Client | None = None,
    resume: str | Path | None = None,
) -> Audit:
    """Replay every trace against its model. An unreadable file is a finding; the others are audited.

    ``paths``: one input or several, as on the command line: files, folders (all recordings in them, at any
    depth), glob patterns, and URLs of these such as ``s3://bucket/x.mcap``, which fsspec opens (extra
    ``remote``). Each recording is audited once. None at all: an audit of nothing.
    ``profile``: a TOML file, or the name of a shipped one; ``None``: what each recording says of itself.
    ``model``: a model's name, whatever a recording says; ``None``: the one for what is in it.
    ``exact`` and ``kernel`` as in `Manner`. ``jobs``: so many processes share the work. ``scheduler``: the
    workers of a Dask cluster do, that of this address, or with ``local`` one of ``jobs`` processes (without:
    one a core), which ends with the audit; ``client``: those of the cluster that a ``distributed.Client`` is
    connected to. That there are no workers for some seconds is a warning of the logger ``mmsverify.fleet``.
    ``resume``: a folder where the results of finished recordings are kept; an audit that was broken off goes
    on from there. The result is the same, whoever does the work and in whatever order.

    Raises :class:`ProfileError` for a bad profile, :class:`UsageError` for a scheduler that does not answer,
    workers that cannot be started, a folder that is not for results, an empty path; ``ValueError`` for fewer
    than one of ``jobs``.
    """
    manner = _manner(profile, model, variant, exact=exact, kernel=kernel)
    sharing = Sharing(jobs, scheduler, client, None if resume is None else Path(resume))
    locations = trace_locations(paths)
    done = dict(_results(locations, manner, sharing, progress))
    inputs: list[AuditedInput] = []
    findings: list[Finding] = []
    for number in range(len(locations)):
        entry, found = done.pop(number)
        inputs += [entry] if entry is not None else []
        findings += found
    return Audit(inputs, findings)


def audit_each(
    paths: Given | Iterable[Given],
    *,
    profile: str | Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Watcher | None = None,
    exact: bool = False,
    kernel: bool | None = None,
    jobs: int | None = None,
    scheduler: str | None = None,
    client: Client | None = None,
    resume: str | Path | None = None,
) -> Iterator[Audit]:
    """The same, an `Audit` a recording, as they come: no more than what is under way is held in memory."""
    manner = _manner(profile, model, variant, exact=exact, kernel=kernel)
    sharing = Sharing(jobs, scheduler, client, None if resume is None else Path(resume))
    results = _results(trace_locations(paths), manner, sharing, progress)
    return (Audit([] if entry is None else [entry], found) for _, (entry, found) in results)


def _manner(
    profile: str | Path | None, model: str | None, variant: str, *, exact: bool, kernel: bool | None
) -> Manner:
    return Manner(load_profile(profile), profile is not None, model, variant, exact, kernel)


def _results(
    locations: Sequence[Location], manner: Manner, sharing: Sharing, progress: Watcher | None
) -> Iterator[tuple[int, Done]]:
    """The numbers of the recordings with their results, as they come."""
    task = partial(audit_trace, manner=manner)
    kept = None
    if sharing.resume is not None:
        from mmsverify.fleet.kept import Kept

        kept = Kept(sharing.resume, manner)  # refused, if it must be, before workers are begun
    with _engine(len(locations), sharing, progress) as engine:
        yield from (engine if kept is None else kept.around(engine))(task, locations)


@contextmanager
def _engine(count: int, sharing: Sharing, progress: Watcher | None) -> Iterator[Engine]:
    """Who does the work. What the engines of several processes need is loaded where they are asked for."""
    if sharing.client is not None:
        from mmsverify.fleet import cluster

        yield _announcing(partial(cluster.shared, client=sharing.client), progress)
    elif sharing.scheduler is not None:
        from mmsverify.fleet import cluster

        workers = min(sharing.jobs or os.cpu_count() or 1, max(count, 1))
        with cluster.connected(sharing.scheduler, workers) as client:
            if progress is not None and not client.nthreads():
                progress.wait(f"waiting for workers of {sharing.scheduler}")
            yield _announcing(partial(cluster.shared, client=client), progress)
    elif (jobs := sharing.jobs or 1) > 1 and count > 1:
        from mmsverify.fleet import processes

        yield _announcing(partial(processes.shared, jobs=jobs), progress)
    else:
        yield partial(here, progress=progress)


def _announcing(engine: Engine, progress: Watcher | None) -> Engine:
    """The same engine, which tells what is done."""

    def run(task: Task, paths: Sequence[Location]) -> Iterator[tuple[int, Done]]:
        for result in engine(task, paths):
            if progress is not None:
                progress.finish()
            yield result

    return run


def audit_trace(path: Location, passed: Stages | None = None, *, manner: Manner) -> Done:
    """Replay one trace; of one that cannot be read there is a finding that says so, and nothing else."""
    try:
        trace = read_trace(path, fetched=stage(FETCHING, passed))
        said = {} if manner.given else from_metadata(trace.profile, str(path))
        return _audit(trace, {**manner.tables, **said}, manner, passed)
    except (InputError, ProfileError) as error:
        if manner.given and isinstance(error, ProfileError):
            raise
        return None, [unreadable(str(path), str(error))]


def read_events(path: str | Path | Url) -> Iterator[MmsEvent]:
    """The MMS messages of a recording as flat data, answers paired with requests; nothing is judged."""
    return Listener().events(read_trace(path))


def _audit(
    trace: McapTrace, tables: Tables, manner: Manner, passed: Stages | None
) -> tuple[AuditedInput, list[Finding]]:
    begin = time.perf_counter()
    replay = Replay(
        trace,
        within_framework(tables),
        manner.model,
        manner.variant,
        exact=manner.exact,
        lasting=None if manner.exact else of_thread(),
        kernel=manner.kernel,
        passed=passed,
    )
    try:
        findings = list(_findings(replay, trace.path))
    except MmsverifyError:
        raise
    except BaseException:
        of_thread().clear()
        raise
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
        yield unreadable(path, str(error))
