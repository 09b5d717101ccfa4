"""Why findings stand, as JSON (``mmsverify.explain/1``)."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from mmsverify.report.audit_json import violation
from mmsverify.results import Account, Edit, Ground

SCHEMA = "mmsverify.explain/1"


def render(path: str, index: int, accounts: Sequence[Account]) -> str:
    """The accounts of the findings of one message; ends with a line feed."""
    told = {"schema": SCHEMA, "path": path, "index": index, "accounts": [*map(account, accounts)]}
    return json.dumps(told, indent=2, ensure_ascii=True) + "\n"


def account(told: Account) -> dict[str, Any]:
    """One account; octets are told in hex."""
    return {
        "violation": violation(told.finding),
        "event": told.event,
        "asked": told.asked,
        "statements": [
            {"id": each.id, "clause": each.clause, "statement": each.says} for each in told.statements
        ],
        "readings": dict(told.readings),
        "grounds": [*map(_ground, told.grounds)],
        "earliest": told.earliest,
        "right": None if told.right is None else _edit(told.right),
        "later": list(told.later),
        "edits": [*map(_edit, told.edits)],
        "remarks": list(told.remarks),
    }


def _ground(ground: Ground) -> dict[str, Any]:
    return {
        "messages": [{"index": m.index, "asked": m.asked, "words": m.words} for m in ground.messages],
        "earliest": ground.earliest,
        "irreducible": ground.irreducible,
        "stretch": ground.stretch,
    }


def _edit(edit: Edit) -> dict[str, Any]:
    said = [{"topic": topic, "octets": octets.hex()} for topic, octets in edit.said]
    return {"kind": edit.kind, "index": edit.index, "asked": edit.asked, "words": edit.words, "said": said}
