"""The mutation score of the robot model: do ``check`` and ``audit`` notice a rule that is written otherwise?

    python bench/mutants.py [--write] [--every N]

One line is printed for each mutant that nothing kills. ``--write`` writes docs/mutation.md; ``--every N``
takes only each N-th mutant. Two processes share the work; the clock depends on the machine, the result does
not.
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

ROOT = Path(__file__).parent.parent
TESTS = ROOT / "tests"
sys.path[:0] = [str(TESTS), str(TESTS / "quality")]

from mutation_page import page  # noqa: E402
from mutation_score import Fate, Score, numbered_mutants  # noqa: E402

PAGE = ROOT / "docs" / "mutation.md"
PROCESSES = 2


def part(numbers: Sequence[int]) -> list[Fate]:
    """The fates of some mutants, by their numbers."""
    with tempfile.TemporaryDirectory() as folder:
        score = Score(Path(folder))
        fates = []
        for number in numbers:
            fates.append(score.fate(number))
            if fates[-1].open:
                print(fates[-1], flush=True)
        return fates


def main() -> None:
    """Judge all mutants, and tell."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--every", type=int, default=1)
    given = parser.parse_args()
    begin = time.perf_counter()
    numbers = range(0, len(numbered_mutants()), given.every)
    with ProcessPoolExecutor(PROCESSES, mp_context=get_context("spawn")) as pool:
        parts = list(pool.map(part, [numbers[i::PROCESSES] for i in range(PROCESSES)]))
    fates = sorted((fate for some in parts for fate in some), key=lambda fate: fate.number)
    text = page(fates)
    if given.write:
        PAGE.write_text(text, encoding="utf-8")
    print(text)
    print(f"{sum(fate.seconds for fate in fates):.0f} s CPU, {time.perf_counter() - begin:.0f} s")


if __name__ == "__main__":
    main()
