"""The pages that are made from the models: nothing of a model is missing on them, and nothing breaks them."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import pytest

from mmsverify.cli import app
from mmsverify.commands import reference
from mmsverify.manual import drawings, pages
from mmsverify.manual.markdown import LONG, anchor, anchored, formula, table, text
from mmsverify.manual.row_table import assigned, implied
from mmsverify.manual.standalone import loaded_from_elsewhere
from mmsverify.model import (
    Each,
    Model,
    ModelData,
    Procedure,
    Relation,
    accept,
    assemble,
    do,
    for_some,
    load,
    refuse,
    response,
)  # fmt: skip
from mmsverify.model.load import names
from mmsverify.model.show import shown
from mmsverify.register import clause_registers
from mmsverify.resources import models_dir

ROOT = Path(__file__).parents[2]
RULE = re.compile(r'"((?!mmsverify)[a-z]+(?:-[a-z]+)*\.(?!txt)[a-z]+(?:-[a-z]+)*)"')
"""How the code names a rule."""
MODELS = names(models_dir())
JUDGED = ("mms-robot", "vr-template", "modbus-signals")
made = cache(pages)


def model_page(model: str) -> str:
    return made()[f"reference/models/{model}.md"]


def loaded(model: str) -> ModelData:
    return load(model, models_dir())


@pytest.mark.parametrize("model", MODELS)
def test_every_row_and_property_and_repair_of_a_model_is_on_its_page(model: str) -> None:
    page, data = model_page(model), loaded(model)
    missing = [row.name for row in data.rows if f"#### {row.name.replace('_', ' ')}\n" not in page]
    missing += [c.title for c in data.claims if f"| <code>{text(c.title)}</code> |" not in page]
    missing += [name for name in data.repairs if f"| <code>{text(name)}</code> |" not in page]
    assert missing == []


@pytest.mark.parametrize("model", MODELS)
def test_every_row_that_is_mended_is_on_the_page_of_the_text(model: str) -> None:
    page, mended = made()[f"reference/models/{model}-as-written.md"], loaded(model).repairs
    told = {
        line.removeprefix("#### ").replace(" ", "_") for line in page.splitlines() if line.startswith("#### ")
    }
    assert told == {row.name for row in load(model, models_dir(), "as-written").rows if row.name in mended}


@pytest.mark.parametrize("model", MODELS)
def test_a_page_has_a_line_for_each_row(model: str) -> None:
    rows = model_page(model).split("\n## Rows\n")[1].split("\n## Properties\n")[0]
    lines = [line for line in rows.splitlines() if line.startswith("| ") and "---" not in line]
    heads = [line for line in lines if line.startswith("| clauses | event |")]
    assert len(lines) - len(heads) == len(loaded(model).rows)


def test_every_statement_is_on_the_page_of_its_register() -> None:
    missing = [
        entry.statement.id
        for register in clause_registers()
        for entry in register.entries
        if f'<a id="{anchor(entry.statement.id)}"></a>'
        not in made()[f"reference/clauses/{register.model}.md"]
    ]
    assert missing == []


def test_every_line_of_a_table_has_as_many_cells_as_its_head() -> None:
    broken, width = [], 0
    for page in (*made().values(), reference.page()):
        for line in page.splitlines():
            width = (width or line.count("|")) if line.startswith("|") else 0
            broken += [line] if line.startswith("|") and line.count("|") != width else []
    assert broken == []


def test_every_command_and_option_is_on_the_page_of_the_command_line() -> None:
    page = reference.page()
    named = [f"## mmsverify {command.name}\n" for command in app.registered_commands]
    named += [
        "## mmsverify record proxy\n",
        "## mmsverify record modbus\n",
        "--counterexamples DIR",
        "--annotate OUT.mcap",
    ]
    assert [name for name in named if name not in page] == []


def test_every_rule_that_a_finding_may_name_is_on_the_page_of_rules() -> None:
    files = [*ROOT.glob("mmsverify/audit/**/*.py"), *ROOT.glob("mmsverify/fleet/*.py")]
    named = {rule for path in files for rule in RULE.findall(path.read_text(encoding="utf-8"))}
    named |= {c.rule for model in JUDGED for row in loaded(model).rows for c in row.guard if c.rule}
    page = made()["reference/rules.md"]
    assert sorted(rule for rule in named if f">{rule}<" not in page and f"`{rule}`" not in page) == []


def test_a_drawing_that_is_kept_is_not_made_again() -> None:
    kept = {f"{model}.svg" for model in MODELS if model != "vr-tasks"}
    assert list(drawings(dict.fromkeys(kept))) == ["vr-tasks.svg"]


@pytest.mark.parametrize(
    ("html", "found"),
    [
        ('<script async src="https://host/x.js"></script>', ["https://host/x.js"]),
        ("<link rel=stylesheet href=//host/x.css>", ["//host/x.css"]),
        ('<a href="https://host/">a link</a><img src="x.svg"><script src="../x.js"></script>', []),
    ],
)
def test_what_a_page_loads_from_elsewhere_is_found_and_a_link_is_none(html: str, found: list[str]) -> None:
    assert loaded_from_elsewhere(html) == found


def test_every_reading_that_is_cited_has_a_place_on_its_page() -> None:
    page = anchored((ROOT / "docs" / "readings.md").read_text(encoding="utf-8"))
    cited = {link for text in made().values() for link in re.findall(r"readings\.md#([\w-]+)", text)}
    assert sorted(name for name in cited if f'<a id="{name}"></a>' not in page) == []
    assert len(cited) > 40


def test_names_cannot_break_a_page() -> None:
    assert table(["a"], [[text("<b>|*x*\n`")]]).splitlines()[2] == "| &lt;b&gt;&#124;&#42;x&#42; &#96; |"
    assert formula("x" * (LONG + 1)).startswith("<details>")


class Lamps(Model, name="lamps"):
    """Lamps of which at most one is lit."""

    Lamp = Each("Lamp")
    a, b = Lamp.elements("a b")
    lit = Relation(Lamp)
    power = Relation()
    press = Procedure(
        "L-1",
        on=response("press", a),
        steps=[
            refuse("a", unless=power()),
            refuse("b", when=for_some(b)(lit[b])),
            do("c", lit[b].becomes(b == a).over(b).when(power())),
            accept("d"),
        ],
    )


def test_a_row_tells_only_what_those_above_it_have_not_settled() -> None:
    rows = assemble(Lamps).rows
    told = [
        [shown(c.condition) for c in row.guard if not implied(c, row, rows[:n])] for n, row in enumerate(rows)
    ]
    assert told == [["not power"], ["for some b: lit[b]"], []]


def test_a_condition_is_told_where_a_row_above_asks_for_more_than_its_opposite() -> None:
    _, refused, accepted = assemble(Lamps).rows
    assert not any(implied(conjunct, accepted, [accepted]) for conjunct in accepted.guard)
    assert [implied(conjunct, refused, [accepted]) for conjunct in refused.guard] == [False, True]


def test_an_update_tells_its_elements_and_its_condition() -> None:
    (update,) = assemble(Lamps).rows[-1].assigns
    assert assigned(update) == "lit[b] := b = a for all b where power"
