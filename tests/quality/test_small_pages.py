"""The pages about mutants of small models tell what became of them, and they are those of today."""

from __future__ import annotations

from collections import Counter

import pytest
from mutation_fate import AUDIT, CHECK, EQUAL, OPEN, key
from mutation_subjects import DOCS, TABLES, text
from mutation_table import read
from small_page import PAGES, Page
from small_score import LEAST, numbered_mutants

RENEW = "write it anew: python bench/mutants.py --write --model"
STALE = 0.05
"""So many of today's mutants may be missing: a rule or a claim may be added without measuring all anew."""


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.file))
def test_a_page_about_mutants_is_made_from_what_became_of_them(page: Page) -> None:
    renew = f"{RENEW} {' '.join(page.models)}"
    assert (DOCS / page.file).read_text(encoding="utf-8") == text(page), renew


@pytest.mark.parametrize("name", TABLES)
def test_the_mutants_that_were_judged_are_those_of_today(name: str) -> None:
    judged = Counter((fate.what, fate.kind, fate.place) for fate in read(TABLES[name]))
    today = Counter(map(key, numbered_mutants(name)))
    assert (today - judged).total() <= STALE * today.total(), f"{RENEW} {name}"


@pytest.mark.parametrize("name", TABLES)
def test_nearly_all_mutants_were_killed(name: str) -> None:
    counted = Counter(fate.fate for fate in read(TABLES[name]))
    assert set(counted) <= {CHECK, AUDIT, EQUAL, OPEN}
    killed = counted[CHECK] + counted[AUDIT]
    assert killed >= LEAST * (killed + counted[OPEN])
