"""``python -m mmsverify.register CHECKOUT``: write down which tests exercise which statements."""

from __future__ import annotations

import sys
from pathlib import Path

from mmsverify.model.load import find, names
from mmsverify.register.compose import register
from mmsverify.register.exercised import written
from mmsverify.register.scan import scanned
from mmsverify.register.statements import beside

USAGE = "usage: python -m mmsverify.register CHECKOUT: writes models/*/exercised.tsv of that checkout"


def main(arguments: list[str]) -> int:
    """Write the tables of the checkout that the one argument names."""
    if len(arguments) != 1 or not all((Path(arguments[0]) / name).is_dir() for name in ("models", "tests")):
        print(USAGE, file=sys.stderr)
        return 2
    root = Path(arguments[0]).resolve()
    for path, text in tables(root).items():
        path.write_text(text, encoding="utf-8")
        print(path)
    return 0


def tables(root: Path) -> dict[Path, str]:
    """The tables of a checkout as they ought to be, for each of its models that has statements."""
    folder = root / "models"
    found = {}
    for name in names(folder):
        path = find(name, folder)
        if beside(path, "clauses.tsv").is_file():
            found[beside(path, "exercised.tsv")] = written(scanned(root, register(name, folder)))
    return found


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
