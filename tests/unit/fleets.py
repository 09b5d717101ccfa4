"""Many small recordings, tasks that kill their process, and what the tests of engines share."""

from __future__ import annotations

import json
import os
import shutil
import signal
import time
from pathlib import Path
from typing import Any

from mmsverify.fleet.tasks import Done
from mmsverify.resources import traces_dir
from mmsverify.results import AuditedInput

SAMPLES = sorted(path for path in traces_dir().glob("*.mcap") if path.name != "production-run.mcap")


def recordings(folder: Path, count: int) -> list[Path]:
    """So many of the samples, and one that cannot be read."""
    folder.mkdir()
    paths = [folder / f"{number:02}.mcap" for number in range(count)]
    for number, path in enumerate(paths[:-1]):
        shutil.copyfile(SAMPLES[number % len(SAMPLES)], path)
    paths[-1].write_bytes(b"no recording")
    return paths


def timeless(text: str) -> Any:
    """A result as JSON without what differs from run to run."""
    document = json.loads(text)
    for each in document["inputs"]:
        del each["seconds"]
    return document


def entry(path: Path) -> AuditedInput:
    return AuditedInput(str(path), 1, 1, 0, False, 0.0)


def once_killed(path: Path) -> Done:
    """Kills its process the first time that it sees a certain path."""
    mark = path.parent / "seen"
    if path.name == "7" and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    time.sleep(0.01)
    return entry(path), []


def twice_killed(path: Path) -> Done:
    """Kills its process the first two times that it sees a certain path."""
    marks = [path.parent / name for name in ("once", "twice")]
    for mark in marks:
        if path.name == "7" and not mark.exists():
            mark.touch()
            os.kill(os.getpid(), signal.SIGKILL)
    return entry(path), []


def always_killed(path: Path) -> Done:
    """Kills its process each time that it sees a certain path."""
    if path.name == "3":
        os.kill(os.getpid(), signal.SIGKILL)
    return entry(path), []


def refuses(path: Path) -> Done:
    raise ValueError(path.name)


def workers(parent: int) -> list[int]:
    """The processes that a process has started to work for it, by their ids."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            words = stat.read_text(encoding="ascii", errors="replace").rpartition(")")[2].split()
            line = (stat.parent / "cmdline").read_bytes()
        except OSError:
            continue  # it has ended meanwhile
        if int(words[1]) == parent and b"spawn_main" in line:
            found.append(int(stat.parent.name))
    return found
