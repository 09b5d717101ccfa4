"""``python -m mmsverify.samples FOLDER``: write the sample recordings."""

from __future__ import annotations

import sys
from pathlib import Path

from mmsverify.samples.library import write_samples

USAGE = "usage: python -m mmsverify.samples FOLDER: writes the sample recordings into FOLDER"


def main(arguments: list[str]) -> int:
    """Write the samples into the folder that the one argument names."""
    if len(arguments) != 1 or not Path(arguments[0]).is_dir():
        print(
            USAGE,
            file=sys.stderr,
        )
        return 2
    for path in write_samples(Path(arguments[0])):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
