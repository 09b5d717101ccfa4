"""The notebooks are stored as executed: whole, in order, with pictures that a code host can show."""

from __future__ import annotations

import ast
import base64
import json
import re
from pathlib import Path
from typing import Any

import pytest

NOTEBOOKS = sorted((Path(__file__).parents[2] / "notebooks").glob("*.ipynb"))
STATIC = {"image/png", "image/svg+xml"}
MOVING = "application/vnd.vegalite"
LOGIC = (ast.For, ast.While, ast.If, ast.FunctionDef, ast.Lambda, ast.Try, ast.With, ast.comprehension)


def cells(path: Path) -> list[dict[str, Any]]:
    stored: list[dict[str, Any]] = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [cell for cell in stored if cell["cell_type"] == "code"]


def outputs(path: Path) -> list[dict[str, Any]]:
    return [output for cell in cells(path) for output in cell["outputs"]]


def test_there_are_five_and_the_readme_tells_of_each() -> None:
    readme = (NOTEBOOKS[0].parent / "README.md").read_text(encoding="utf-8")
    assert [path.name[:2] for path in NOTEBOOKS] == ["01", "02", "03", "04", "05"]
    assert [path.name for path in NOTEBOOKS if path.name not in readme] == []


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_is_stored_as_a_clean_kernel_executed_it(path: Path) -> None:
    counts = [cell["execution_count"] for cell in cells(path)]
    assert counts == list(range(1, len(counts) + 1))


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_every_cell_that_ends_with_a_value_shows_it(path: Path) -> None:
    for cell in cells(path):
        source = "".join(cell["source"])
        if source.startswith("%%"):
            continue
        ends_with_value = isinstance(ast.parse(source).body[-1], ast.Expr)
        shown = [each for each in cell["outputs"] if each["output_type"] == "execute_result"]
        assert bool(shown) == ends_with_value, source
        assert all(each["execution_count"] == cell["execution_count"] for each in shown)


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_nothing_went_wrong_and_nothing_was_warned_of(path: Path) -> None:
    told = [output for output in outputs(path) if output["output_type"] in ("error", "stream")]
    assert [
        output
        for output in told
        if not "".join(output.get("text", "")).startswith(("Writing", "Overwriting"))
    ] == []


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_chart_is_stored_with_a_static_picture(path: Path) -> None:
    bundles = [output["data"] for output in outputs(path) if "data" in output]
    pictures = [bundle for bundle in bundles if STATIC & bundle.keys()]
    assert pictures
    for bundle in bundles:
        if any(kind.startswith(MOVING) for kind in bundle):
            assert base64.b64decode("".join(bundle["image/png"])).startswith(b"\x89PNG")


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_no_logic_stands_in_a_cell(path: Path) -> None:
    for cell in cells(path):
        source = "".join(cell["source"])
        if not source.startswith("%%"):
            assert [node for node in ast.walk(ast.parse(source)) if isinstance(node, LOGIC)] == [], source


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_no_output_tells_where_it_was_made(path: Path) -> None:
    text = json.dumps(outputs(path))
    assert re.findall(r"(?:/home/|/tmp/|/root/|/Users/|site-packages)[\w/.-]*", text) == []


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_links_lead_to_files_that_are_there(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    for target in re.findall(r"\]\(((?!https?:)[^)\s]+)\)", text):
        assert (path.parent / target).exists(), target
