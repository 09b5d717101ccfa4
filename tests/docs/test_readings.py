"""The page of readings names every reading and base assumption that the models and the audit cite."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
CITED = re.compile(r'"((?:(?:RP|VR|MR)-\d\d)|(?:B-[A-Z-]+))"')


def cited() -> list[str]:
    files = [*ROOT.glob("models/**/*.py"), *ROOT.glob("mmsverify/audit/**/*.py")]
    return sorted({found for path in files for found in CITED.findall(path.read_text(encoding="utf-8"))})


@pytest.mark.parametrize("reading", cited())
def test_a_cited_reading_is_explained(reading: str) -> None:
    assert re.search(rf"{reading}\b", (ROOT / "docs" / "readings.md").read_text(encoding="utf-8"))


def test_readings_are_cited_at_all() -> None:
    assert len(cited()) > 30
