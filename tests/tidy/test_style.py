"""Files and functions stay small and say what they are for; names say what a thing is."""

from __future__ import annotations

import ast
import re
from pathlib import Path
from statistics import median

from sources import PACKAGE, ROOT, functions, length, parsed, python_files

LONGEST_FILE = 400
LONGEST_FUNCTION = 50
LONGEST_MEDIAN = 8
EMPTY_WORDS = re.compile(r"(Manager|Handler|Utils?|Helpers?|Base)$")


def lines(path: Path) -> int:
    return len((ROOT / path).read_text(encoding="utf-8").splitlines())


def test_no_file_is_longer_than_a_sitting() -> None:
    assert [f"{path}: {lines(path)} lines" for path in python_files() if lines(path) > LONGEST_FILE] == []


def test_no_function_is_longer_than_a_screen() -> None:
    offences = [
        f"{path}:{function.lineno} {function.name}: {length(function)} lines"
        for path in python_files()
        for function in functions(path)
        if length(function) > LONGEST_FUNCTION
    ]
    assert offences == []


def test_the_median_function_is_short() -> None:
    lengths = [length(function) for path in python_files(PACKAGE) for function in functions(path)]
    assert median(lengths) < LONGEST_MEDIAN


def test_every_file_says_what_it_is_for() -> None:
    assert [
        str(path) for path in python_files() if parsed(path).body and not ast.get_docstring(parsed(path))
    ] == []


def test_no_class_has_an_empty_word_for_a_name() -> None:
    offences = [
        f"{path}:{node.lineno} {node.name}"
        for path in python_files()
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.ClassDef) and EMPTY_WORDS.search(node.name)
    ]
    assert offences == []


def test_no_test_is_defined_twice_in_a_file() -> None:
    offences = []
    for path in python_files("tests"):
        names = [function.name for function in functions(path) if function.name.startswith("test_")]
        offences += [f"{path} {name}" for name in set(names) if names.count(name) > 1]
    assert offences == []
