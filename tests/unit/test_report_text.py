"""Results as text are read by a control engineer: what is where, and what a step changes."""

from __future__ import annotations

from dataclasses import replace

import pytest
from report_samples import AUDIT, BROKEN, CHECK, CLEAN, HOSTILE, OPEN, READ, SELECT

from mmsverify.errors import UsageError
from mmsverify.report import render_audit, render_check
from mmsverify.report.wording import folded, instant, printable, spoken
from mmsverify.results import Audit, ModelCheck

SELECT_TOLD = """\
  ERROR  #17  2025-11-24T16:00:00.123456789Z  /cell7/mms/a1/server  select.controlled-elsewhere
    Select answered result(+), but R_ARM is controlled by 'Paint'
    clauses   R-7.4.4.2-d
    expected  result(-)
    observed  result(+)
    related   #3 #9 #16
    before    control[Paint] = CONTROLLING or NORMAL, control[R_ARM] = CONTROLLED, selected = {}
"""

BROKEN_TOLD = """\
selected-is-controlling is violated (R-6.1.3.2.6-2)
  the selected program invocation is CONTROLLING
   1. create(pi=A, domains={D})  [R-7.3.2-a]
      control[A] = NORMAL, selected = {}
   2. select(pi=A)  [R-7.4.4.2-f1]
      control[A]  NORMAL -> CONTROLLING
      selected    {} -> {A}
   3. delete(pi=A)
      control[A]  CONTROLLING -> NORMAL
"""

TABLE_TOLD = """\
mms-robot, as-written: 1 proved, 1 violated, 1 unknown

  property                 result    method      scope                    seconds
  selected-is-controlling  violated  bmc         PI=2, Client=1, depth 3  0.02
  something-runs           proved    exhaustive  PI=2, Client=1           0.50
  stop-is-final            unknown   bmc         PI=2, Client=1, depth 8  10.00
"""


def audited(*findings: object) -> str:
    return render_audit(Audit([READ], list(findings)), "text")  # type: ignore[arg-type]


def test_a_finding_tells_its_place_its_rule_and_what_was_expected() -> None:
    assert SELECT_TOLD in render_audit(AUDIT, "text")


def test_findings_are_grouped_under_their_input() -> None:
    lines = render_audit(AUDIT, "text").splitlines()
    first, second = (
        lines.index("a.mcap: 1204 messages, 1200 events, 4 skipped (0.3 s)"),
        lines.index("b.mcap: not read"),
    )
    assert [line.split()[1] for line in lines[first:second] if line.startswith("  ") and line[2] != " "] == [
        "#4",
        "#17",
    ]
    assert "  ERROR  whole file  input.unreadable" in lines[second:]


def test_the_last_line_sums_up() -> None:
    assert render_audit(AUDIT, "text").splitlines()[-1] == (
        "1 input (1 more not read), 1204 messages: 3 violations (2 errors, 1 warning, 0 notes)"
    )
    assert render_audit(CLEAN, "text").splitlines()[-1] == "1 input, 1204 messages: no violation"


def test_a_truncated_input_is_said_to_be_cut_off() -> None:
    assert "cut off" in render_audit(Audit([replace(READ, truncated=True)], []), "text")
    assert "cut off" not in render_audit(CLEAN, "text")


def test_a_finding_that_stands_for_several_events_says_how_many() -> None:
    assert "start.direct  (5 times)\n" in render_audit(AUDIT, "text")


def test_hostile_names_cannot_move_the_cursor_or_feign_a_line() -> None:
    honest, hostile = (
        audited(replace(SELECT, topic="t")),
        audited(replace(SELECT, topic=HOSTILE, observed=HOSTILE)),
    )
    assert hostile.count("\n") == honest.count("\n")
    assert all(line.isprintable() for line in hostile.splitlines())


def test_properties_stand_in_a_table() -> None:
    assert render_check([CHECK], "text").startswith(TABLE_TOLD)


def test_a_broken_property_shows_each_step_with_only_what_it_changed() -> None:
    assert BROKEN_TOLD in render_check([CHECK], "text")


def test_a_step_without_change_says_so() -> None:
    again = replace(
        BROKEN, counterexample=(*(BROKEN.counterexample or ()), (BROKEN.counterexample or ())[-1])
    )
    assert "   4. delete(pi=A)\n      (no cell changes)\n" in render_check(
        [ModelCheck("m", "repaired", [again])], "text"
    )


def test_an_undecided_property_says_why() -> None:
    assert "stop-is-final is unknown: time limit of 10 s reached\n" in render_check([CHECK], "text")
    silent = ModelCheck("m", "repaired", [replace(OPEN, reason="")])
    assert "stop-is-final is unknown: no reason given\n" in render_check([silent], "text")


def test_notes_of_a_model_are_told_at_the_end() -> None:
    assert render_check([CHECK], "text").endswith("\nnote: two rows overlap\n")


def test_properties_that_a_profile_leaves_out_are_told() -> None:
    names = [f"property-{i}" for i in range(20)]
    told = render_check([ModelCheck("m", "repaired", [OPEN], left_out=names)], "text")
    assert "\nnot claimed with this profile: property-0, property-1," in told
    assert all(len(line) <= 100 for line in told.splitlines() if "property-" in line)


def test_a_model_without_properties_is_still_told() -> None:
    assert render_check([ModelCheck("m", "repaired", [])], "text").startswith("m, repaired: no property")


@pytest.mark.parametrize(
    "render", [lambda: render_audit(AUDIT, "xml"), lambda: render_check([CHECK], "sarif")]
)
def test_an_unknown_format_is_refused_with_the_known_ones(render: object) -> None:
    with pytest.raises(UsageError, match=r"--format: no format '\w+' here \(one of text, json"):
        render()  # type: ignore[operator]


def test_an_instant_is_exact_to_the_nanosecond() -> None:
    assert instant(0) == "1970-01-01T00:00:00.000000000Z"
    assert instant(1764000000123456789) == "2025-11-24T16:00:00.123456789Z"
    assert instant(2**64 - 1) == "2554-07-21T23:34:33.709551615Z"


def test_printable_text_is_left_alone() -> None:
    assert printable("Roboter Nr. 3 für Lack (Süd)") == "Roboter Nr. 3 für Lack (Süd)"
    assert printable("a\nb") == "a\\nb"


def test_values_read_as_words() -> None:
    assert spoken({"oneOf": ["B", "A"]}) == "A or B"
    assert [spoken(value) for value in (True, None, "", 3, {"k": [1]})] == [
        "true",
        "none",
        "none",
        "3",
        "{k: {1}}",
    ]


def test_folding_never_breaks_an_item() -> None:
    assert folded(["aaaa = 1", "b = 2", "c = 3"], 18) == ["aaaa = 1, b = 2,", "c = 3"]
    assert folded([], 10) == []
