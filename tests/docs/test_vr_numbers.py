"""docs/vr-numbers.md tells the cells and numbers of the VR framework as the models and formats have them."""

from __future__ import annotations

from pathlib import Path

from mmsverify.formats.vr import CELLS
from mmsverify.model import load
from mmsverify.resources import models_dir

PAGE = Path(__file__).parents[2] / "docs" / "vr-numbers.md"


def rows(heading: str) -> list[tuple[str, ...]]:
    """The cells of the table below a heading."""
    part = PAGE.read_text(encoding="utf-8").split(f"## {heading}\n", 1)[1].split("\n## ", 1)[0]
    lines = [line for line in part.splitlines() if line.startswith("|")][2:]
    return [tuple(cell.strip() for cell in line.strip("|").split("|")) for line in lines]


def test_the_cells_are_those_that_are_read() -> None:
    assert [(f"VR({cell.number})", cell.name) for cell in CELLS] == [row[:2] for row in rows("Cells")]


def test_modes_and_statuses_are_those_of_the_model() -> None:
    numbers = load("vr-template", models_dir(), "repaired").options["numbers"]
    assert [(str(n), str(mode)) for n, mode in numbers["mode"].items()] == rows("Modes, VR(C_RunMD)")
    meant = {n: " or ".join(map(str, words)) for n, words in sorted(numbers["status"]("either").items())}
    assert [(str(n), words) for n, words in meant.items()] == rows("Statuses, VR(CS_RunSTA)")


def test_commands_are_those_of_the_model() -> None:
    commands = load("vr-template", models_dir(), "repaired").options["numbers"]["command"]
    told = {(row[0], row[1]) for row in rows("Commands, VR(C_Cmd)")}
    assert {(str(n), word) for n, word in commands.items() if n < 100} <= told
    assert {
        ("101-199", "dbgSub"),
        ("201-299", "homeSub"),
        ("301-399", "orgSub"),
        ("401-499", "runSub"),
    } <= told
