"""The mutation score of models: do ``check`` and ``audit`` notice a rule that is written otherwise?

    python bench/mutants.py [--model NAME ...] [--write] [--every N] [--kept FILE]

Without ``--model`` the robot's; the VR framework has two, vr-template and vr-tasks, the server of signals
one, modbus-signals. One line is printed for each mutant that nothing kills. ``--write`` writes the page in
docs and the table that it is made from; ``--every N`` takes only each N-th mutant; ``--kept FILE`` keeps
what becomes of each, and judges only those anew that were alive: for a run that goes on, or one with more
recordings or rules. Two processes share the work; the clock depends on the machine, the result does not.
"""

from __future__ import annotations

import argparse
import json
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from dataclasses import asdict, replace
from multiprocessing import get_context
from pathlib import Path

ROOT = Path(__file__).parent.parent
TESTS = ROOT / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from mutation_fate import CLAIM, Fate, key  # noqa: E402
from mutation_subjects import ROBOT_MODEL, SUBJECTS  # noqa: E402
from mutation_table import write  # noqa: E402

PROCESSES = 2


def part(model: str, numbers: Sequence[int], kept: Path | None) -> list[Fate]:
    """The fates of some mutants, by their numbers."""
    with tempfile.TemporaryDirectory() as folder:
        score = SUBJECTS[model].score(Path(folder))
        fates = []
        for number in numbers:
            fate = score.fate(number)
            fates.append(fate)
            if fate.open:
                print(fate, flush=True)
            if kept is not None:
                with kept.open("a", encoding="utf-8") as file:
                    file.write(json.dumps(asdict(fate)) + "\n")
        return fates


def settled(model: str, kept: Path | None) -> dict[int, Fate]:
    """Rules that were killed or equal before, by today's numbers; claims are judged in no time."""
    if kept is None or not kept.exists():
        return {}
    fates = (Fate(**json.loads(line)) for line in kept.read_text(encoding="utf-8").splitlines())
    known = {(fate.what, fate.kind, fate.place): fate for fate in fates if not fate.open}
    today = ((number, key(mutant)) for number, mutant in enumerate(SUBJECTS[model].mutants()))
    return {n: replace(known[k], number=n) for n, k in today if k[0] != CLAIM and k in known}


def judged(model: str, every: int, kept: Path | None) -> list[Fate]:
    """The fates of a model's mutants, or of each ``every``-th of them."""
    known = settled(model, kept)
    numbers = [n for n in range(0, len(SUBJECTS[model].mutants()), every) if n not in known]
    shares = [numbers[i::PROCESSES] for i in range(PROCESSES)]
    with ProcessPoolExecutor(PROCESSES, mp_context=get_context("spawn")) as pool:
        parts = list(pool.map(part, [model] * PROCESSES, shares, [kept] * PROCESSES))
    made = [fate for some in parts for fate in some]
    return sorted([*known.values(), *made], key=lambda fate: fate.number)


def main() -> None:
    """Judge all mutants, and tell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--model", nargs="+", choices=SUBJECTS, default=[ROBOT_MODEL])
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--kept", type=Path)
    given = parser.parse_args()
    for model in given.model:
        begin = time.perf_counter()
        subject, fates = SUBJECTS[model], judged(model, given.every, given.kept)
        if given.write:
            write(fates, subject.table)
            subject.written.write_text(subject.page(), encoding="utf-8")
        print(subject.shown(fates))
        print(f"{sum(fate.seconds for fate in fates):.0f} s CPU, {time.perf_counter() - begin:.0f} s")


if __name__ == "__main__":
    main()
