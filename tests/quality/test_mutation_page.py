"""The page about mutants tells what became of them when they were judged, and they are those of today."""

from __future__ import annotations

from collections import Counter
from pathlib import Path

from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, key
from mutation_table import read
from robot_page import page
from robot_score import numbered_mutants

ROOT = Path(__file__).parents[2]
STALE = 0.05
"""So many of today's mutants may be missing: a rule or a claim may be added without measuring all anew."""
LEAST = 0.95


def test_the_page_about_mutants_is_made_from_what_became_of_them() -> None:
    written = (ROOT / "docs" / "mutation.md").read_text(encoding="utf-8")
    assert written == page(read()), "write it anew: python bench/mutants.py --write"


def test_the_mutants_that_were_judged_are_those_of_today() -> None:
    judged = Counter((fate.what, fate.kind, fate.place) for fate in read())
    today = Counter(map(key, numbered_mutants()))
    missing = today - judged
    assert missing.total() <= STALE * today.total(), sorted(missing)[:10]


def test_nearly_all_mutants_were_killed() -> None:
    counted = Counter(fate.fate for fate in read())
    assert set(counted) <= {CHECK, AUDIT, EQUAL, OPEN}
    killed = counted[CHECK] + counted[AUDIT]
    assert killed >= LEAST * (killed + counted[OPEN])


def test_every_mutant_that_lives_says_why() -> None:
    alive = [fate for fate in read() if fate.open]
    lines = page(read()).splitlines()
    told = [line for line in lines if line.startswith("- ") and "`: " in line]
    assert len(told) == len(alive)
