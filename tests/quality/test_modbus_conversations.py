"""A server that keeps the rules is never blamed; one octet of its answers changed is."""

from __future__ import annotations

from pathlib import Path

import pytest
from modbus_random import Plant, record, write

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding

FEW, MANY, LONG = 8, 100, 1000


def found(path: Path) -> list[Finding]:
    found = audit_traces([path], profile=None, model=None).findings
    # The values that this server shows are random: as if its program wrote everywhere.
    return [finding for finding in found if finding.rule != "modbus.read-back"]


@pytest.mark.parametrize("seed", range(FEW))
def test_a_right_server_is_not_blamed(seed: int, tmp_path: Path) -> None:
    assert found(write(tmp_path / "made.mcap", seed, LONG)) == []


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(100, 100 + MANY))
def test_many_right_servers_are_not_blamed(seed: int, tmp_path: Path) -> None:
    assert found(write(tmp_path / "made.mcap", seed, LONG)) == []


@pytest.mark.parametrize(
    ("octet", "rule"),
    [(2, "modbus.undecodable"), (5, "modbus.undecodable"), (6, "modbus.unit"), (7, "modbus.function")],
)
@pytest.mark.parametrize("seed", [1, 2, 4])
def test_one_wrong_octet_of_an_answer_is_found_there_and_nothing_else(
    seed: int, octet: int, rule: str, tmp_path: Path
) -> None:
    place = spoilt(seed, octet, tmp_path / "made.mcap")
    assert [(finding.index, finding.rule) for finding in found(tmp_path / "made.mcap")] == [(place, rule)]


def spoilt(seed: int, octet: int, path: Path) -> int:
    """The index of the answer in the middle of a conversation of which one octet is written otherwise."""
    said = list(Plant(seed).talk(LONG))
    answers = [n for n, (channel, _) in enumerate(said) if channel.metadata.get("sender") == "server"]
    place = answers[len(answers) // 2]
    channel, data = said[place]
    said[place] = channel, data[:octet] + bytes([data[octet] ^ 0x40]) + data[octet + 1 :]
    record(path, said)
    return place
