"""The parts of the HTML report: timelines are thinned without a lie, paths count, repeats are capped."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

from hypothesis import given, settings
from hypothesis import strategies as st
from report_samples import AUDIT, READ, SELECT

from mmsverify.incident import Change, DeviceLine, Dossier, Incident, Lane, Origin, Saying
from mmsverify.report import render_audit
from mmsverify.report.html.finding import hexdump
from mmsverify.report.html.numbered import WHOLE, grouped, numbered
from mmsverify.report.html.sequence import chart
from mmsverify.report.html.states import path
from mmsverify.report.html.timeline import MOST_PARTS, thinned, timeline
from mmsverify.results import Audit

TIMES = st.lists(st.integers(0, 10_000), min_size=1, max_size=60, unique=True).map(sorted)


def changes(times: list[int], words: tuple[str, ...] = ("A", "B", "")) -> list[Change]:
    return [Change(number, time, words[number % len(words)]) for number, time in enumerate(times)]


@settings(deadline=None)
@given(TIMES, st.integers(0, 500))
def test_a_thinned_lane_covers_the_same_time_and_keeps_what_is_long(times: list[int], least: int) -> None:
    told = changes(times)
    parts = list(thinned(told, 10_500, least))
    assert parts[0].begin == times[0]
    assert all(one.end == other.begin for one, other in pairwise(parts))
    assert parts[-1].end == 10_500
    assert sum(part.changes for part in parts) == len(told)
    for change, end in zip(told, [*times[1:], 10_500], strict=True):
        if end - change.time > least:
            assert any(
                (part.begin, part.end, part.words) == (change.time, end, change.words) for part in parts
            )


def test_a_lane_has_no_more_parts_than_can_be_seen() -> None:
    told = changes(list(range(0, 1_000_000, 3)))
    assert len(list(thinned(told, 1_000_000, 1_000_000 // MOST_PARTS))) <= 2 * MOST_PARTS


def line(*lanes: Lane, links: tuple[Change, ...] = ()) -> DeviceLine:
    return DeviceLine("cell7", "mms-robot", 0, 10_000, 50, lanes, links)


def test_a_timeline_shows_its_lanes_gaps_and_findings() -> None:
    told = [
        replace(each, finding=replace(each.finding, time=5000))
        for each in numbered(AUDIT)
        if each.finding.time
    ]
    drawn = timeline(line(Lane("mode", changes([0, 4000])), links=(Change(3, 2000, "gap a"),)), told)
    assert drawn.count('class="part"') == 2
    assert drawn.count('class="gap"') == 1
    assert 'x="20.0000%"' in drawn
    assert 'href="#finding-' in drawn


def test_a_path_counts_how_often_it_went_where() -> None:
    drawn = path(line(Lane("robot state", changes([0, 1, 2, 3, 4], ("A", "B")))), {1})
    assert ">2</text>" in drawn
    assert drawn.count("step odd") == 1
    assert path(line(Lane("robot state", changes([0], ("A",)))), set()) == ""
    assert path(line(Lane("selected", changes([0, 1], ("A", "B")))), set()) == ""


def said(index: int, sender: str, title: str = "Start", answers: int | None = None) -> Saying:
    return Saying(index, index, "cell7", "line", sender, title, b"\xa0\x00", "", answers)


def test_an_answer_ends_the_bar_that_its_request_begins() -> None:
    drawn = chart([said(1, "client"), said(2, "client"), said(3, "server", answers=1)], 3, {1})
    assert drawn.count('class="served"') == 1
    assert drawn.count("say finding") == 1
    assert drawn.count("say related") == 1


def test_what_was_asked_outside_the_window_has_no_bar() -> None:
    assert 'class="served"' not in chart([said(3, "server", answers=1)], 3, set())


def test_many_findings_of_a_kind_are_told_in_a_line_each() -> None:
    many = Audit([READ], [replace(SELECT, index=number) for number in range(WHOLE + 40)])
    told = numbered(many)
    assert sum(each.whole for each in told) == WHOLE
    page = render_audit(many, "html")
    assert page.count("<article") == WHOLE
    assert "40 more of the kind" in page


def test_findings_are_grouped_by_device_and_clause() -> None:
    groups = list(grouped(numbered(AUDIT)))
    assert {(group.device, group.clause) for group in groups} == {
        ("cell7", "R-7.4.4.2-d"), ("cell7", "R-7.4.2-a"), ("", "input.unreadable"),
    }  # fmt: skip


def test_statements_are_told_in_words_and_the_footer_says_what_it_rests_on() -> None:
    incident = Incident(Origin("a.mcap", 17, "ab" * 32), [line(Lane("mode", changes([0, 10])))])
    beside = Dossier({"a.mcap": incident}, {"R-7.4.4.2-d": "Select d) refuses."}, [("model", "mms-robot")])
    page = render_audit(AUDIT, "html", beside)
    assert "Select d) refuses." in page
    assert "ab" * 32 in page
    assert "mms-robot" in page


def test_octets_are_shown_sixteen_a_row_and_not_without_end() -> None:
    dumped = hexdump(bytes(range(256)) * 3)
    assert "0010  10 11 12" in dumped
    assert "and 256 octets more" in dumped
