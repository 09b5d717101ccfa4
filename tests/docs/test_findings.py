"""The document of findings is what the tool makes of the text today, and leaves no fault unexplained."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from mmsverify.faults import find_faults
from mmsverify.report import render_findings

DOCUMENT = Path(__file__).parents[2] / "docs" / "findings.md"
FAULT = re.compile(r"^## (?P<name>[a-z0-9-]+)\n(?P<told>.*?)(?=^## |\Z)", re.MULTILINE | re.DOTALL)


@cache
def faults() -> dict[str, str]:
    """What the document tells of each broken property, by its name."""
    return {found["name"]: found["told"] for found in FAULT.finditer(DOCUMENT.read_text(encoding="utf-8"))}


@pytest.mark.slow
def test_the_document_is_what_the_tool_makes() -> None:
    made = render_findings(find_faults("mms-robot"), "text")
    assert DOCUMENT.read_text(encoding="utf-8") == made, (
        "run: mmsverify findings mms-robot -o docs/findings.md"
    )


def test_the_document_tells_as_many_faults_as_it_counts() -> None:
    (counted,) = re.findall(
        r"^Broken properties: (\d+)\.", DOCUMENT.read_text(encoding="utf-8"), re.MULTILINE
    )
    assert len(faults()) == int(counted) > 0


def test_every_fault_says_what_it_means_for_a_plant() -> None:
    assert [name for name, told in faults().items() if "**For a plant:** " not in told] == []


def test_no_fault_is_left_in_the_repaired_reading() -> None:
    mended = "In the repaired reading: proved in repaired, for any number of elements."
    assert [name for name, told in faults().items() if mended not in told] == []


def test_every_fault_names_what_mends_it() -> None:
    listed = re.compile(r"^In the repaired reading: .*\n- `", re.MULTILINE)
    assert [name for name, told in faults().items() if not listed.search(told)] == []
