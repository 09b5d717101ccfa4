"""A machine with commands of its own: never blamed while it keeps its table, else at the right sample."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cache
from pathlib import Path

import pytest
from vr_random import BEGIN, NAME, SCAN, Run, automaton, framework, write
from vr_runs import KINDS, Sampling, blamed, recording
from vr_story import told

from mmsverify.audit.telling import Place
from mmsverify.audit.vr import Controller, Numbering, Scans
from mmsverify.formats.trace import Channel, TraceMessage
from mmsverify.formats.vr import encode
from mmsverify.results import Finding

MACHINES = {
    "press": "",
    "homes by hand": """
[[vr-template.commands]]
number = 110
name = "home by hand"
sub_mode = 1
homing = "homes"
[[vr-template.commands]]
number = 111
name = "servo off"
sub_mode = 2
homing = "loses"
allowed = ["DbgRdy", "HomeRdy"]
[[vr-template.commands]]
number = 112
name = "home by hand, by the second button"
sub_mode = 1
homing = "homes"
[[vr-template.commands]]
number = 210
name = "teach"
sub_mode = 1
""",
}
LONG, SEEDS = 2000, (0, 2, 4)
SUB = {0: 0, 101: 1, 102: 2, 203: 3, 305: 5, 306: 6, 402: 2}
HOMED = "0 1 1! 2 3"
READY = f"{HOMED} 2! 4 5"


def machine(name: str, folder: Path) -> str:
    """The profile of a machine: its name if it is shipped, else the file."""
    if not MACHINES[name]:
        return name
    path = folder / "machine.toml"
    path.write_text(f'[vr-template]\nsub_action_status = "11-14"\n{MACHINES[name]}', encoding="utf-8")
    return str(path)


@cache
def scans(table: str) -> Scans:
    return Scans(automaton(table))


def samples(story: str, subs: Sequence[int] | None = None) -> list[dict[str, int]]:
    """The samples of a story; C_SubMD is set with each command of the press, or is as in ``subs``."""
    found, sub, command = [], 0, 0
    for number, cells in enumerate(told(story)):
        if cells["C_RunMD"] in (13, 14, 15, 16):
            sub = SUB.get(command, sub)
        command = cells["C_Cmd"] or (command if cells["C_RunMD"] in (13, 14, 15, 16) else 0)
        found.append(cells | {"C_SubMD": sub if subs is None else subs[number]})
    return found


def findings(cells: Iterable[dict[str, int]], kind: Sampling, table: str = "press") -> list[Finding]:
    numbering = Numbering(framework(machine=table).options["numbers"], "13-16")
    controller = Controller(Place("told.mcap", NAME), scans(table), numbering)
    channel = Channel.vr(NAME, kind)
    written = (TraceMessage(n, BEGIN + n * SCAN, channel, encode(each)) for n, each in enumerate(cells))
    return [found for message in written for found in controller.sample(message) if found.severity != "note"]


def places(found: Iterable[Finding]) -> list[tuple[int | None, str]]:
    return [(each.index, each.rule) for each in found]


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("name", MACHINES)
def test_a_machine_that_keeps_its_table_is_not_blamed(
    name: str, seed: int, kind: Sampling, tmp_path: Path
) -> None:
    table = machine(name, tmp_path)
    recording(seed, LONG, kind, path := tmp_path / "made.mcap", table)
    assert blamed(path, table) == []


@pytest.mark.parametrize("name", MACHINES)
def test_the_runs_take_every_row_of_the_machine(name: str, tmp_path: Path) -> None:
    table, taken = machine(name, tmp_path), set[str]()
    for seed in SEEDS:
        run = Run(seed, machine=table)
        assert sum(1 for _ in run.samples(LONG)) == LONG
        taken |= run.taken
    rows = {row.id for row in framework(machine=table).actions if row.answer != "result(-)"}
    unused = {"home_action_ends", "origin_action_ends", "run_action_ends", "debug_action_ends"}
    assert rows - taken - unused == set()


@pytest.mark.parametrize("kind", KINDS)
def test_the_same_run_is_blamed_where_its_profile_knows_fewer_commands(
    kind: Sampling, tmp_path: Path
) -> None:
    cells = samples(f"{READY} 306! 15 5")
    write(path := tmp_path / "made.mcap", kind, cells)
    fewer = tmp_path / "fewer.toml"
    entry = '{number = 305, name = "test", sub_mode = 5}'
    fewer.write_text(f'[vr-template]\nsub_action_status = "13-16"\ncommands = [{entry}]\n', encoding="utf-8")
    assert blamed(path) == []
    (found,) = blamed(path, str(fewer))
    if kind == "scan":
        assert (found.index, found.rule) == (9, "command.unknown")
        assert {"V-DO-X", "V-CHK-4", "V-DO-301"} <= set(found.clauses)
        assert "306" in found.message
    else:
        assert (found.index, found.rule) == (9, "sub-mode.number")


@pytest.mark.exercises("V-DO-[123]01", "V-DO-X", "V-CHK-4")
@pytest.mark.parametrize(
    ("story", "place"), [("0 1 103! 13 1", 3), (f"{HOMED} 201! 14 3", 6), (f"{READY} 301! 15 5", 9)]
)
def test_acting_upon_a_number_that_the_table_does_not_have_is_a_finding(story: str, place: int) -> None:
    (found,) = findings(samples(story, [0] * 20), "scan")
    assert (found.index, found.rule) == (place, "command.unknown")
    assert "V-DO-X" in found.clauses


@pytest.mark.parametrize("kind", KINDS)
def test_a_mode_of_which_the_table_has_no_command_is_a_finding_once(kind: Sampling, tmp_path: Path) -> None:
    table = machine("homes by hand", tmp_path)
    (found,) = findings(samples(f"{READY} 305! 15 15 15 5 3! 6", [0] * 20), kind, table)
    assert found.index == 9
    assert found.severity == "error"


def test_a_command_where_the_table_does_not_allow_it_is_a_finding_that_names_it() -> None:
    (found,) = findings(samples(f"{READY} 203! 14 3"), "scan")
    assert (found.index, found.rule) == (9, "own-command.not-allowed")
    assert "change die (203), which the profile allows in HomeRdy only" in found.message
    assert "V-CHK-2" in found.clauses


@pytest.mark.parametrize("kind", KINDS)
def test_a_command_where_the_framework_does_not_allow_it_is_a_finding_that_names_it(kind: Sampling) -> None:
    story = "0 1 305! 15 5" if kind == "scan" else "0 1 8! 8 15:8 5"
    (found,) = findings(samples(story, [0] * 20), kind)
    assert found.rule == "origin-action.not-ready"
    assert "(30" in found.message
    assert "V-SUBO-2" in found.clauses


RUN = f"{READY} 305! 15 15 5 5"
"""In samples 9 and 10 the action of command 305 goes on."""


@pytest.mark.exercises("V-DO-301", "V-VR-04")
@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("wrong", [6, 7, 0])
def test_a_sub_mode_that_is_not_the_tables_is_a_finding(wrong: int, kind: Sampling) -> None:
    """By 305 DoCmd sets 5; 6 is another command's, 7 no command's, and 0 what stood there before."""
    found = findings(samples(RUN, [0] * 9 + [wrong] * 4), kind)
    if kind == "polled" and wrong == 6:
        assert found == []  # of a polled sample another command may have gone before
        return
    assert places(found) == [(9, "sub-mode.number")]
    assert found[0].clauses[0] == "V-DO-301"
    assert found[0].observed == f"C_SubMD={wrong}"
    assert found[0].expected == (("C_SubMD=5",) if kind == "scan" else ("C_SubMD=5", "C_SubMD=6"))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(
    "subs", [[0] * 9 + [5] * 4, [0] * 10 + [5] * 3, [0] * 8 + [5] * 5], ids=["at once", "late", "early"]
)
def test_a_sample_may_show_the_sub_mode_a_sample_early_or_late(subs: list[int], kind: Sampling) -> None:
    assert findings(samples(RUN, subs), kind) == []


BASIC = """
V-DO-01    0 1 1! 2* 3 3
V-DO-02    0 1 1! 2 3 2! 4* 5 5
V-DO-03    0 1 1! 2 3 2! 4 5 3! 6* 6 6
V-DO-04    0 1 1! 2 4! 7* 1 1
V-CMD02-2b 0 1 305! 1* 1 1
V-DO-X     0 1 77! 1* 1 1
"""


@pytest.mark.exercises("V-DO-0[1-4]", "V-DO-X", "V-VR-04")
@pytest.mark.parametrize("table", ["press", ""])
@pytest.mark.parametrize("line", BASIC.strip().splitlines())
def test_a_command_that_is_none_of_the_users_leaves_the_sub_mode(line: str, table: str) -> None:
    clause, story = line.split(maxsplit=1)
    place = next(n for n, word in enumerate(story.split()) if "*" in word)
    (found,) = findings(samples(story, [3] * place + [4] * 9), "scan", table)
    assert (found.index, found.rule, found.severity) == (place, "sub-mode.changed", "error")
    assert clause in found.clauses


@pytest.mark.exercises("V-DO-00")
def test_without_a_command_the_sub_mode_stays_as_it_is() -> None:
    (found,) = findings(samples("0 1 1! 2 2 2 2", [3] * 5 + [4] * 9), "scan", "")
    assert (found.index, found.rule, found.severity) == (5, "sub-mode.unasked", "warning")
    assert "V-DO-00" in found.clauses


@pytest.mark.parametrize("kind", KINDS)
def test_without_a_table_an_action_may_have_any_number(kind: Sampling) -> None:
    assert findings(samples(RUN, [0] * 9 + [77] * 4), kind, "") == []


@pytest.mark.parametrize("kind", KINDS)
def test_an_action_that_loses_homing_leaves_an_unhomed_machine_and_one_that_keeps_it_does_not(
    kind: Sampling,
) -> None:
    """A Stop leads to DbgRdy or HomeRdy: with 102 the homing may be lost by then, with 101 it is not."""
    lost, kept = (samples(f"{HOMED} {number}! 13 13 4! 7 1 1") for number in (102, 101))
    for cells in (*lost, *kept):
        del cells["CF_Home"]
    assert findings(lost, kind) == []
    if kind == "scan":
        assert [each.rule for each in findings(kept, kind)] == ["mode.next"]
