"""``python -m mmsverify`` is ``mmsverify``."""

from __future__ import annotations

import sys

from mmsverify.cli import main

if __name__ == "__main__":
    sys.exit(main())
