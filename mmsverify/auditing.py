"""The composition root of an audit: files in, findings out.

Each recording is replayed device by device, event by event; a file that cannot be read spoils no other.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mmsverify.audit.annotate import annotate
from mmsverify.audit.replay import Replay
from mmsverify.audit.spoken import Listener
from mmsverify.errors import InputError, ProfileError
from mmsverify.events import MmsEvent
from mmsverify.fleet.tasks import Done, Engine, here, unreadable
from mmsverify.formats.mcap import McapTrace, read_trace
from mmsverify.profiles import from_metadata, load_profile, within_framework
from mmsverify.results import Audit, AuditedInput, Finding

if TYPE_CHECKING:
    from mmsverify.fleet.cluster import Client

__all__ = ["annotate", "audit_each", "audit_traces", "read_events"]

Tables = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Manner:
    """How recordings are to be audited: all that a result depends on, beside the recording and the program.

    ``tables``: the profile, read once; ``given``: it was asked for, and what a recording says of itself does
    not count. ``exact``: each message is judged by itself, and not by what was learned from those before:
    slow, and the same findings.
    """

    tables: Tables
    given: bool
    model: str | None = None
    variant: str = "repaired"
    exact: bool = False


@dataclass(frozen=True, slots=True)
class Sharing:
    """Who does the work: so many processes, or a Dask cluster, by its address or by a client of it.

    ``resume``: the folder in which finished results are kept.
    """

    jobs: int | None = None
    scheduler: str | None = None
    client: Client | None = None
    resume: Path | None = None


def audit_traces(
    paths: Sequence[Path],
    *,
    profile: Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Callable[[str], None] | None = None,
    exact: bool = False,
    jobs: int | None = None,
    scheduler: str | None = None,
    client: Client | None = None,
    resume: Path | None = None,
) -> Audit:
    """Replay every trace against its model. An unreadable file is a finding; the others are audited.

    ``exact`` as in `Manner`. ``jobs``: so many processes share the work. ``scheduler``: the workers of a Dask
    cluster do, that of this address, or with ``local`` one of ``jobs`` processes (without: one a core), which
    ends with the audit; ``client``: those of the cluster that a ``distributed.Client`` is connected to.
    ``resume``: a folder where the results of finished recordings are kept; an audit that was broken off goes
    on from there. The result is the same, whoever does the work and in whatever order.

    Raises :class:`ProfileError` for a bad profile, :class:`UsageError` for a scheduler that does not answer,
    workers that cannot be started, a folder that is not for results.
    """
    manner = _manner(profile, model, variant, exact)
    sharing = Sharing(jobs, scheduler, client, resume)
    done = dict(_results(paths, manner, sharing, progress))
    inputs: list[AuditedInput] = []
    findings: list[Finding] = []
    for number in range(len(paths)):
        entry, found = done.pop(number)
        inputs += [entry] if entry is not None else []
        findings += found
    return Audit(inputs, findings)


def audit_each(
    paths: Sequence[Path],
    *,
    profile: Path | None,
    model: str | None,
    variant: str = "repaired",
    progress: Callable[[str], None] | None = None,
    exact: bool = False,
    jobs: int | None = None,
    scheduler: str | None = None,
    client: Client | None = None,
    resume: Path | None = None,
) -> Iterator[Audit]:
    """The same, an `Audit` a recording, as they come: no more than what is under way is held in memory."""
    manner = _manner(profile, model, variant, exact)
    sharing = Sharing(jobs, scheduler, client, resume)
    results = _results(paths, manner, sharing, progress)
    return (Audit([] if entry is None else [entry], found) for _, (entry, found) in results)


def _manner(profile: Path | None, model: str | None, variant: str, exact: bool) -> Manner:
    return Manner(load_profile(profile), profile is not None, model, variant, exact)


def _results(
    paths: Sequence[Path], manner: Manner, sharing: Sharing, progress: Callable[[str], None] | None
) -> Iterator[tuple[int, Done]]:
    """The numbers of the paths with their results, as they come."""
    task = partial(audit_trace, manner=manner)
    kept = None
    if sharing.resume is not None:
        from mmsverify.fleet.kept import Kept

        kept = Kept(sharing.resume, manner)  # refused, if it must be, before workers are begun
    with _engine(paths, sharing, progress) as engine:
        does = engine if kept is None else kept.around(engine)
        for count, result in enumerate(does(task, paths), start=1):
            if progress is not None and len(paths) > 1:
                progress(f"audited {count} of {len(paths)}")
            yield result


@contextmanager
def _engine(
    paths: Sequence[Path], sharing: Sharing, progress: Callable[[str], None] | None
) -> Iterator[Engine]:
    """Who does the work. What the engines of several processes need is loaded where they are asked for."""
    if sharing.client is not None:
        from mmsverify.fleet import cluster

        yield partial(cluster.shared, client=sharing.client)
    elif sharing.scheduler is not None:
        from mmsverify.fleet import cluster

        workers = min(sharing.jobs or os.cpu_count() or 1, max(len(paths), 1))
        with cluster.connected(sharing.scheduler, workers) as client:
            if progress is not None and not client.nthreads():
                progress(f"waiting for workers of {sharing.scheduler}")
            yield partial(cluster.shared, client=client)
    elif (jobs := sharing.jobs or 1) > 1 and len(paths) > 1:
        from mmsverify.fleet import processes

        yield partial(processes.shared, jobs=jobs)
    else:
        yield partial(here, progress=progress)


def audit_trace(path: Path, manner: Manner) -> Done:
    """Replay one trace; of one that cannot be read there is a finding that says so, and nothing else."""
    try:
        trace = read_trace(path)
        said = {} if manner.given else from_metadata(trace.profile, str(path))
        return _audit(trace, {**manner.tables, **said}, manner)
    except (InputError, ProfileError) as error:
        if manner.given and isinstance(error, ProfileError):
            raise
        return None, [unreadable(path, str(error))]


def read_events(path: Path) -> Iterator[MmsEvent]:
    """The MMS messages of a recording as flat data, answers paired with requests; nothing is judged."""
    return Listener().events(read_trace(path))


def _audit(trace: McapTrace, tables: Tables, manner: Manner) -> tuple[AuditedInput, list[Finding]]:
    begin = time.perf_counter()
    replay = Replay(trace, within_framework(tables), manner.model, manner.variant, exact=manner.exact)
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
        yield unreadable(path, str(error))
