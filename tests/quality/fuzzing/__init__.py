"""Hostile octets for every decoder and importer: seeds, mutators, targets, and who judges the outcome.

``bench/fuzz.py`` runs them by the million, ``test_fuzzing.py`` by the thousand. An input is a function of the
seed, the target's name and its own number: it does not matter which process makes it.
"""

import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parents[2] / "unit"))  # captures are built by what stands there
