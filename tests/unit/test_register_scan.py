"""Which tests exercise a statement, as their source tells; the sources are made here."""

from __future__ import annotations

from pathlib import Path

import pytest

from mmsverify.register.__main__ import main
from mmsverify.register.exercised import read_exercised, written
from mmsverify.register.scan import scanned
from mmsverify.results import Encoding, Entry, Exercise, Register, Statement

JUDGING = "from mmsverify.auditing import audit_traces\n"


def entry(name: str, *encoded: Encoding) -> Entry:
    return Entry(Statement(name, "1", "", ("model",), "So.", "", "", True), encoded, ())


LAMP = Register(
    "lamp", "", (),
    (
        entry("L-1", Encoding("row", "press/a")),
        entry("L-2", Encoding("property (always)", "lit-when-on")),
        entry("L-3", Encoding("variable", "lit_lamp")),
    ),
    (), (),
)  # fmt: skip


def found(root: Path, **files: str) -> set[tuple[str, str]]:
    """Statement and test, as found in test files of these names and contents."""
    (root / "tests").mkdir()
    for name, text in files.items():
        (root / "tests" / f"{name}.py").write_text(text, encoding="utf-8")
    return {(statement, exercise.name) for statement, exercise in scanned(root, LAMP)}


def test_a_test_exercises_the_ids_and_the_rows_and_properties_that_it_names(tmp_path: Path) -> None:
    text = JUDGING + "def test_a():\n    assert ('L-1', 'lit-when-on')\ndef test_b():\n    assert 'press/a'\n"
    assert found(tmp_path, test_x=text) == {
        ("L-1", "tests/test_x.py::test_a"),
        ("L-2", "tests/test_x.py::test_a"),
        ("L-1", "tests/test_x.py::test_b"),
    }


def test_the_name_of_a_variable_is_a_word_like_others(tmp_path: Path) -> None:
    assert found(tmp_path, test_x=JUDGING + "def test_a():\n    assert 'lit_lamp'\n") == set()


def test_constants_fixtures_and_helpers_count_for_the_tests_that_use_them(tmp_path: Path) -> None:
    helper = JUDGING + "WANTED = {'L-1': 3}\ndef judged():\n    return WANTED\n"
    text = "from lamps import judged\ndef lit():\n    return 'L-2'\n"
    text += "def test_a(lit):\n    judged()\ndef test_b():\n    pass\n"
    assert found(tmp_path, lamps=helper, test_x=text) == {
        ("L-1", "tests/test_x.py::test_a"),
        ("L-2", "tests/test_x.py::test_a"),
    }


def test_a_test_that_only_prints_exercises_nothing(tmp_path: Path) -> None:
    text = "from mmsverify.report import render_audit\ndef test_a():\n    assert 'L-1'\n"
    assert found(tmp_path, test_x=text) == set()


@pytest.mark.parametrize(
    "text",
    [
        "import pytest\n@pytest.mark.exercises('L-[12]')\ndef test_a():\n    pass\n",
        "import pytest\npytestmark = pytest.mark.exercises('L-1', every='prop')\ndef test_a():\n    pass\n",
    ],
)
def test_a_marker_tells_what_the_text_cannot(tmp_path: Path, text: str) -> None:
    assert {statement for statement, _ in found(tmp_path, test_x=text)} == {"L-1", "L-2"}


def test_a_marker_of_another_model_names_nothing_here(tmp_path: Path) -> None:
    text = "import pytest\n@pytest.mark.exercises(every='prop', of='another')\ndef test_a():\n    pass\n"
    assert found(tmp_path, test_x=text) == set()


def test_the_table_that_is_written_is_the_one_that_is_read(tmp_path: Path) -> None:
    by_test, by_sample = Exercise("test", "b"), Exercise("sample", "a")
    table = written([("L-2", by_test), ("L-1", by_sample), ("L-2", by_test)])
    (tmp_path / "lamp.exercised.tsv").write_text(table, encoding="utf-8")
    assert read_exercised(tmp_path / "lamp.py") == {
        "L-1": (by_sample,),
        "L-2": (by_test,),
    }


def test_the_command_wants_a_checkout(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([str(tmp_path)]) == 2
    assert "usage" in capsys.readouterr().err
