"""The project stands alone: it runs from its own checkout, and what it promises to run is what it runs."""

from __future__ import annotations

import re
import tomllib

import pytest
from sources import ROOT, tracked

OUTSIDE = re.compile(r"\.\./" + r"shared\b|(?<![\w.])/" + r"work/")

TEST_COMMANDS = (
    "python3 -m venv .venv",
    ".venv/bin/pip install -q -e '.[dev]'",
    ".venv/bin/python -m pytest -q -n 2 -m 'not slow'",
)


def text_of(name: str) -> str:
    return (ROOT / name).read_text(encoding="utf-8", errors="replace")


def may_lean(name: str) -> bool:
    """A test may look for outside material if it skips where there is none."""
    return name.startswith("tests/") and "skip" in text_of(name)


def test_no_file_leans_on_folders_outside_the_checkout() -> None:
    leaning = [path.as_posix() for path in tracked() if OUTSIDE.search(text_of(str(path)))]
    assert [name for name in leaning if not may_lean(name)] == []


@pytest.mark.parametrize("command", TEST_COMMANDS)
def test_ci_runs_the_test_command_of_the_readme(command: str) -> None:
    assert command in text_of("README.md")
    assert command in text_of(".ci/run")


def test_everything_the_wheel_promises_to_carry_is_there() -> None:
    project = tomllib.loads(text_of("pyproject.toml"))
    wheel = project["tool"]["hatch"]["build"]["targets"]["wheel"]
    there = {path.parts[0] for path in tracked()} | {path.as_posix() for path in tracked()}
    assert set(wheel["force-include"]) - there == set()
    assert (ROOT / project["project"]["readme"]).is_file()


def test_the_changelog_begins_with_what_is_to_come() -> None:
    headings = re.findall(r"^## \[(.+?)\]", text_of("CHANGELOG.md"), flags=re.MULTILINE)
    assert headings[0] == "Unreleased"
