"""How long an audit takes a message, beside what it takes to read and decode it only.

    python bench/replay_speed.py [MESSAGES [SEED]]

Audited are the shipped samples and a varied conversation with a robot that keeps the rules, made here from
the model's own rows: requests that are granted and refused, programs that end and fail unseen, an emergency
stop, local control. Times are CPU seconds of this process; a first audit warms up, so that importing and
reading the model files is left out.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from mmsverify.auditing import audit_traces
from mmsverify.formats import mms
from mmsverify.formats.mcap import read_trace
from mmsverify.model import load
from mmsverify.resources import models_dir

TESTS = Path(__file__).parent.parent / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from robot_conversations import ARM  # noqa: E402
from robot_random import Chance, beginning  # noqa: E402

PROFILE = {"associations": "single", "predefined": [ARM]}
SIZES = {"PI": 6, "Client": 1, "Request": 1}


def seconds(work: Callable[[], object]) -> float:
    """CPU time."""
    begin = time.process_time()
    work()
    return time.process_time() - begin


def decode(path: Path) -> None:
    """Read and decode only."""
    for message in read_trace(path):
        if message.message_encoding == "mms-ber":
            mms.decode(message.data)


def line(path: Path) -> str:
    """One row of the table."""
    found: list[Any] = []
    audited = seconds(lambda: found.append(audit_traces([path], profile=None, model=None)))
    decoded = seconds(lambda: decode(path))
    count = found[0].inputs[0].messages
    return (
        f"{path.name:24} {count:8} {1000 * audited / count:10.2f} {1000 * decoded / count:10.2f}"
        f" {audited / decoded:8.1f} {len(found[0].findings):9}"
    )


def recordings(folder: Path, count: int, seed: int) -> Iterator[Path]:
    """The samples, and the conversation that is made."""
    yield from sorted((Path(__file__).parent.parent / "traces").glob("*.mcap"))
    model = load("mms-robot", models_dir(), "repaired")
    chance = Chance(beginning(model, PROFILE, SIZES), seed, calm=True, gaps=0)
    yield chance.hold(count).write(folder / f"varied-{seed}.mcap")


def main() -> None:
    """Print the table."""
    count, seed = (*map(int, sys.argv[1:3]), *(1000, 1)[len(sys.argv[1:3]) :])
    sample = Path(__file__).parent.parent / "traces" / "annex-a.mcap"
    audit_traces([sample], profile=None, model=None)
    print(f"{'recording':24} {'messages':>8} {'audit ms':>10} {'decode ms':>10} {'ratio':>8} {'findings':>9}")
    with tempfile.TemporaryDirectory() as folder:
        for path in recordings(Path(folder), count, seed):
            print(line(path), flush=True)


if __name__ == "__main__":
    main()
