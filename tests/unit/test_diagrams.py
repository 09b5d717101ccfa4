"""Views of a model and their drawings: what they show, and that each format is well formed."""

from __future__ import annotations

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
from small_models import Counter, Lamps

from mmsverify.concrete import Machine, Scope, generic_scope
from mmsverify.diagrams import diagram_views, draw
from mmsverify.errors import UsageError
from mmsverify.graph import Arrow, View, dot, explore, mermaid, svg, view_names, views
from mmsverify.graph.layout import boxes, ordered, routed
from mmsverify.model import Model, Relation, assemble, load

LAMPS = assemble(Lamps)
MACHINE = Machine(LAMPS, generic_scope(LAMPS, {"L": 2}))
CORE = Path(__file__).parents[2] / "bench" / "core_model.py"
SVG = "{http://www.w3.org/2000/svg}"


def lamp_views() -> list[View]:
    return views(MACHINE, view_names(LAMPS))


def test_a_view_shows_what_each_cell_does() -> None:
    colour, lights = lamp_views()
    assert colour == View(
        "colour of a lamp", ("RED", "GREEN"), ("RED",), (Arrow("RED", "GREEN", ("ripen",), ("L-2",)),), True
    )
    assert lights.arrows == (Arrow("False", "True", ("press",), ("L-1-a", "L-1-b", "L-1-m")),)


def test_a_model_file_with_one_variant_is_drawn_without_naming_it(tmp_path: Path) -> None:
    path = tmp_path / "lamp.py"
    path.write_text(
        "from mmsverify.model import *\nclass Lamp(Model, name='lamp'):\n    lit = Relation()\n"
        "    press = Transition('L-1', on=internal('press'), then=[lit().becomes(True)])\n"
    )
    assert "press" in draw(str(path), format="mermaid")


def test_a_view_of_a_part_says_so() -> None:
    assert not views(MACHINE, {"colour": "colour"}, max_states=2)[0].complete


def test_without_a_declaration_the_first_enumeration_is_drawn() -> None:
    class Plain(Model, name="plain"):
        some_flag = Relation()

    assert view_names(assemble(Plain)) == {"some flag": "some_flag"}


def test_a_model_without_anything_to_draw_is_told() -> None:
    with pytest.raises(UsageError, match="the model counter has nothing to draw"):
        view_names(assemble(Counter))


def test_a_view_of_an_unknown_name_is_told() -> None:
    class Wrong(Model, name="wrong", views={"glow": "glow"}):
        flag = Relation()

    with pytest.raises(UsageError, match="the model wrong has no glow"):
        diagram_views(assemble(Wrong))


def test_the_graph_has_every_state_and_step() -> None:
    graph = explore(MACHINE)
    assert graph.graph["complete"]
    assert len(graph) == 9
    initial = [node for node, data in graph.nodes(data=True) if data.get("initial")]
    assert initial == list(MACHINE.start.states)
    # Every state: press is answered for each lamp, and each lamp that is lit and red ripens.
    assert graph.number_of_edges() == 9 * 2 + 6


def test_a_graph_that_is_cut_says_so() -> None:
    assert not explore(Machine(assemble(Counter), Scope({}, int_bounds=(0, 2)))).graph["complete"]


def test_mermaid_names_states_and_rows() -> None:
    lines = [line.strip() for line in mermaid(lamp_views()).splitlines()]
    assert lines[0] == "stateDiagram-v2"
    assert 'state "colour of a lamp" as v0 {' in lines
    assert "[*] --> v0_RED" in lines
    assert "v0_RED --> v0_GREEN: ripen" in lines


def test_dot_has_clauses_as_tooltips() -> None:
    text = dot(lamp_views())
    assert '"0:RED" -> "0:GREEN" [label="ripen", tooltip="L-2"];' in text
    assert text.count("{") == text.count("}")


@pytest.mark.parametrize("variant", ["as-written", "repaired"])
def test_svg_is_well_formed_and_shows_every_value_and_row(variant: str) -> None:
    root = ElementTree.fromstring(draw(str(CORE), variant=variant, format="svg"))
    texts = " ".join(node.text or "" for node in root.iter(f"{SVG}text"))
    assert {"NONEXISTENT", "UNRUNNABLE", "IDLE", "RUNNING", "STOPPED"} <= set(texts.split())
    assert {"create", "delete", "kill", "reset", "end"} <= set(re.findall(r"\w+", texts))


def test_boxes_and_labels_do_not_cover_each_other() -> None:
    (view,) = (v for v in diagram_views_of_core() if v.title == "state")
    placed = boxes(ordered(view), 120, 34)
    arrows = routed(view, placed, [(70.0, 16.0)] * len(view.arrows))
    every = list(placed.values())
    assert not any(a.meets(b) for i, a in enumerate(every) for b in every[i + 1 :])
    assert not any(arrow.label.meets(box) for arrow in arrows for box in every)
    labels = [arrow.label for arrow in arrows]
    assert not any(a.meets(b) for i, a in enumerate(labels) for b in labels[i + 1 :])


def diagram_views_of_core() -> list[View]:
    return diagram_views(load(str(CORE), CORE.parent, "repaired"))


def test_many_arrows_have_numbers_and_a_legend() -> None:
    values = tuple("ABCDEF")
    arrows = tuple(Arrow(a, b, (f"{a}_to_{b}",), ("X-1",)) for a in values for b in values if a != b)
    text = svg([View("dense", values, ("A",), arrows, False)])
    assert "30 F \u2192 E: F_to_E" in text
    assert "other changes may exist" in text


def test_a_drawing_is_the_same_every_time() -> None:
    assert draw(str(CORE), variant="repaired", format="svg") == draw(
        str(CORE), variant="repaired", format="svg"
    )


def test_an_unknown_format_is_told() -> None:
    with pytest.raises(UsageError, match="no diagrams in the format 'png'"):
        draw(str(CORE), variant="repaired", format="png")
