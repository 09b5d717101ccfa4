"""Every console on the pages of the documentation shows what the commands print today."""

from __future__ import annotations

from pathlib import Path

import pytest
from consoles import DOCS, fences, matches, replayed, with_consoles

FAST = DOCS / "tutorial"
"""What a newcomer types first is tried with every run of the fast set; the rest takes longer."""


def cases() -> list[object]:
    """The pages; those that are not in the fast set are marked so."""
    return [
        pytest.param(page, id=page.relative_to(DOCS).as_posix(),
                     marks=[] if page.is_relative_to(FAST) else pytest.mark.slow)
        for page in with_consoles()
    ]  # fmt: skip


@pytest.mark.parametrize("page", cases())
def test_a_console_shows_what_its_commands_print(page: Path, tmp_path: Path) -> None:
    stale = [
        f"$ {command.line}\n" + "\n".join(command.printed)
        for _, commands in replayed(page, tmp_path)
        for command in commands
        if not command.holds
    ]
    assert stale == [], "write it anew: python tests/docs/consoles.py"


def test_no_console_escapes_its_test() -> None:
    pages = {page: page.read_text(encoding="utf-8").count("```console") for page in DOCS.rglob("*.md")}
    found = {page: sum(fence["kind"] == "console" for fence in fences(page)) for page in pages}
    assert found == pages


@pytest.mark.parametrize(
    ("told", "printed", "wanted"),
    [
        (["a", "b"], ["a", "b"], True),
        (["a", "..."], ["a", "b", "c"], True),
        (["a", "...", "c"], ["a", "b", "c"], True),
        (["...", "c"], ["a", "b", "c"], True),
        (["a", "...", "d"], ["a", "b", "c"], False),
        (["b", "..."], ["a", "b"], False),
        (["a"], ["a", "b"], False),
    ],
)  # fmt: skip
def test_lines_may_be_left_out_only_where_dots_stand(
    told: list[str], printed: list[str], *, wanted: bool
) -> None:
    assert matches(told, printed) is wanted
