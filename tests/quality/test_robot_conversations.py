"""A robot that keeps the rules is never blamed: random conversations made from the rows, as recordings."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from pathlib import Path
from random import Random
from typing import Any

import pytest
from robot import robot
from robot_acts import IN_REFUSALS, IN_REQUESTS, LOOKS
from robot_conversations import blamed, conversation
from robot_random import Chance
from robot_retelling import retold, shrunk
from robot_talk import ARMS, ASSOCIATING, Talk, row_name

from mmsverify.audit import robot as adapter
from mmsverify.audit.transfers import UPLOADING
from mmsverify.checking import robot_messages as messages
from mmsverify.checking.domain_messages import FROM_ROBOT
from mmsverify.concrete.trace_path import readable
from mmsverify.formats.mms import decode, encode
from mmsverify.model import ModelData

FEW, MANY = 4, 8
SHORT, LONG = 24, 500


def told(talk: Talk, path: Path) -> str:
    """Nothing, or the first false accusation with the least that leads to it."""
    found = blamed(talk, path)
    if not found:
        return ""
    rule = found[0].rule
    small = shrunk(talk, lambda shorter: any(f.rule == rule for f in blamed(shorter, path)))
    accused = (f"{f.index} {f.rule}: {f.message} {f.before}" for f in blamed(small, path))
    return "\n".join([*map(str, small.done), *accused])


@pytest.mark.parametrize("seed", range(FEW))
def test_a_short_conversation_with_a_right_robot_is_not_blamed(seed: int, tmp_path: Path) -> None:
    assert told(conversation(seed, SHORT), tmp_path / "made.mcap") == ""


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(1000, 1000 + MANY))
def test_a_long_conversation_with_a_right_robot_is_not_blamed(seed: int, tmp_path: Path) -> None:
    assert told(conversation(seed, LONG), tmp_path / "made.mcap") == ""


def test_a_conversation_is_told_again_from_its_acts() -> None:
    talk = conversation(3, LONG)
    assert retold(talk, talk.done).messages == talk.messages


@pytest.mark.slow
def test_the_conversations_take_nearly_every_row() -> None:
    """What is never taken proves nothing by not being blamed."""
    taken = {act.what for seed in range(2000, 2016) for act in conversation(seed, 400).done}
    rows = {row_name(row) for row in robot("repaired").actions if row.on.phase in ("response", "internal")}
    rows -= {row for row in rows if row.split("/")[0] in ASSOCIATING}
    assert len(rows & taken) / len(rows) >= LEAST_TAKEN, sorted(rows - taken)


LEAST_TAKEN = 0.65
"""A ratchet: it may rise, never fall."""


def services(model: ModelData) -> list[str]:
    """Those of which a request alone says all that the robot is asked for."""
    found = {row.on.service for row in model.rows if row.on.phase == "response"}
    return sorted(found - ASSOCIATING.keys() - FROM_ROBOT - UPLOADING)


@pytest.mark.parametrize("service", services(robot("repaired")))
def test_a_request_of_every_service_is_encoded_and_read_back(service: str) -> None:
    """All arguments arrive, or the robot is asked for something else than the rows say."""
    chance = Chance(conversation(0, 0), 1)
    for seed in range(40):
        chance.random = Random(seed)
        wanted = chance.arguments(service, {"request": "request1", "user": "client1", "panel": False})
        said = {name: readable(held) for name, held in wanted.items()}
        # Of that name, it can have no other domain.
        said["binds_arm"] = said.get("pi") in ARMS or "R_ARM" in said.get("domains", ())
        said["controlled"] = (
            said.get("controlled", []) if said.get("controlling") else []
        )  # no list without its owner
        call = adapter.performed(decode(encode(messages.request(7, service, said))), ARMS)
        assert call is not None, f"{service}: the request is not read"
        again = decode(encode(messages.request(7, service, {**said, **listed(call.bindings)})))
        assert adapter.performed(again, ARMS) == call
        assert {k: v for k, v in listed(call.bindings).items() if k in ALWAYS_SAID} == {
            k: said.get(k) for k in ALWAYS_SAID & call.bindings.keys()
        }


ALWAYS_SAID = frozenset({"pi", "kind", "reuse", "binds_arm", "controlling", "controlled", "domain", "shares"})
"""Arguments that a request carries whatever the others are; a count, say, needs a limit."""


def listed(bindings: Mapping[str, Any]) -> dict[str, Any]:
    return {name: readable(held) for name, held in bindings.items()}


def shown_services(model: ModelData) -> Iterator[str]:
    for row in model.rows:
        if row.on.phase == "shown":
            yield row.on.service


def test_every_observation_of_the_model_is_made_by_some_message() -> None:
    made = {name for names in LOOKS.values() for name in names} | {*IN_REFUSALS, *IN_REQUESTS}
    assert set(shown_services(robot("repaired"))) == made
