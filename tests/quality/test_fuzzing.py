"""Hostile octets neither crash, hang nor fill the memory: those that once did, and fresh ones."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Iterator
from random import Random

import pytest
from fuzzing import trees
from fuzzing.campaign import Share, Tally, campaign, run
from fuzzing.regressions import regressions
from fuzzing.targets import TARGETS, shares
from fuzzing.watch import Watch, peak

from mmsverify.concrete.automaton import Automaton
from mmsverify.concrete.machine import Machine
from mmsverify.concrete.scope import scope_for
from mmsverify.errors import DecodeError
from mmsverify.formats import mms, vr
from mmsverify.model import load
from mmsverify.model.load import made_for
from mmsverify.profiles import load_profile
from mmsverify.resources import models_dir

FEW, MANY = 3_000, 50_000
SEED = 7
REGRESSIONS = {f"{target}: {name}": (target, octets) for target, name, octets in regressions()}


@pytest.fixture(scope="module")
def watch() -> Iterator[Watch]:
    # The process is that of many other tests: its size says nothing, nor does a second on a busy machine.
    # What was a fault took many; bench/fuzz.py is held to one.
    with Watch(largest=None, longest=4.0) as one:
        yield one


@pytest.mark.parametrize("case", REGRESSIONS)
def test_what_was_a_fault_once_is_none_any_more(case: str, watch: Watch) -> None:
    target, octets = REGRESSIONS[case]
    assert watch.judge(TARGETS[target].run, octets).fault == ""


@pytest.mark.parametrize("target", TARGETS)
def test_some_fresh_inputs_do_no_harm(target: str) -> None:
    tally = run(Share(target, 0, shares(FEW, list(TARGETS))[target]), SEED, largest=None)
    assert tally.failures == []


@pytest.mark.slow
def test_many_fresh_inputs_do_no_harm_in_processes_of_their_own() -> None:
    parts = [Share(target, 0, count) for target, count in shares(MANY, list(TARGETS)).items()]
    tallies = list(campaign(parts, SEED + 1, processes=2))
    assert [failure for tally in tallies for failure in tally.failures] == []
    assert sum(tally.inputs for tally in tallies) == MANY


@pytest.mark.parametrize("target", TARGETS)
def test_an_input_is_made_by_its_number(target: str) -> None:
    made = [TARGETS[target].input(SEED, at) for at in range(60)]
    assert made[7:20] == [TARGETS[target].input(SEED, at) for at in range(7, 20)]
    assert len(set(made)) > 30


def test_the_shares_of_a_million_are_a_million() -> None:
    assert sum(target.share for target in TARGETS.values()) == 1_000_000
    assert sum(shares(12_345, list(TARGETS)).values()) == 12_345


def test_the_watch_tells_crashes_hangs_and_refusals(watch: Watch) -> None:
    def hangs(octets: bytes) -> bool:
        while True:
            try:
                octets += b"x"
                octets = octets[:1]
            except Exception:
                return True

    def crashes(octets: bytes) -> bool:
        return octets[9] == 0

    assert watch.judge(hangs, b"x").fault == "hang"
    assert watch.judge(crashes, b"x").fault.startswith("IndexError")
    assert watch.judge(TARGETS["mms"].run, b"x").fault == ""
    assert not watch.judge(TARGETS["mms"].run, b"x").accepted


def test_the_watch_tells_what_takes_too_much_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    # What this process really holds, and held once for other tests, is theirs to decide.
    sizes = iter([100.0, 499.0, 499.0, 501.0, 501.0, 501.0])
    monkeypatch.setattr("fuzzing.watch.peak", lambda: next(sizes))
    with Watch(largest=500.0) as one:
        assert [one.judge(lambda _: True, b"x").fault for _ in range(3)] == ["", "memory", ""]
    monkeypatch.undo()
    assert peak() > 10


def test_a_worker_that_dies_is_the_fault_of_its_input(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("fuzzing.campaign._work", _dies)
    tallies: list[Tally] = list(campaign([Share("mms", 0, 2)], SEED, processes=1))
    found = [(failure.number, failure.fault) for tally in tallies for failure in tally.failures]
    assert found == [(0, "the worker died"), (1, "the worker died")]


def _dies(*_: object) -> None:
    raise SystemExit(3)


def test_a_tree_that_is_not_changed_is_written_as_it_was_read() -> None:
    octets = bytes.fromhex("a10b0201018006040431323334")
    nodes = trees.parse(octets)
    assert nodes is not None
    assert trees.written(nodes) == octets
    assert trees.tree(Random(1), octets, [octets]) != octets


def test_an_integer_of_any_length_is_told_by_its_length() -> None:
    octets = bytes.fromhex("a08207d7028207d07f") + b"\xff" * 1999 + bytes.fromhex("8001ff")
    with pytest.raises(DecodeError, match="an INTEGER of 2000 octets, and 256 is the most"):
        mms.decode(octets)


def test_a_name_of_any_length_names_no_cell() -> None:
    assert vr.cell("VR(0)" + " " * 300) is None


def test_an_automaton_that_nobody_holds_is_not_kept() -> None:
    tables = load_profile(None)["vr-template"]
    model = made_for(load("vr-template", models_dir(), "repaired"), tables)
    automaton = Automaton(Machine(model, scope_for(model, {}, {})))
    automaton.value(0, "mode")
    held = weakref.ref(automaton)
    del automaton
    gc.collect()
    assert held() is None
