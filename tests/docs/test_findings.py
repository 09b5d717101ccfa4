"""The document of findings is what the tool makes of the text today, and leaves no fault unexplained."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify.faults import find_faults
from mmsverify.report import render_findings
from mmsverify.results import Survey

DOCUMENT = Path(__file__).parents[2] / "docs" / "findings.md"

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def survey() -> Survey:
    return find_faults("mms-robot")


def test_the_document_is_what_the_tool_makes(survey: Survey) -> None:
    made = render_findings(survey, "text")
    assert DOCUMENT.read_text(encoding="utf-8") == made, (
        "run: mmsverify findings mms-robot -o docs/findings.md"
    )


def test_every_fault_says_what_it_means_for_a_plant(survey: Survey) -> None:
    assert [fault.name for fault in survey.faults if not fault.consequence] == []


def test_no_fault_is_left_in_the_repaired_reading(survey: Survey) -> None:
    assert [fault.name for fault in survey.faults if not fault.mended.startswith("proved in repaired")] == []
