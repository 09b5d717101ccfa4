"""``python -m mmsverify.register CHECKOUT``: write down which tests and samples exercise which statements."""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from mmsverify.model.load import find, names
from mmsverify.register.compose import register
from mmsverify.register.exercised import read_exercised, written
from mmsverify.register.replays import replayed
from mmsverify.register.scan import scanned
from mmsverify.register.statements import beside
from mmsverify.results import Exercise

TESTS_ONLY = "--tests-only"
USAGE = (
    f"usage: python -m mmsverify.register CHECKOUT [{TESTS_ONLY}]: writes the tables exercised.tsv beside "
    "its models; the samples are not replayed where only the tests have changed"
)


def main(arguments: list[str]) -> int:
    """Write the tables of the checkout that the argument names."""
    roots = [Path(argument) for argument in arguments if argument != TESTS_ONLY]
    if len(roots) != 1 or not all((roots[0] / name).is_dir() for name in ("models", "tests")):
        print(USAGE, file=sys.stderr)
        return 2
    for path, text in tables(roots[0].resolve(), replay=TESTS_ONLY not in arguments).items():
        path.write_text(text, encoding="utf-8")
        print(path)
    return 0


def tables(root: Path, *, replay: bool) -> dict[Path, str]:
    """The tables of a checkout as they ought to be, for each of its models that has statements.

    Without ``replay``, what they tell of samples is taken for granted.
    """
    folder = root / "models"
    found = {}
    for name in names(folder):
        model = find(name, folder)
        if beside(model, "clauses.tsv").is_file():
            present = register(name, folder)
            samples = replayed(root, present) if replay else _told_of_samples(model)
            found[beside(model, "exercised.tsv")] = written([*scanned(root, present), *samples])
    return found


def _told_of_samples(model: Path) -> Iterable[tuple[str, Exercise]]:
    told = read_exercised(model)
    return ((i, exercise) for i, listed in told.items() for exercise in listed if exercise.by == "sample")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
