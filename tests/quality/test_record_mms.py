"""Another project's MMS server and client, recorded and audited: nothing to find, until the wire lies.

The devices are no robots (IEC 61850), so that the base standard's rules are what is tried here.
"""

from __future__ import annotations

import asyncio
from contextlib import suppress
from pathlib import Path
from typing import Any

import iec61850
import pytest
from wire import HOST, Change, corrupting, nth, relaying, rows

from mmsverify.auditing import audit_traces
from mmsverify.results import Finding


def point(name: str, constraint: str, kind: Any, value: dict[str, Any]) -> dict[str, Any]:
    """A data attribute of the device."""
    return {"name": name, "fc": constraint, "type": kind, "trg_ops": ["data_changed"], "value": value}


STATE = point("stVal", "ST", "Boolean", {"type": "bool", "value": True})
MODE = point("stVal", "ST", "Enumerated", {"type": "int", "value": 1})
DEVICE = {
    "ied_name": "IED1",
    "lds": [
        {
            "inst": "LD0",
            "lns": [
                {"lln0": True, "dos": [{"name": "Mod", "das": [MODE]}]},
                {"class": "GGIO", "inst": "1", "dos": [{"name": "Ind1", "das": [STATE]}]},
            ],
        }
    ],
}


async def session(port: int) -> None:
    """Names, types, reads, and two services that are answered with an error."""
    client = await iec61850.IedConnection.connect(f"{HOST}:{port}", timeout_ms=2000, request_timeout_ms=1000)
    assert await client.get_server_directory() == ["IED1LD0"]
    assert await client.get_logical_device_directory("IED1LD0") == ["GGIO1", "LLN0"]
    assert await client.get_data_directory("IED1LD0/GGIO1.Ind1") == ["stVal"]
    for _ in range(20):
        assert await client.read("IED1LD0/GGIO1.Ind1.stVal", iec61850.FC.ST) is True
    with suppress(iec61850.IedDataAccessError):
        await client.write_int32("IED1LD0/LLN0.Mod.stVal", iec61850.FC.ST, 2)
    with suppress(iec61850.IedDataAccessError):
        await client.read("IED1LD0/GGIO1.Nowhere.stVal", iec61850.FC.ST)
    await client.disconnect()


def recorded(trace: Path, change: Change | None = None) -> list[Finding]:
    """The findings of a session, the server's octets changed on the wire."""

    async def talk() -> None:
        server = iec61850.IedServer.from_model_spec(DEVICE)
        server.bind(f"{HOST}:0")
        async with server:
            port = int(server.bound_addr.rpartition(":")[2])
            async with corrupting(port, change or bytes) as wire, relaying(trace, wire, "mms") as made:
                try:
                    await session(made.port)
                except (iec61850.IedError, AssertionError):
                    assert change is not None

    asyncio.run(talk())
    return list(audit_traces([trace], profile=None, model=None).findings)


def test_a_conforming_session_is_audited_without_findings(tmp_path: Path) -> None:
    trace = tmp_path / "t.mcap"
    assert recorded(trace) == []
    said = [data for _, data in rows(trace)]
    assert said[0] == "a1 open"
    assert said[-1] == "a1 close"
    assert len([data for data in said if isinstance(data, bytes)]) >= 50
    assert "a1 gap" not in said


def pdu(change: Change) -> Change:
    """Change the confirmed response (A1) in a message; its length stays."""

    def changed(octets: bytes) -> bytes:
        at = octets.index(b"\xa1", 20)
        return octets[:at] + change(octets[at:])

    return changed


@pytest.mark.parametrize(
    ("number", "change", "rule"),
    [
        (5, pdu(lambda o: o[:4] + bytes([o[4] ^ 0x55]) + o[5:]), "protocol.unasked"),  # another invokeID
        (6, pdu(lambda o: o[:5] + b"\xa6" + o[6:]), "protocol.undecodable"),  # another service's answer
        (6, pdu(lambda o: o[:6] + b"\x7f" + o[7:]), "protocol.undecodable"),  # a length that lies
        (5, pdu(lambda o: b"\xa6" + o[1:]), "protocol.undecodable"),  # no PDU begins so
    ],
)
def test_a_session_that_the_wire_corrupts_is_flagged(
    number: int, change: Change, rule: str, tmp_path: Path
) -> None:
    found = recorded(tmp_path / "t.mcap", nth(number, change))
    assert rule in {finding.rule for finding in found if finding.severity == "error"}
