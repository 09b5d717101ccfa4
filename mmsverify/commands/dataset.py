"""A folder of Parquet files, written as the results of a fleet come: ``findings/`` and ``inputs/``."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType

from mmsverify.commands.output import replacing
from mmsverify.errors import InputError, UsageError
from mmsverify.results import Audit

PARQUET = "parquet"
PARTS = ("findings", "inputs")
MARK = "_unfinished"
"""Stands in a dataset until it is whole."""
MOST, LONGEST = 20_000, 60.0
"""Findings and recordings that wait for their file, and seconds that they do."""


class Dataset:
    """A dataset being written: one that was not finished is begun again.

    Raises ``UsageError`` without the extra ``parquet``, for a folder that is not named or that holds other
    things, ``InputError`` for one that cannot be written.
    """

    def __init__(self, folder: Path | None) -> None:
        try:
            from mmsverify.report import parquet
        except ImportError as error:
            raise UsageError("Parquet needs pyarrow", cure="pip install 'mmsverify[parquet]'") from error
        self._made: dict[str, Callable[[list[Audit]], bytes]] = {
            "findings": parquet.findings,
            "inputs": parquet.inputs,
        }
        self._folder = _free(folder)
        self._waiting: list[Audit] = []
        self._number = self._rows = 0
        self._begin = time.monotonic()

    def __enter__(self) -> Dataset:
        with self._told():
            (self._folder / MARK).touch()
            for part in PARTS:
                (self._folder / part).mkdir(exist_ok=True)
                for file in (self._folder / part).iterdir():
                    file.unlink()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        """Write the rest. After an error the dataset stays unfinished."""
        if kind is None:
            self._write()
            with self._told():
                (self._folder / MARK).unlink()

    def add(self, audit: Audit) -> None:
        """Add what came of one recording."""
        self._waiting.append(audit)
        self._rows += 1 + len(audit.findings)
        if self._rows >= MOST or time.monotonic() - self._begin >= LONGEST:
            self._write()

    def _write(self) -> None:
        """A file of each kind with what waits; the first ones also without."""
        for part, made in self._made.items():
            if self._waiting or not self._number:
                place = self._folder / part / f"part-{self._number:05}.parquet"
                with self._told(), replacing(place) as file:
                    file.write_bytes(made(self._waiting))
        self._waiting.clear()
        self._number, self._rows, self._begin = self._number + 1, 0, time.monotonic()

    @contextmanager
    def _told(self) -> Iterator[None]:
        try:
            yield
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror}", place=str(self._folder)) from error


def _free(folder: Path | None) -> Path:
    """The folder, made if it is not there: an empty one, or one whose dataset was not finished."""
    if folder is None:
        raise UsageError(f"{PARQUET} is a folder", place="--format", cure="name a new one with -o")
    try:
        folder.mkdir(exist_ok=True)
        held = {each.name for each in folder.iterdir()}
    except OSError as error:
        cause = f"cannot hold a dataset: {error.strerror}"
        raise UsageError(cause, place=str(folder), cure="name a folder that can be written") from error
    if held == set(PARTS):
        cure = "name another folder with -o, or delete this one before"
        raise UsageError("holds a dataset already", place=str(folder), cure=cure)
    if held and not (MARK in held and held <= {MARK, *PARTS}):
        raise UsageError("holds other things", place=str(folder), cure="name a new folder with -o")
    return folder
