"""Every mistake in a model file is told in one line: where it is, what is wrong, what to write instead."""

from __future__ import annotations

import textwrap
from pathlib import Path

import pytest

from mmsverify.errors import ModelError, UsageError
from mmsverify.model import load

HEAD = """
from mmsverify.model import *

class Colour(Enumeration):
    RED = "RED"
    GREEN = "GREEN"

class Lamp(Model, name="lamp"):
    L = Each("Lamp")
    S = Each("Switch")
    a, b = L.elements("a b")
    s = S.element("s")
    some = L.some("some")
    lit = Relation(L)
    wired = Relation(S, L, rigid=True)
    colour = Variable(Colour, L)
    level = Variable(integer(0), L)
    bright = Derived(level[a] > 3, over=[a])
"""

# what is wrong, the lines that do it (the guilty one marked), a part of the cause, a part of the cure
MISTAKES = {
    "if on a condition": (
        """
        if lit[a]:  # here
            pass
        """,
        "'lit[a]' is used as a truth value", "write & for and",
    ),
    "and between conditions": (
        'x = Always("L-1", lit[a] and lit[b])  # here',
        "'lit[a]' is used as a truth value", "write & for and",
    ),
    "not before a condition": (
        'x = Always("L-1", not lit[a])  # here',
        "used as a truth value", "~ for not",
    ),
    "a chained comparison": (
        'x = Always("L-1", 0 < level[a] < 3)  # here',
        "used as a truth value", "write & for and",
    ),
    "a variable as a truth value": (
        """
        if lit:  # here
            pass
        """,
        "the variable lit is used as a truth value", "write lit[...]",
    ),
    "a loop over a term": (
        "x = list(colour[a])  # here",
        "'colour[a]' cannot be listed", "for_all(x)",
    ),
    "in on a set": (
        'x = Always("L-1", a in some)  # here',
        "'in some' gives a truth value", "some.has(x)",
    ),
    "an element of another sort in a set": (
        "x = some.has(s)  # here",
        "some holds Lamp, not Switch", "an element of that sort",
    ),
    "an argument of another sort": (
        "x = lit[s]  # here",
        "s is of sort Switch, not Lamp", "compare like with like",
    ),
    "too many arguments": (
        "x = lit[a, b]  # here",
        "lit takes 1 argument(s), not 2", "write lit[L]",
    ),
    "a value that the enumeration does not have": (
        'x = colour[a] == "RED"  # here',
        "RED is not a value of sort Colour", "use one of RED, GREEN",
    ),
    "values of different sorts": (
        "x = colour[a] == level[a]  # here",
        "level[a] is of sort integer 0.., not Colour", "compare like with like",
    ),
    "an order of what is not a number": (
        "x = colour[a] < colour[b]  # here",
        "not an integer", "order only integers",
    ),
    "a condition that is not one": (
        'x = Always("L-1", level[a])  # here',
        "a condition is expected", "compare it",
    ),
    "a quantifier over nothing": (
        "x = for_all()(lit[a])  # here",
        "a quantifier takes elements", "declare them",
    ),
    "a claim without a clause": (
        "x = Always(lit[a], True)  # here",
        "a claim without a clause", "write Always('R-...', formula)",
    ),
    "the next state in an invariant": (
        'x = Always("L-1", lit[a].next)  # here',
        "'.next' in an Always claim", "state it as Step",
    ),
    "a row without a clause": (
        'x = Transition(on=internal("press", a))  # here',
        "a row without a clause", "cite the statement",
    ),
    "an observation without a clause": (
        'x = Observation(on=shown("status"), shows=[])  # here',
        "an observation without a clause", "cite the statement",
    ),
    "a procedure that never accepts": (
        'x = Procedure("L-1", on=response("go", a), steps=[refuse("a", unless=lit[a])])  # here',
        "a procedure that never accepts", "accept('m')",
    ),
    "a refusal without a condition": (
        'x = refuse("a")  # here',
        "step a refuses without a condition", "when=",
    ),
    "two updates of one cell at once": (
        'x = do("a", lit[a].becomes(True), lit[a].becomes(False))  # here',
        "two updates of lit[a] in one step", "conditions that exclude each other",
    ),
    "an update of a rigid relation": (
        """
        x = Transition("L-1", on=internal("press", s, a), then=[
            wired[s, a].becomes(True),  # here
        ])
        """,
        "wired is rigid and cannot be updated", "drop rigid=True",
    ),
    "an update of a definition": (
        """
        x = Transition("L-1", on=internal("press", a), then=[
            bright[a].becomes(True),  # here
        ])
        """,
        "bright is a definition and cannot be updated", "update the variables",
    ),
    "a name declared twice": (
        """
        press = Transition("L-1", on=internal("press", a))
        press = Transition("L-2", on=internal("press", a))  # here
        """,
        "the name press is declared twice in Lamp", "another name",
    ),
    "a definition that leads back to itself": (
        """
        first = Derived(lit[a], over=[a])
        second = Derived(first[a] & lit[a], over=[a])
        first.definition = (second[a] | lit[a]).expr
        """,
        "leads back to itself", "define it from variables",
    ),
    "a repair without a reason": (
        'x = repaired("RP-1", "L-1", because="")  # here',
        "names no clause or no reason", "because=",
    ),
    "a replacement without a reason": (
        """

        class Mended(Lamp, variant="mended"):
            lit = Relation(L)  # here
        """,
        "lit replaces the declaration at", "add repairs=repaired",
    ),
    "the removal of what was never there": (
        """

        class Mended(Lamp, variant="mended"):
            unlit = Removed(repairs=repaired("RP-1", "L-1", because="it is not needed"))  # here
        """,
        "unlit is removed but never declared", "name a declaration",
    ),
    "an error of Python": (
        "x = 1 / 0  # here",
        "ZeroDivisionError", "mend this line",
    ),
    "an unknown word": (
        'x = Always("L-1", colours[a] == Colour.RED)  # here',
        "colours is not declared", "did you mean colour?",
    ),
    "a word like no other": (
        'x = Always("L-1", zzz[a])  # here',
        "zzz is not declared", "declare it above this line: zzz = Variable(...)",
    ),
    "a formula where the clause belongs": (
        "x = Always(lit[a])  # here",
        "a claim without a clause", "write Always('R-...', formula)",
    ),
    "a clause without a formula": (
        'x = Sometimes("L-1")  # here',
        "a claim without a formula", "write Sometimes('R-...', formula)",
    ),
    "a start without a clause": (
        "x = Initially(lit[a])  # here",
        "a condition without a clause", "write Initially('R-...', formula)",
    ),
    "a procedure without a clause": (
        'x = Procedure(on=response("go", a), steps=[accept("m")])  # here',
        "a row without a clause", "give the clause of the procedure",
    ),
    "a row without an event": (
        'x = Transition("L-1", then=[])  # here',
        "Transition lacks on", "write Transition(...) with on",
    ),
    "an option that does not exist": (
        "x = Relation(L, rigged=True)  # here",
        "knows no rigged=", "mend the spelling",
    ),
    "a syntax error": (
        "x = = 1  # here",
        "not valid Python", "mend the syntax",
    ),
}  # fmt: skip


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_is_told_with_place_cause_and_cure(mistake: str, tmp_path: Path) -> None:
    lines, cause, cure = MISTAKES[mistake]
    indent = "" if "class " in lines else "    "
    path = written(tmp_path, HEAD + textwrap.indent(textwrap.dedent(lines), indent))
    with pytest.raises(ModelError) as caught:
        load(str(path), tmp_path)
    assert cause in caught.value.cause
    assert cure in caught.value.cure
    assert caught.value.place.startswith(str(path))
    if "# here" in lines:
        assert caught.value.place == f"{path}:{line_of(path, '# here')}"
    assert "\n" not in str(caught.value)


def written(folder: Path, text: str) -> Path:
    path = folder / "lamp.py"
    path.write_text(text, encoding="utf-8")
    return path


def line_of(path: Path, mark: str) -> int:
    lines = path.read_text(encoding="utf-8").splitlines()
    return next(number for number, line in enumerate(lines, 1) if mark in line)


def test_a_null_byte_is_told_with_its_line(tmp_path: Path) -> None:
    path = written(tmp_path, HEAD + "    x = '\0'\n")
    with pytest.raises(ModelError) as caught:
        load(str(path), tmp_path)
    last = HEAD.count("\n") + 1
    assert str(caught.value) == f"{path}:{last}: a null byte, which no text has (save it as UTF-8 text)"


def test_octets_that_are_no_text_are_told_with_the_file(tmp_path: Path) -> None:
    path = tmp_path / "lamp.py"
    path.write_bytes(b"x = '\xff'\n")
    with pytest.raises(ModelError, match="not valid Python") as caught:
        load(str(path), tmp_path)
    assert caught.value.place.startswith(str(path))
    assert "None" not in str(caught.value)


def test_a_file_without_a_model_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelError, match="no model in this file"):
        load(str(written(tmp_path, "x = 1\n")), tmp_path)


def test_an_unknown_model_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    written(tmp_path, HEAD)
    with pytest.raises(UsageError, match="no model named or filed as 'lump'") as caught:
        load("lump", tmp_path)
    assert "lamp" in caught.value.cure


def test_an_unknown_variant_is_refused_with_the_known_ones(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="has no variant mended") as caught:
        load(str(written(tmp_path, HEAD)), tmp_path, "mended")
    assert "as-written" in caught.value.cure


def test_a_part_that_two_bases_declare_needs_a_decision(tmp_path: Path) -> None:
    parts = HEAD.replace("class Lamp(Model, name=", "class Left(Model, name=") + (
        "\nclass Right(Model):\n    lit = Relation()\n\nclass Both(Left, Right):\n    pass\n"
    )
    with pytest.raises(ModelError, match="the name lit is declared in two parts of Both"):
        load(str(written(tmp_path, parts)), tmp_path)


def test_a_file_that_was_refused_is_read_anew(tmp_path: Path) -> None:
    path = written(tmp_path, HEAD + "    x = 1 / 0\n")
    with pytest.raises(ModelError):
        load(str(path), tmp_path)
    written(tmp_path, HEAD)
    assert load(str(path), tmp_path).name == "lamp"
