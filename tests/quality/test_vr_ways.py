"""A way between two samples is found exactly where the sets of states meet, and the rows allow it."""

from __future__ import annotations

from functools import cache

from hypothesis import given
from hypothesis import strategies as st
from vr_random import automaton

from mmsverify.audit.vr.scans import PRE, Scans
from mmsverify.audit.vr.ways import Segment, shortest


@cache
def scans() -> Scans:
    return Scans(automaton())


STATES = st.deferred(lambda: st.sampled_from(sorted(scans().automaton.all)))
BARRED = st.frozensets(
    st.sampled_from(["home", "org", "run", "stop", "resetErr", "goes_to_origin", "set_next_mode"])
)


@given(STATES, STATES, st.booleans(), BARRED)
def test_a_way_is_found_where_the_sample_can_be_reached_and_nowhere_else(
    before: int, after: int, one_scan: bool, barred: frozenset[str]
) -> None:
    begin, end = frozenset({before}), frozenset({after})
    reached = scans().once(begin, barred) if one_scan else scans().often(begin)
    way = shortest(scans(), Segment(begin, reached & end, one_scan, barred if one_scan else frozenset()))
    assert (way is not None) == (after in reached)
    direct = shortest(scans(), Segment(begin, end, one_scan, barred if one_scan else frozenset()))
    assert direct == way


@given(STATES, STATES)
def test_the_mode_changes_only_after_the_status_has_been_set(before: int, after: int) -> None:
    way = shortest(scans(), Segment(frozenset({before}), frozenset({after}), one_scan=False)) or ()
    set_since = False
    for stage in way:
        assert set_since or "mode" not in stage.row.writes
        set_since = stage.row.on.service == PRE or (set_since and "mode" not in stage.row.writes)


@given(STATES, STATES, BARRED)
def test_a_scan_changes_the_mode_once_and_by_nothing_that_is_barred(
    before: int, after: int, barred: frozenset[str]
) -> None:
    way = (
        shortest(scans(), Segment(frozenset({before}), frozenset({after}), one_scan=True, barred=barred))
        or ()
    )
    moving = [stage.row for stage in way if "mode" in stage.row.writes]
    assert len(moving) <= 1
    assert not any(barred & {row.on.service, row.name} for row in moving)
