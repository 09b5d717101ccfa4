"""Associations for tests: set up, rejected, and what is said of them."""

from __future__ import annotations

from mmsverify.audit.exchange import Association
from mmsverify.audit.rules import Breach
from mmsverify.formats.mms import Pdu
from mmsverify.samples.pdus import initiation

OFFERED = ("status", "start", "read", "downloadSegment")


def association(
    *services: str, outstanding: int = 2, additional: tuple[str, ...] = ("select",)
) -> Association:
    """An association that has been set up, both sides offering these services."""
    made = Association("a1")
    made.propose(initiation("Request", services or OFFERED, additional, outstanding))
    assert made.agree(initiation("Response", services or OFFERED, additional, outstanding)) == []
    return made


def rules(breaches: list[Breach]) -> list[str]:
    return [breach.rule for breach in breaches]


def reject(invoke_id: int, reason: int = 1, kind: str = "confirmed-request") -> Pdu:
    return Pdu("rejectPDU", invoke_id, body={"rejectReason": (kind, reason)})
