"""Results of finished recordings in a folder, so that an audit that was broken off goes on where it was.

One file a recording, written beside its place and put there whole: whatever happens at any moment, it is
there or it is not. A result counts for a recording of the same size and time of change, asked for in the same
manner of the same program, and for nothing else. What could not be read is not kept: it is tried again.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

from mmsverify import __version__
from mmsverify.errors import UsageError
from mmsverify.fleet.tasks import UNREADABLE, Done, Engine, Task
from mmsverify.formats.locations import Location, Url
from mmsverify.resources import models_dir
from mmsverify.results import AuditedInput, Finding

SCHEMA = "mmsverify.kept/1"
MARK = "mmsverify-results.txt"
"""Tells a folder of results from any other."""


class Kept:
    """The results in ``folder`` for audits in one manner, of which ``asdict`` tells all that they depend on.

    Makes the folder if it does not exist. Raises :class:`UsageError` for one that holds other things or
    cannot be written.
    """

    def __init__(self, folder: Path, manner: Any) -> None:
        self._folder = folder
        self._manner = _digest(json.dumps([_program(), asdict(manner)], sort_keys=True, default=str))
        try:
            _claim(folder)
        except OSError as error:
            cause = f"cannot hold results: {error.strerror}"
            raise UsageError(cause, place=str(folder), cure="name a folder that can be written") from None

    def around(self, engine: Engine) -> Engine:
        """The engine that looks here first, and keeps here what it finishes."""

        def run(task: Task, paths: Sequence[Location]) -> Iterator[tuple[int, Done]]:
            # As they are before they are read: one that is changed meanwhile is not what was kept.
            seen = [self._seen(path) for path in paths]
            missing = []
            for number, about in enumerate(seen):
                done = self._found(about)
                if done is None:
                    missing.append(number)
                else:
                    yield number, done
            for place, done in engine(task, [paths[number] for number in missing]):
                self._keep(seen[missing[place]], done)
                yield missing[place], done

        return run

    def _seen(self, path: Location) -> dict[str, Any]:
        """What a result is known by; nothing for a recording that is not there, or on another machine."""
        if isinstance(path, Url):  # nothing tells for sure that it has not changed
            return {}
        try:
            state = path.stat()
        except OSError:
            return {}
        return {
            "schema": SCHEMA, "path": str(path), "file": str(path.absolute()), "manner": self._manner,
            "size": state.st_size, "changed": state.st_mtime_ns,
        }  # fmt: skip

    def _place(self, about: Mapping[str, Any]) -> Path:
        known_by = f"{about['path']}\n{about['file']}\n{self._manner}"
        return self._folder / f"{_digest(known_by)}.json"

    def _found(self, about: Mapping[str, Any]) -> Done | None:
        if not about:
            return None
        try:
            document = json.loads(self._place(about).read_text(encoding="ascii"))
            return _put_back(document) if about.items() <= document.items() else None
        except (OSError, ValueError, TypeError, KeyError, AttributeError, RecursionError):
            return None  # not there, or not whole: a file system that broke down keeps no promises

    def _keep(self, about: Mapping[str, Any], done: Done) -> None:
        entry, findings = done
        if not about or entry is None or any(finding.rule == UNREADABLE for finding in findings):
            return
        document = {**about, "input": asdict(entry), "findings": [asdict(finding) for finding in findings]}
        place = self._place(about)
        part = place.with_name(f"{place.name}.{os.getpid()}.part")
        try:
            part.write_text(json.dumps(document), encoding="ascii")
            os.replace(part, place)
        except OSError as error:
            cause = f"cannot be written: {error.strerror}"
            raise UsageError(cause, place=str(place), cure="make room, and start again") from None


def _claim(folder: Path) -> None:
    """Make the folder one of results, if it is empty or not there."""
    folder.mkdir(exist_ok=True)
    mark = folder / MARK
    if not mark.is_file() and any(folder.iterdir()):
        cure = "name a new folder, or one that was used so before"
        raise UsageError("holds other things than results", place=str(folder), cure=cure)
    mark.write_text(f"Results of recordings that mmsverify has audited ({SCHEMA}).\n", encoding="ascii")


def _put_back(document: Mapping[str, Any]) -> Done:
    return AuditedInput(**document["input"]), [_finding(each) for each in document["findings"]]


def _finding(document: Mapping[str, Any]) -> Finding:
    lists = {name: tuple(value) for name, value in document.items() if isinstance(value, list)}
    return Finding(**{**document, **lists})


def _program() -> str:
    """The version, and a digest of what is behind it: a checkout changes and keeps its version."""
    package = Path(__file__).parents[1]
    texts = [path.read_bytes() for folder in (package, models_dir()) for path in sorted(folder.rglob("*.py"))]
    return f"{__version__} {hashlib.sha256(b''.join(texts)).hexdigest()}"


def _digest(text: str) -> str:
    return hashlib.sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:32]
