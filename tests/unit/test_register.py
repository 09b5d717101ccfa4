"""The register: how citations are found, what a table of statements must be, what the command tells."""

from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from mmsverify.cli import main
from mmsverify.errors import ModelError
from mmsverify.model import Always, Clause, Model, Relation, Sometimes, Transition, internal, needs, repaired
from mmsverify.register.citations import citations, of_model
from mmsverify.register.compose import register
from mmsverify.register.statements import read_statements

HEADER = "id\tclause\tkind\tchecks\tstatement\treason\tbecause\n"
LAMP = """
from mmsverify.model import *

class Lamp(Model, name="lamp"):
    lit = Relation(cites=("L-3",))
    press = Transition("L-1", on=internal("press"), when=[~lit()], then=[lit().becomes(True)])
    dark_at_first = Initially("L-2", ~lit())
"""


@dataclass(frozen=True)
class Rule:
    id: str
    clause: Clause


class Switch(Model, name="switch"):
    on = Relation(cites=("S-1-a",))
    press = Transition(
        "S-2",
        on=internal("press"),
        when=[needs("S-3", that=~on(), rule="press.off")],
        then=[on().becomes(True)],
    )
    stays_on = Always("S-4", on(), "RP-01")
    goes_on = Sometimes("S-5", on())


class Mended(Switch, name="switch", variant="repaired"):
    press = Transition("S-2", on=internal("press"), repairs=repaired("RP-01", "S-9", because="it must"))


def told(model: type[Model]) -> set[tuple[str, str, tuple[str, ...]]]:
    return {(kind, name, clause.ids) for kind, name, clause in of_model(model)}


def lamp(folder: Path, *rows: str) -> Path:
    """A model file, with a table of statements beside it where rows are given."""
    path = folder / "lamp.py"
    path.write_text(LAMP, encoding="utf-8")
    if rows:
        (folder / "lamp.clauses.tsv").write_text(
            HEADER + "".join(f"{row}\n" for row in rows), encoding="utf-8"
        )
    return path


def row(name: str, checks: str = "model", reason: str = "", because: str = "") -> str:
    return "\t".join((name, "1", "invariant", checks, f"{name} holds.", reason, because))


@pytest.mark.parametrize("reading", ["B-FAIL", "RP-02", "VR-02"])
def test_a_reading_or_an_assumption_is_no_statement(reading: str) -> None:
    assert Clause.of("S-VR-1", reading) == Clause(("S-VR-1",), (reading,))
    assert [clause for _, clause in citations([reading], "own")] == []


def test_every_kind_of_declaration_tells_what_it_cites() -> None:
    assert told(Switch) == {
        ("variable", "on", ("S-1-a",)),
        ("row", "press", ("S-2",)),
        ("row", "press.off", ("S-3",)),
        ("property (always)", "stays-on", ("S-4",)),
        ("property (sometimes)", "goes-on", ("S-5",)),
    }


def test_a_repair_encodes_nothing_of_what_it_mends() -> None:
    assert "S-9" not in {name for _, _, ids in told(Mended) for name in ids}


def test_a_table_tells_the_citations_of_each_entry_under_its_name() -> None:
    table: Any = {
        "first": {"clauses": ("R-1-1", "RP-02"), "text": "R-1 is no id, nor is this"},
        "second": [Rule("own.name", Clause.of("R-1-2", "B-FAIL"))],
    }
    found = [(name, clause.ids) for name, clause in citations(table, "table")]
    assert found == [("clauses", ("R-1-1",)), ("own.name", ("R-1-2",))]


def test_a_users_model_without_a_table_has_a_register_of_what_it_cites(tmp_path: Path) -> None:
    found = register(str(lamp(tmp_path)), tmp_path)
    assert [(e.statement.id, [c.name for c in e.encoded]) for e in found.entries] == [
        ("L-1", ["press"]), ("L-2", ["dark_at_first"]), ("L-3", ["lit"])
    ]  # fmt: skip
    assert found.unknown == ()


def test_a_statement_that_nothing_encodes_is_uncovered_unless_it_has_a_reason(tmp_path: Path) -> None:
    path = lamp(tmp_path, row("L-1"), row("L-2"), row("L-3"), row("L-4"), row("L-5", "doc"),
                row("L-6", "model", "local", "It is left open."))  # fmt: skip
    found = register(str(path), tmp_path)
    assert [e.statement.id for e in found.entries if e.uncovered] == ["L-4"]


def test_a_cited_id_that_the_table_does_not_know_is_told(tmp_path: Path) -> None:
    assert register(str(lamp(tmp_path, row("L-1"))), tmp_path).unknown == ("L-2", "L-3")


@pytest.mark.parametrize(
    ("rows", "cause"),
    [
        ([row("L-1"), row("L-1")], "L-1 stands there twice"),
        (["L-1\t1"], "2 fields where 7 are meant"),
        ([row("L-1", reason="dunno", because="So.")], "unknown reason dunno"),
        ([row("L-1", reason="local")], "a reason without a sentence"),
        ([row("")], "without id or words"),
    ],
)
def test_a_faulty_table_is_refused_with_its_line(tmp_path: Path, rows: list[str], cause: str) -> None:
    path = lamp(tmp_path, *rows)
    with pytest.raises(ModelError, match=cause) as refused:
        read_statements(path)
    assert refused.value.place == f"{tmp_path / 'lamp.clauses.tsv'}:{len(rows) + 1}"


def test_a_table_with_other_columns_is_refused(tmp_path: Path) -> None:
    path = lamp(tmp_path)
    (tmp_path / "lamp.clauses.tsv").write_text("id\twords\n", encoding="utf-8")
    with pytest.raises(ModelError, match="other columns"):
        read_statements(path)


def test_the_command_lists_every_statement_and_ends_well(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["clauses", str(lamp(tmp_path, row("L-1"), row("L-2"), row("L-3"), row("L-4")))]) == 0
    out = capsys.readouterr().out
    assert out.startswith("lamp: 4 statements, 3 encoded, 0 with a reason why not, 1 uncovered, 0 exercised")
    assert [line.split() for line in out.splitlines()[3:]] == [
        ["L-1", "1", "invariant", "press"],
        ["L-2", "1", "invariant", "dark_at_first"],
        ["L-3", "1", "invariant", "lit"],
        ["L-4", "1", "invariant", "-", "(model)"],
    ]


def test_what_is_uncovered_is_asked_for_by_an_option_and_fails(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = str(lamp(tmp_path, row("L-1"), row("L-2"), row("L-3"), row("L-4")))
    assert main(["clauses", path, "--uncovered", "--format", "json"]) == 1
    (model,) = json.loads(capsys.readouterr().out)["models"]
    assert [clause["id"] for clause in model["clauses"]] == ["L-4"]


def test_nothing_uncovered_ends_well(tmp_path: Path) -> None:
    path = str(lamp(tmp_path, row("L-1"), row("L-2"), row("L-3")))
    assert main(["clauses", path, "--uncovered"]) == 0


def test_a_citation_of_an_unknown_id_fails_where_coverage_is_asked_for(tmp_path: Path) -> None:
    assert main(["clauses", str(lamp(tmp_path, row("L-1"), row("L-2"))), "--uncovered"]) == 1


def test_one_clause_is_told_in_full(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = lamp(tmp_path, row("L-1"), row("L-6", "model", "local", "It is left open."))
    assert main(["clauses", str(path), "--clause", "L-[16]"]) == 0
    out = capsys.readouterr().out
    assert "L-1 holds." in out
    assert "encoded by row press (as-written)" in out
    assert "not checked (local): It is left open." in out


def test_a_clause_that_is_not_there_is_a_bad_request(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["clauses", str(lamp(tmp_path)), "--clause", "L-99"]) == 2
    assert "no statement is called 'L-99'" in capsys.readouterr().err


def test_the_json_form_holds_statement_encodings_and_repairs(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["clauses", "mms-robot", "--format", "json", "-o", str(tmp_path / "out.json")]) == 0
    told = json.loads((tmp_path / "out.json").read_text(encoding="utf-8"))
    assert told["schema"] == "mmsverify.clauses/1"
    (model,) = told["models"]
    select_d = next(clause for clause in model["clauses"] if clause["id"] == "R-7.4.4.2-d")
    assert {"kind": "step of a procedure", "name": "select/d", "variants": ["as-written", "repaired"]} in (
        select_d["encodedBy"]
    )
    assert any(
        repair["name"] == "robot_state" and "RP-12" in repair["readings"] for repair in model["repairs"]
    )
    assert capsys.readouterr().out == ""
