"""The readings of the texts, by id, out of the page that lists them: ours, with what is read how and why."""

from __future__ import annotations

import re
from functools import cache

from mmsverify.resources import readings_page

_READING = re.compile(r"^\| ([A-Z]+-[A-Z0-9-]+) \| (.+) \|$", re.MULTILINE)
"""A row of the page: an id, and how it is read."""


@cache
def read_readings() -> dict[str, str]:
    """What each reading says."""
    return dict(_READING.findall(readings_page().read_text(encoding="utf-8")))
