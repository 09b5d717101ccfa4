"""The audit of VR samples: what is told of cells, of beginnings, of pauses, and how often."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any, Literal

import pytest

from mmsverify.audit.telling import Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.auditing import audit_traces
from mmsverify.concrete.automaton import Automaton
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.errors import ProfileError, UsageError
from mmsverify.formats.mcap_write import TraceWriter
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.model import load
from mmsverify.resources import models_dir
from mmsverify.results import Finding

Sampling = Literal["scan", "polled"]
Kinds: tuple[Sampling, ...] = ("scan", "polled")
HOMED = [0, 1, 2, 3]
READY = [*HOMED, 4, 5]
RUNNING = [*READY, 6]


@cache
def scans() -> Scans:
    model = load("vr-template", models_dir(), "repaired")
    return Scans(Automaton(Machine(model, scope_for(model, {}, {}))))


def audited(samples: Iterable[Any], kind: Sampling = "scan", reading: str = "either") -> list[Finding]:
    numbering = Numbering(load("vr-template", models_dir(), "repaired").options["numbers"], reading)
    controller = Controller(Place("made.mcap", "press"), scans(), numbering)
    channel = Channel.vr("press", kind)
    written = (s if isinstance(s, bytes) else json.dumps(s).encode() for s in samples)
    messages = (TraceMessage(n, 1000 * n, channel, data) for n, data in enumerate(written))
    return [found for message in messages for found in controller.sample(message)]


def modes(numbers: Iterable[int]) -> list[dict[str, int]]:
    """Samples with each mode and its status."""
    return [{"C_RunMD": n, "CS_RunSTA": n} for n in numbers]


def told(found: Sequence[Finding]) -> list[tuple[int | None, str]]:
    return [(each.index, each.rule) for each in found]


@pytest.mark.parametrize("data", [b"", b"{", b"[]", b"6", b"\xff"])
def test_a_sample_that_is_no_object_is_an_error_and_the_cells_keep_their_values(data: bytes) -> None:
    found = audited([*modes(HOMED), data, *modes([3, 4, 5])])
    assert told(found) == [(4, "vr.undecodable")]
    assert found[0].severity == "error"
    assert found[0].clauses


@pytest.mark.parametrize("value", ["3", None, True, [3], {}])
def test_a_cell_that_is_no_number_is_an_error_and_keeps_its_value(value: Any) -> None:
    found = audited([*modes(HOMED), {"C_RunMD": value, "CS_RunSTA": 3}, *modes([4, 5])])
    assert told(found) == [(4, "vr.cell")]
    assert found[0].severity == "error"
    assert "C_RunMD" in found[0].message


def test_of_other_cells_too_it_is_told_when_they_are_no_numbers() -> None:
    found = audited([{"C_RunMD": 1, "Temperature": "warm", "C_Cmd": "none"}])
    assert told(found) == [(0, "vr.cell"), (0, "vr.cell")]


@pytest.mark.parametrize("number", [17, -1, 6.5, 1e30])
def test_an_unknown_mode_is_told_once_while_it_stays(number: float) -> None:
    unknown = {"C_RunMD": number, "CS_RunSTA": 3}
    found = audited([*modes(HOMED), unknown, unknown, {}, *modes([3])])
    assert told(found) == [(4, "mode.unknown")]


def test_an_unknown_number_that_comes_again_is_told_again() -> None:
    wrong = {"CS_RunSTA": 99}
    found = audited([*modes([1]), wrong, wrong, {"CS_RunSTA": 1}, wrong, {"CS_RunSTA": 98}])
    assert told(found) == [(1, "status.unknown"), (4, "status.unknown"), (5, "status.unknown")]


def test_what_an_unknown_number_hides_is_not_guessed() -> None:
    assert told(audited([*modes([1]), {"CS_RunSTA": 99}, {"C_RunMD": 2}, *modes([3])])) == [
        (1, "status.unknown")
    ]


@pytest.mark.parametrize("kind", Kinds)
def test_missing_cells_keep_their_values(kind: Sampling) -> None:
    samples = [{"C_RunMD": 1, "CS_RunSTA": 1}, {}, {"C_RunMD": 2}, {"CS_RunSTA": 2}, {"C_RunMD": 3}, {}]
    found = audited(samples, kind)
    assert told(found) == ([(5, "status.mode")] if kind == "scan" else [])


def test_a_status_that_lags_two_scans_is_blamed_once() -> None:
    found = audited([*modes([1]), {"C_RunMD": 2}, {}, {}, {}, *modes([2, 3])])
    assert told(found) == [(2, "status.mode")]
    assert found[0].expected == ("CS_RunSTA=2",)
    assert found[0].observed == "CS_RunSTA=1"


@pytest.mark.parametrize("kind", Kinds)
def test_a_recording_without_modes_or_without_statuses_is_followed(kind: Sampling) -> None:
    assert audited([{"CS_RunSTA": n} for n in RUNNING], kind) == []
    assert audited([{"C_RunMD": n} for n in RUNNING], kind) == []
    assert audited([{"C_Cmd": n} for n in (0, 1, 0)], kind) == []


@pytest.mark.parametrize("kind", Kinds)
@pytest.mark.parametrize("mode", range(17))
def test_a_recording_may_begin_in_every_mode(mode: int, kind: Sampling) -> None:
    assert audited([{"C_RunMD": mode}, {"C_RunMD": mode}], kind) == []


def test_whether_a_machine_that_is_met_in_stop_is_homed_is_told_by_where_it_goes() -> None:
    assert audited(modes([7, 3, 4])) == []
    assert audited(modes([7, 1, 2])) == []
    homed = {"C_RunMD": 7, "CS_RunSTA": 7, "CF_Home": 1}
    assert told(audited([homed, *modes([1])])) == [(1, "mode.next")]
    assert told(audited([homed | {"CF_Home": 0}, *modes([3])])) == [(1, "mode.next")]


def test_the_two_tables_are_noted_once_a_controller_and_never_under_a_profile() -> None:
    samples = [
        *modes([1]),
        {"C_RunMD": 13, "CS_RunSTA": 13},
        {},
        *modes([1]),
        {"C_RunMD": 13, "CS_RunSTA": 13},
    ]
    found = audited(samples)
    assert told(found) == [(1, "status.two-tables")]
    assert found[0].severity == "note"
    assert audited(samples, reading="13-16") == []


@pytest.mark.parametrize(("reading", "right", "wrong"), [("11-14", 11, 13), ("13-16", 13, 11)])
def test_the_profile_says_which_number_a_sub_action_has(reading: str, right: int, wrong: int) -> None:
    def samples(status: int) -> list[dict[str, int]]:
        return [*modes([1]), {"C_RunMD": 13, "CS_RunSTA": status}, {}, *modes([1])]

    assert audited(samples(right), reading=reading) == []
    (found,) = audited(samples(wrong), reading=reading)
    assert found.rule in ("status.mode", "status.unknown")
    assert found.index == 1


@pytest.mark.parametrize(("error", "after"), [(8, 1), (9, 3)])
def test_an_error_is_left_by_a_reset_only(error: int, after: int) -> None:
    begin = [s | {"C_Cmd": 0} for s in modes([*RUNNING, error, error])]
    reset = {"C_Cmd": 10}
    assert audited([*begin, reset, *[s | {"C_Cmd": 0} for s in modes([after])]]) == []
    found = audited([*begin, *modes([after])])
    assert told(found) == [(len(begin), "error.left")]
    assert found[0].severity == "error"


def test_where_commands_are_not_recorded_an_error_may_have_been_reset() -> None:
    assert audited(modes([*RUNNING, 8, 1])) == []


def test_after_a_serious_error_there_is_no_org_before_another_home() -> None:
    def after(numbers: Sequence[int]) -> list[Finding]:
        return audited(modes([*RUNNING, 8, 1, *numbers]))

    assert after([2, 3, 4]) == []
    (found,) = after([4, 5])
    assert (found.index, found.rule, found.severity) == (len(RUNNING) + 2, "org.unhomed", "error")
    assert "V-SM-5" in found.clauses
    assert found.before["homed"] is False


def test_the_way_to_the_origin_goes_on_by_itself_after_home_only() -> None:
    def samples(last: Sequence[int]) -> list[dict[str, int]]:
        return [s | {"C_Cmd": 0} for s in modes(last)]

    assert audited(samples([*HOMED, 4, 5])) == []
    # In HomeRdy an Org that was written and cleared between two scans leads there too.
    assert audited(samples([*RUNNING, 7, 3, 4])) == []
    assert told(audited(samples([*RUNNING, 7, 3, 5]))) == [(len(RUNNING) + 2, "mode.next")]


@pytest.mark.parametrize("kind", Kinds)
def test_a_pause_is_reported_beside_run_and_may_begin_later_than_its_flag(kind: Sampling) -> None:
    run = modes(RUNNING)
    pausing = [{"C_Cmd": 5}, {"C_Cmd": 0, "CF_Pause": 1}, {}, {}, {"CS_RunSTA": 10}, {}]
    assert audited([*run, *pausing, {"C_Cmd": 7}, {"C_Cmd": 0, "CS_RunSTA": 6, "CF_Pause": 0}], kind) == []
    assert (
        audited([*run, *pausing, {"C_Cmd": 6}, {"C_Cmd": 0, "CS_RunSTA": 6}, {"CS_RunSTA": 10}], kind) == []
    )


def test_a_paused_flow_does_not_end() -> None:
    paused = [*modes(RUNNING), {"CS_RunSTA": 10}, {}]
    assert audited([*paused, *modes([7, 3])]) == []
    found = audited([*paused, *modes([5])])
    assert told(found) == [(len(paused), "mode.next")]


@pytest.mark.parametrize("kind", Kinds)
def test_a_mode_of_homed_machines_denies_a_flag_that_says_unhomed(kind: Sampling) -> None:
    ready = [*modes(HOMED), {"C_RunMD": 4, "CS_RunSTA": 4, "CF_Home": 0}, *modes([5, 6, 7, 1])]
    found = audited(ready, kind)
    assert told(found) == [(4, "mode.unhomed")]
    assert "V-FUN-2" in found[0].clauses


@pytest.mark.parametrize("kind", Kinds)
def test_the_flag_of_homing_may_come_a_scan_late(kind: Sampling) -> None:
    home = [{"C_RunMD": 2, "CS_RunSTA": 2, "CF_Home": 0}, *modes([3]), {"CF_Home": 1}, *modes([4, 5])]
    assert audited(home, kind) == []


# Whole recordings.


def write(path: Path, said: Sequence[tuple[Channel, Mapping[str, int]]], profile: Any = None) -> Path:
    with TraceWriter(path) as trace:
        if profile:
            trace.add_profile(profile)
        for number, (channel, cells) in enumerate(said):
            trace.add(1000 * number, channel, json.dumps(cells).encode())
    return path


def test_each_controller_of_a_recording_is_followed_by_itself(tmp_path: Path) -> None:
    left, right = Channel.vr("left", "scan"), Channel.vr("right", "polled")
    said = []
    for one, other in zip([*RUNNING, 3], [3, 6, 1, 3, 13, 5, 6, 3], strict=True):
        said += [(left, modes([one])[0]), (right, {"C_RunMD": other})]
    path = write(tmp_path / "two.mcap", said)
    audit = audit_traces([path], profile=None, model=None)
    assert [(f.index, f.rule, f.vmd, f.topic) for f in audit.findings] == [
        (14, "mode.next", "left", "/left/vr")
    ]
    assert audit.inputs[0].messages == audit.inputs[0].events == 16


def test_another_model_skips_the_samples_and_this_one_audits_them(tmp_path: Path) -> None:
    path = write(tmp_path / "made.mcap", [(Channel.vr("press", "scan"), s) for s in modes([1, 5])])
    asked = audit_traces([path], profile=None, model="vr-template")
    assert (len(asked.findings), asked.inputs[0].skipped) == (1, 0)
    skipped = audit_traces([path], profile=None, model="mms-robot")
    assert (skipped.findings, skipped.inputs[0].skipped) == ([], 2)
    with pytest.raises(UsageError, match="no model"):
        audit_traces([path], profile=None, model="vr")


def test_the_profile_in_the_recording_settles_the_numbers(tmp_path: Path) -> None:
    said = [(Channel.vr("press", "scan"), {"C_RunMD": m, "CS_RunSTA": s}) for m, s in [(1, 1), (13, 13)]]
    settled = {"model": "vr-template", "sub_action_status": "13-16"}
    assert audit_traces([write(tmp_path / "a.mcap", said, settled)], profile=None, model=None).findings == []
    noted = audit_traces([write(tmp_path / "b.mcap", said)], profile=None, model=None).findings
    assert [each.severity for each in noted] == ["note"]


@pytest.mark.parametrize("variant", ["as-written", "repaired"])
def test_the_text_as_it_stands_lets_an_error_be_left_by_itself(variant: str, tmp_path: Path) -> None:
    said = [(Channel.vr("press", "scan"), s | {"C_Cmd": 0}) for s in modes([*RUNNING, 8, 8, 1])]
    path = write(tmp_path / "made.mcap", said)
    found = audit_traces([path], profile=None, model=None, variant=variant).findings
    assert [each.rule for each in found] == (["error.left"] if variant == "repaired" else [])


def commanded(command: int, mode: int, *more: dict[str, int]) -> list[dict[str, int]]:
    """A command stands in C_Cmd, then the mode follows and the cell is clear; then more samples."""
    return [{"C_Cmd": command}, {"C_Cmd": 0, "C_RunMD": mode, "CS_RunSTA": mode}, *more]


HOMED_BY_COMMAND = [{"C_Cmd": 0, **modes([0])[0]}, *modes([1]), *commanded(1, 2), *modes([3])]


@pytest.mark.exercises("V-CMD02-2a", "V-CHK-4", "V-DO-X", "V-CMD02-2c", "V-NEXT-03b")
@pytest.mark.parametrize(
    ("then", "rule"),
    [
        (modes([6]), "command.none"),
        (commanded(600, 6), "command.unknown"),
        (commanded(2, 6), "command.other"),
        (commanded(3, 6), ""),
        (modes([5, 5, 8]), ""),
    ],
)
def test_a_mode_that_is_commanded_needs_its_command(then: list[dict[str, int]], rule: str) -> None:
    ready = [*HOMED_BY_COMMAND, *commanded(2, 4), *modes([5])]
    found = [each for each in audited([*ready, *then]) if each.severity != "note"]
    assert [each.rule for each in found] == ([rule] if rule else [])


def test_after_homing_the_origin_is_gone_to_by_itself_only_where_the_flag_says_so() -> None:
    flagged = [{**HOMED_BY_COMMAND[0], "CF_AutoOrg": 1}, *HOMED_BY_COMMAND[1:]]
    assert told(audited([*flagged, *modes([4, 5])])) == []
    cleared = [{**HOMED_BY_COMMAND[0], "CF_AutoOrg": 0}, *HOMED_BY_COMMAND[1:]]
    assert [rule for _, rule in told(audited([*cleared, *modes([4, 5])]))] == ["origin.unasked"]


def test_where_no_command_is_ever_seen_none_is_needed() -> None:
    silent = [{"C_Cmd": 0, **modes([0])[0]}, *modes([1, 2, 3, 4, 5, 6])]
    assert told(audited(silent)) == []


def test_a_stop_may_be_told_by_its_flag() -> None:
    running = [*HOMED_BY_COMMAND, *commanded(2, 4), *modes([5]), *commanded(3, 6)]
    assert told(audited([*running, {"CF_Stop": 1, **modes([7])[0]}, *modes([3])])) == []


UP_TO_RUN = [
    (0, 0, 0), (1, 0, 0), (1, 1, 1), (2, 0, 1), (3, 0, 2),
    (3, 2, 3), (4, 0, 3), (5, 0, 4), (5, 3, 5), (6, 0, 5),
]  # fmt: skip
"""A conforming run up to Run: mode, command, status."""


def scanned(*rows: tuple[int, int, int], **cells: int) -> list[dict[str, int]]:
    return [{"C_RunMD": m, "C_Cmd": c, "CS_RunSTA": s, **cells} for m, c, s in (*UP_TO_RUN, *rows)]


def test_auto_org_after_a_stop_is_a_warning_for_only_a_reading_forbids_it() -> None:
    found = audited(scanned((6, 4, 6), (7, 0, 6), (3, 0, 7), (4, 0, 3), CF_AutoOrg=1))
    assert [(each.index, each.rule, each.severity) for each in found] == [
        (13, "origin.not-after-home", "warning")
    ]
    assert found[0].readings == ("VR-10",)


def test_a_stop_may_be_told_by_its_flag_a_sample_before() -> None:
    stopped = [{**scanned((6, 0, 6))[-1], "CF_Stop": 1}, {**scanned((7, 0, 6))[-1], "CF_Stop": 0}]
    assert audited([*scanned(), *stopped]) == []


def test_a_command_may_be_cleared_a_little_before_the_mode_follows() -> None:
    run = [(1, 0, 1), (1, 1, 1), (1, 0, 1), (2, 0, 1)]
    assert audited([{"C_RunMD": m, "C_Cmd": c, "CS_RunSTA": s} for m, c, s in run]) == []


@pytest.mark.slow
def test_a_table_that_is_too_large_for_an_audit_is_a_bad_request(tmp_path: Path) -> None:
    entry = '[[vr-template.commands]]\nnumber = {n}\nname = "c{n}"\nsub_mode = {n}\nhoming = "homes"\n'
    numbers = [n for first in (101, 201, 301) for n in range(first, first + 40)]
    (tmp_path / "large.toml").write_text("\n".join(entry.format(n=n) for n in numbers), encoding="utf-8")
    with TraceWriter(tmp_path / "made.mcap") as trace:
        trace.add(0, Channel.vr("press", "scan"), b'{"C_RunMD": 1}')
    with pytest.raises(ProfileError, match="too many commands"):
        audit_traces([tmp_path / "made.mcap"], profile=tmp_path / "large.toml", model=None)
