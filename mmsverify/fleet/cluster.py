"""The engine of a Dask cluster: its workers audit, one recording a task.

The only module that needs ``distributed``, which the extra ``dask`` installs. Scheduler and workers need
mmsverify, in the same version, and the workers must see the recordings at the same paths. What a worker was
at when it died is done again by Dask; a recording under which that happens too often is tried once more by
itself, and if it kills the process then, too, it is told as one that cannot be read.
"""

from __future__ import annotations

import gc
import logging
import threading
import warnings
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import CancelledError
from contextlib import contextmanager, suppress
from dataclasses import replace
from functools import partial
from importlib import import_module
from typing import TYPE_CHECKING

from mmsverify import __version__
from mmsverify.errors import UsageError
from mmsverify.fleet.interrupts import held_back
from mmsverify.fleet.tasks import LOCAL, SELDOM, Done, Task, killed
from mmsverify.formats.locations import Location, Url

if TYPE_CHECKING:
    from distributed import Client, Future

__all__ = ["Client", "connected", "shared"]

PATIENCE = 5
"""Seconds that a scheduler has to answer."""
LONG = 4
"""Seconds without any worker after which that is told, as a warning of the logger ``mmsverify.fleet``."""
CHATTY = {"distributed", "tornado", "asyncio"}
"""Who logs what happens to a cluster."""
EXTRA = "pip install 'mmsverify[dask]'"
_log = logging.getLogger("mmsverify.fleet")
_alone = threading.Lock()
"""Held while a task is done: threads would hinder one another, and a model is loaded by one alone."""


@contextmanager
def connected(scheduler: str, workers: int) -> Iterator[Client]:
    """A client of the scheduler at that address, or of a cluster of so many processes of this machine.

    That cluster ends with the context. Raises :class:`UsageError` without the extra, for an address that is
    none, and for a scheduler that does not answer.
    """
    try:
        import distributed
    except ImportError as error:
        raise UsageError("Dask needs distributed", cure=EXTRA) from error
    with _silence():
        if scheduler == LOCAL:
            with _local(workers) as cluster, distributed.Client(cluster, set_as_default=False) as client:
                yield client
        else:
            with _client(scheduler) as client:
                yield client


def shared(task: Task, paths: Sequence[Location], *, client: Client) -> Iterator[tuple[int, Done]]:
    """The engine, with the workers of that client's cluster; it waits, and says so, while there are none."""
    _require_able(client)
    suspects: list[int] = []
    yield from _round(task, paths, range(len(paths)), client, suspects, begun=partial(_wait, client))
    for suspect in suspects:
        again: list[int] = []
        yield from _round(task, paths, [suspect], client, again)
        if again:
            yield suspect, killed(paths[suspect])


def _require_able(client: Client) -> None:
    """A worker that cannot take a task in ends, and the next one, too: that would be waited for for ever."""
    if client.asynchronous:
        raise UsageError("is asynchronous", place="client", cure="give one that is not")
    answers = client.run(import_module, "mmsverify.auditing", on_error="return").values()
    for missing in (answer for answer in answers if isinstance(answer, ImportError)):
        raise _unable(client, missing)


def _unable(client: Client, missing: ImportError) -> UsageError:
    cause = f"the cluster cannot import what an audit needs: {missing}"
    cure = f"install mmsverify {__version__} where its scheduler and its workers run"
    return UsageError(cause, place=_address(client), cure=cure)


def _round(
    task: Task, paths: Sequence[Location], numbers: Sequence[int], client: Client, broken: list[int], *,
    begun: Callable[[], None] = lambda: None,
) -> Iterator[tuple[int, Done]]:  # fmt: skip
    """Do these; those whose workers died too often are noted as ``broken``. ``begun``: they are asked for."""
    from distributed import KilledWorker, as_completed

    asked = [_anywhere(paths[number]) for number in numbers]
    # Not pure: a task may be done again in a later audit, of a file that has changed.
    futures = client.map(partial(_done, task, __version__), asked, pure=False)
    running = dict(zip(futures, numbers, strict=True))
    del futures  # a result is let go of where it was made as soon as it is here
    try:
        begun()
        for future in as_completed(list(running), loop=client.loop):
            number = running.pop(future)
            try:
                yield number, _named(_result(future, client), paths[number])
            except KilledWorker:
                broken.append(number)
    finally:
        client.cancel(list(running))


def _wait(client: Client) -> None:
    """Wait for a worker, and after some seconds say so; of a scheduler that is gone the results tell.

    Not before the tasks are given: some clusters begin workers when there is something to do.
    """
    try:
        with suppress(CancelledError):
            client.wait_for_workers(1, timeout=LONG)
    except TimeoutError:
        _log.warning("waiting for workers of %s", _address(client))
    except OSError:
        pass


def _result(future: Future, client: Client) -> Done:
    try:
        result: Done = future.result()
    except CancelledError:
        cause = "the scheduler, or the connection to it, is gone"
        raise UsageError(cause, place=_address(client), cure="start it, and the audit, again") from None
    except (ImportError, RuntimeError) as error:  # a scheduler that cannot import tells it as the second
        missing = error if isinstance(error, ImportError) else error.__cause__
        if not isinstance(missing, ImportError):
            raise
        raise _unable(client, missing) from None
    return result


def _done(task: Task, version: str, path: Location) -> Done:
    """What a worker does."""
    if version != __version__:
        cure = f"install mmsverify {version} where the workers run"
        raise UsageError(f"a worker has mmsverify {__version__}", place="Dask", cure=cure)
    with _alone:
        before = gc.get_threshold()
        gc.set_threshold(*SELDOM)
        try:
            return task(path)
        finally:
            gc.set_threshold(*before)


def _anywhere(path: Location) -> Location:
    return path if isinstance(path, Url) else path.absolute()


def _named(done: Done, path: Location) -> Done:
    """The result under the path that was given: a worker may run in another folder, and got the whole one."""
    given, whole = str(path), str(_anywhere(path))
    entry, found = done
    if given == whole:
        return done
    return entry and replace(entry, path=given), [
        replace(each, path=given, message=each.message.replace(whole, given)) for each in found
    ]


def _address(client: Client) -> str:
    return client.scheduler.address if client.scheduler is not None else "Dask"


@contextmanager
def _client(address: str) -> Iterator[Client]:
    from distributed import Client

    _require_scheduler(address)
    with Client(address, timeout=PATIENCE, set_as_default=False) as client:
        yield client


def _require_scheduler(address: str) -> None:
    """Ask first: a `Client` would wait for ever for the greeting of what is no scheduler."""
    from distributed.utils import LoopRunner

    try:
        answer = LoopRunner().run_sync(_identity, address)
    except OSError as error:  # a TimeoutError is one, too
        cause = f"no scheduler answers there within {PATIENCE} s"
        raise UsageError(cause, place=address, cure="start one with dask scheduler, or name it") from error
    except Exception as error:  # what else is not right, Dask tells with many kinds of errors
        cause = f"{address!r} is no address of a scheduler: {error}"
        cure = f"give one like tcp://host:8786, or {LOCAL}"
        raise UsageError(cause, place="--scheduler", cure=cure) from error
    if answer.get("type") != "Scheduler":
        raise UsageError(f"is a {answer.get('type')}", place=address, cure="give the scheduler's address")


async def _identity(address: str) -> dict[str, object]:
    from distributed import Security
    from distributed.comm import connect
    from distributed.utils import wait_for

    async def asked() -> dict[str, object]:
        comm = await connect(address, timeout=PATIENCE, **Security().get_connection_args("client"))
        try:
            await comm.write({"op": "identity", "reply": True})
            answer: dict[str, object] = await comm.read()
        finally:
            comm.abort()
        return answer

    answer: dict[str, object] = await wait_for(asked(), PATIENCE)
    return answer


@contextmanager
def _local(workers: int) -> Iterator[object]:
    """A cluster of processes of this machine; each has the memory that there is, as with ``--jobs``."""
    import dask
    from distributed import LocalCluster

    plain = {
        "distributed.nanny.pre-spawn-environ.DASK_LOGGING__DISTRIBUTED": "critical",
        "distributed.worker.profile.enabled": False,
    }
    try:
        with held_back(), dask.config.set(plain):
            cluster = LocalCluster(
                n_workers=workers, threads_per_worker=1, processes=True, memory_limit=0,
                dashboard_address=None, silence_logs=logging.CRITICAL,
            )  # fmt: skip
    except (RuntimeError, OSError) as error:
        cure = "in a script, call it under if __name__ == '__main__'"
        raise UsageError("worker processes cannot be started", place="Dask", cure=cure) from error
    with cluster:
        yield cluster


@contextmanager
def _silence() -> Iterator[None]:
    """Dask tells of workers that come, go and die; what matters of that is in the results."""
    # Some below these have levels of their own.
    names = [*CHATTY, *(name for name in logging.root.manager.loggerDict if name.split(".")[0] in CHATTY)]
    loggers = [logging.getLogger(name) for name in dict.fromkeys(names)]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        for logger, level in zip(loggers, levels, strict=True):
            logger.setLevel(level)
