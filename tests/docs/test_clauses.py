"""The clause register: every citation is of a statement in it; what can be checked is, or says why not."""

from __future__ import annotations

import re
from collections import Counter
from difflib import SequenceMatcher
from functools import cache
from pathlib import Path

import pytest

from mmsverify.register import REASONS, clause_registers
from mmsverify.register.__main__ import tables
from mmsverify.register.statements import IN_PART, read_statements
from mmsverify.resources import models_dir
from mmsverify.results import Entry, Register, Statement

ROOT = Path(__file__).resolve().parents[2]
LITERAL = re.compile(r'"([RVM]-[A-Za-z0-9.]+-[A-Za-z0-9]+)"')
SOURCES = {"mms-robot": "robot", "vr-template": "vr", "modbus-signals": "modbus"}
"""Which statements, of those that were handed to the project, each model's table tells in other words."""

STILL_UNCOVERED = {"mms-robot": 0, "vr-template": 0, "modbus-signals": 0}
"""How many checkable statements nothing encodes yet: a number that only goes down, and ends at nought."""


@cache
def registers() -> dict[str, Register]:
    return {register.model: register for register in clause_registers()}


def entries() -> list[Entry]:
    return [entry for register in registers().values() for entry in register.entries]


def told(model: str) -> dict[str, Statement]:
    """The table of a model's statements; it may be there before its model."""
    return read_statements(models_dir() / model.replace("-", "_") / "__init__.py")


def reference(model: str) -> dict[str, str]:
    """The words in which the statements of a model's standard were handed to the project."""
    path = ROOT.parent / "shared" / "spec" / "clauses.tsv"
    if not path.is_file():
        pytest.skip("the statements that were handed to the project are not beside it")
    rows = [line.split("\t") for line in path.read_text(encoding="utf-8").splitlines()[1:]]
    return {row[0]: row[4] for row in rows if row[1] == SOURCES[model]}


def words(text: str) -> str:
    return " ".join(re.findall(r"\w+", text.lower()))


@pytest.mark.parametrize("model", registers())
def test_every_cited_id_is_a_statement(model: str) -> None:
    assert registers()[model].unknown == ()


@pytest.mark.parametrize("model", registers())
def test_no_more_checkable_statements_are_uncovered_than_before(model: str) -> None:
    uncovered = [entry.statement.id for entry in registers()[model].entries if entry.uncovered]
    assert len(uncovered) <= STILL_UNCOVERED.get(model, 0), uncovered


def test_no_citation_in_the_code_escapes_the_register() -> None:
    encoded = {entry.statement.id for entry in entries() if entry.encoded}
    letters = {entry.statement.id[0] for entry in entries()}
    files = [*ROOT.glob("mmsverify/**/*.py"), *ROOT.glob("models/**/*.py")]
    escaped = {
        f"{path.relative_to(ROOT)}: {name}"
        for path in files
        for name in LITERAL.findall(path.read_text(encoding="utf-8"))
        if name[0] in letters
        and name not in encoded
        and not path.is_relative_to(ROOT / "mmsverify" / "register")
    }
    mended = {
        name for register in registers().values() for repair in register.repairs for name in repair.mends
    }
    assert sorted(item for item in escaped if item.rpartition(" ")[2] not in mended) == []


def test_a_statement_with_a_reason_is_encoded_in_part_at_most() -> None:
    both = [e.statement for e in entries() if e.statement.reason and e.encoded]
    assert [s.id for s in both if not s.because.startswith(IN_PART)] == []


@pytest.mark.parametrize("model", registers())
def test_every_statement_is_counted_once(model: str) -> None:
    counts = registers()[model].counts
    assert counts["encoded"] + counts["reasoned"] + counts["uncovered"] == counts["statements"]


def test_a_repeated_statement_names_one_that_is_encoded() -> None:
    encoded = {entry.statement.id for entry in entries() if entry.encoded}
    repeated = [entry.statement for entry in entries() if entry.statement.reason == "repeated"]
    assert [s.id for s in repeated if not encoded & set(re.findall(r"[RVM]-\S+-\w+", s.because))] == []


def test_every_statement_that_is_there_to_be_read_says_so_or_is_encoded() -> None:
    silent = [
        e.statement.id for e in entries() if not (e.statement.checkable or e.statement.reason or e.encoded)
    ]
    assert silent == []


@pytest.mark.parametrize("model", SOURCES)
def test_a_statement_is_one_short_sentence(model: str) -> None:
    says = {name: statement.says for name, statement in told(model).items()}
    assert [name for name, text in says.items() if not text.endswith(".") or len(text) > 180] == []


@pytest.mark.parametrize("model", SOURCES)
def test_no_two_statements_have_the_same_words(model: str) -> None:
    assert [text for text, times in Counter(s.says for s in told(model).values()).items() if times > 1] == []


def test_every_reason_is_in_use() -> None:
    assert {entry.statement.reason for entry in entries()} - {""} == set(REASONS)


@pytest.mark.parametrize("model", SOURCES)
def test_the_table_has_every_statement_that_was_handed_to_the_project(model: str) -> None:
    assert list(told(model)) == list(reference(model))


@pytest.mark.parametrize("model", SOURCES)
def test_the_statements_are_in_words_of_the_projects_own(model: str) -> None:
    handed = {name: words(text) for name, text in reference(model).items()}
    own = {name: words(statement.says) for name, statement in told(model).items()}
    assert [name for name, text in own.items() if text == handed[name]] == []
    close = [name for name, text in own.items() if SequenceMatcher(None, text, handed[name]).ratio() > 0.95]
    assert close == []


STALE = "python -m mmsverify.register . renews the tables (with --tests-only, without replaying the samples)"


def test_the_tables_of_what_is_exercised_are_those_of_the_present_tests() -> None:
    assert stale(replay=False) == [], STALE


@pytest.mark.slow
def test_the_tables_of_what_is_exercised_are_those_of_the_present_samples() -> None:
    assert stale(replay=True) == [], STALE


def stale(*, replay: bool) -> list[str]:
    present = tables(ROOT, replay=replay).items()
    return [path.name for path, text in present if path.read_text(encoding="utf-8") != text]
