"""Checking models: every verdict says how it was reached and where it holds; nothing open looks settled."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import pytest

from mmsverify.checking import check_models, write_counterexamples
from mmsverify.errors import UsageError
from mmsverify.results import ModelCheck, Verdict

LAMPS = '''"""Lamps of which one at a time is lit."""
from mmsverify.model import *

class Lamps(Model, name="lamps"):
    L = Each("Lamp")
    a, b = L.elements("a b")
    lit = Relation(L)
    known = Relation(L)
    broken = Relation()

    learn = Transition("L-1", on=internal("learn", a), then=[known[a].becomes(True)])
    press = Procedure("L-2", on=response("press", a), steps=[
        refuse("a", when=for_some(b)(lit[b])),
        do("b", lit[a].becomes(True)),
        accept("m"),
    ])
    forget = Transition("L-3", on=internal("forget", a), then=[known[a].becomes(False)])

    dark = Initially("L-0", for_all(a)(~lit[a] & ~known[a]) & ~broken())
    one_lit = Always("L-4", for_all(a, b)((lit[a] & lit[b]) >> (a == b)))
    lit_is_known = Always("L-5", for_all(a)(lit[a] >> known[a]))
    known_is_whole = Always("L-6", for_all(a)((known[a] & broken()) >> lit[a]))
    stays_lit = Step("L-7", for_all(a)(lit[a] >> lit[a].next))
    knowledge_stays = Step("L-8", for_all(a)(known[a] >> known[a].next))
    some_lit = Sometimes("L-9", for_some(a)(lit[a]))
    two_known = Sometimes("L-10", for_some(a, b)(known[a] & known[b] & (a != b)))
    breaks = Sometimes("L-11", broken())
    goes_out = Sometimes("L-12", service_is("press") & for_some(a)(lit[a] & ~lit[a].next))
'''


@pytest.fixture(scope="module")
def lamps(tmp_path_factory: pytest.TempPathFactory) -> str:
    path = tmp_path_factory.mktemp("models") / "lamps.py"
    path.write_text(LAMPS, encoding="utf-8")
    return str(path)


def check(model: str, **options: Any) -> ModelCheck:
    (found,) = check_models([model], **options)
    return found


def verdicts(model: str, **options: Any) -> dict[str, Verdict]:
    return {verdict.name: verdict for verdict in check(model, **options).verdicts}


def test_a_claim_that_is_inductive_is_proved_for_any_number(lamps: str) -> None:
    found = verdicts(lamps)["one-lit"]
    assert (found.result, found.method, found.scope) == ("proved", "induction", "any number of L")


def test_a_true_claim_that_is_not_inductive_is_proved_by_a_sharper_one(lamps: str) -> None:
    found = verdicts(lamps)["known-is-whole"]
    assert (found.result, found.method) == ("proved", "induction")


def test_a_false_claim_is_violated_by_the_shortest_run(lamps: str) -> None:
    found = verdicts(lamps)["lit-is-known"]
    assert (found.result, found.method, found.scope, found.depth) == ("violated", "bmc", "L=1", 1)
    assert found.counterexample is not None
    assert [step.action for step in found.counterexample] == ["initially", "press result(+)"]
    assert found.counterexample[-1].state["lit[L1]"] is True


def test_a_claim_that_names_a_parameter_is_of_the_steps_that_have_it(tmp_path: Path) -> None:
    path = tmp_path / "pressed.py"
    path.write_text(LAMPS + '    pressed_dark = Step("L-13", ~lit[a])\n', encoding="utf-8")
    found = verdicts(str(path), properties=["pressed-dark"])["pressed-dark"]
    assert (found.result, found.depth) == ("violated", 2)
    assert found.counterexample is not None
    assert found.counterexample[-1].arguments == {"a": "L1"}
    assert found.counterexample[-2].state["lit[L1]"] is True


def test_a_false_claim_about_steps_is_violated_by_a_run_that_ends_in_the_step(lamps: str) -> None:
    found = verdicts(lamps)["knowledge-stays"]
    assert found.counterexample is not None
    assert [step.action for step in found.counterexample] == ["initially", "learn", "forget"]


def test_what_is_reachable_is_proved_with_a_witness_in_the_least_scope(lamps: str) -> None:
    found = verdicts(lamps)
    assert found["some-lit"].witness is not None
    assert (found["two-known"].result, found["two-known"].scope, found["two-known"].depth) == (
        "proved",
        "L=2",
        2,
    )


@pytest.mark.parametrize("name", ["breaks", "goes-out"])
def test_what_is_proved_unreachable_is_violated_for_any_number(lamps: str, name: str) -> None:
    found = verdicts(lamps)[name]
    assert (found.result, found.method, found.scope) == ("violated", "induction", "any number of L")
    assert "no run reaches" in found.reason


def test_a_scope_that_is_searched_whole_proves_in_that_scope_only(lamps: str) -> None:
    found = verdicts(lamps, scope={"L": 2})["one-lit"]
    assert (found.result, found.method, found.scope) == ("proved", "exhaustive", "L=2")


def test_what_a_whole_scope_does_not_reach_stays_unknown(lamps: str) -> None:
    found = verdicts(lamps, scope={"L": 1})["two-known"]
    assert found.result == "unknown"
    assert "L=1, searched whole" in found.reason


def test_a_bound_on_depth_alone_settles_nothing(lamps: str) -> None:
    found = verdicts(lamps, scope={"L": 2}, depth=1)["one-lit"]
    assert (found.result, found.method, found.depth) == ("unknown", "bmc", 1)


def test_unbounded_looks_for_no_counterexample(lamps: str) -> None:
    found = verdicts(lamps, unbounded=True)
    assert (found["lit-is-known"].result, found["lit-is-known"].counterexample) == ("unknown", None)
    assert "press/m may break it" in found["lit-is-known"].reason
    assert found["one-lit"].result == "proved"


def test_only_the_named_properties_are_told_with_hyphens_or_without(lamps: str) -> None:
    assert list(verdicts(lamps, properties=["one-lit", "some_lit"])) == ["one-lit", "some-lit"]


def test_an_unknown_property_is_refused_with_the_nearest_name(lamps: str) -> None:
    with pytest.raises(UsageError, match=r"no property named 'one-lip' \(did you mean one-lit\?\)"):
        check(lamps, properties=["one-lip"])


def test_an_unknown_property_like_no_other_is_refused_with_some_names_only() -> None:
    with pytest.raises(UsageError, match=r"no property named 'zzz' \(there are \d+, among them ") as caught:
        check("mms-robot", properties=["zzz"])
    assert caught.value.cure.count(",") <= 9


def test_properties_that_a_profile_leaves_out_are_named() -> None:
    found = check("mms-robot", properties=["power-comes", "runs-steps"], profile=Path("no-step"))
    assert ([v.name for v in found.verdicts], found.left_out) == (["power-comes"], ("runs-steps",))


def test_what_a_model_without_properties_leaves_open_is_still_told(tmp_path: Path) -> None:
    path = tmp_path / "bare.py"
    path.write_text(
        "from mmsverify.model import *\nclass Bare(Model, name='bare'):\n    lit = Relation()\n"
        "    fuse = Unspecified('L-1', 'what happens when the fuse blows')\n"
    )
    assert check(str(path)).notes == ("gap fuse (L-1): what happens when the fuse blows",)


def test_a_check_of_which_a_profile_leaves_nothing_is_refused() -> None:
    with pytest.raises(UsageError, match="runs-steps: not claimed of what has this profile"):
        check("mms-robot", properties=["runs-steps"], profile=Path("no-step"))


def test_bounds_of_integers_are_told_only_where_a_verdict_rests_on_a_scope(lamps: str) -> None:
    assert any("integers" in note for note in check(lamps, scope={"L": 1}).notes)
    assert not any("integers" in note for note in check(lamps).notes)


@pytest.mark.parametrize("scope", [{"Lamp": 2}, {"L": 0}])
def test_a_scope_that_no_model_has_is_refused(lamps: str, scope: dict[str, int]) -> None:
    with pytest.raises(UsageError, match="--scope"):
        check(lamps, scope=scope)


def test_the_same_check_gives_the_same_verdicts(lamps: str) -> None:
    told = [
        [(v.name, v.result, v.method, v.scope, v.counterexample) for v in check(lamps).verdicts]
        for _ in range(2)
    ]
    assert told[0] == told[1]


@pytest.mark.parametrize("scope", [None, {"PI": 2}])
def test_a_time_limit_is_kept_from_the_first_proofs_on(scope: dict[str, int] | None) -> None:
    begin = time.process_time()
    found = check("mms-robot", timeout=1e-4, scope=scope)
    assert time.process_time() - begin < 5  # the proofs alone take more without a limit
    assert "unknown" in {v.result for v in found.verdicts}
    assert all(v.reason for v in found.verdicts if v.result == "unknown")
    assert "the time limit was reached: what is open was not looked into further" in found.notes


def test_a_time_limit_that_is_not_reached_changes_nothing(lamps: str) -> None:
    def told(**options: Any) -> list[tuple[str, str, str]]:
        return [(v.name, v.result, v.method) for v in check(lamps, **options).verdicts]

    assert told(timeout=100.0) == told()


@pytest.mark.parametrize("properties", [[], ["lit-is-known"], ["one-lit", "some-lit"]])
def test_seconds_add_up_to_the_time_of_the_check(lamps: str, properties: list[str]) -> None:
    begin = time.monotonic()
    found = check(lamps, properties=properties)
    elapsed = time.monotonic() - begin
    assert elapsed / 2 < sum(v.seconds for v in found.verdicts) <= elapsed


def test_progress_is_told(lamps: str) -> None:
    lines: list[str] = []
    check(lamps, progress=lines.append)
    assert lines[0] == "lamps: proving by induction"


def test_runs_of_another_model_are_not_written_as_traces(lamps: str, tmp_path: Path) -> None:
    with pytest.raises(UsageError, match="only runs of mms-robot"):
        write_counterexamples([check(lamps)], tmp_path)
