"""The clause register as JSON, schema ``mmsverify.clauses/1``. Its keys are stable; new ones may be added."""

from __future__ import annotations

import json
from collections.abc import Sequence
from typing import Any

from mmsverify.results import Entry, Mended, Register

SCHEMA = "mmsverify.clauses/1"


def render(registers: Sequence[Register], *, long: bool = True) -> str:  # noqa: ARG001 (JSON holds everything)
    models = [_model(register) for register in registers]
    return json.dumps({"schema": SCHEMA, "models": models}, indent=2, ensure_ascii=True) + "\n"


def _model(register: Register) -> dict[str, Any]:
    return {
        "model": register.model,
        "standard": register.standard,
        "variants": list(register.variants),
        "summary": dict(register.counts),
        "clauses": [_entry(entry) for entry in register.entries],
        "repairs": [_repair(mended) for mended in register.repairs],
        "unknown": list(register.unknown),
    }


def _entry(entry: Entry) -> dict[str, Any]:
    statement = entry.statement
    told: dict[str, Any] = {
        "id": statement.id,
        "clause": statement.clause,
        "kind": statement.kind,
        "checks": list(statement.checks),
        "statement": statement.says,
        "uncovered": entry.uncovered,
        "encodedBy": [
            {"kind": e.kind, "name": e.name} | ({"variants": list(e.variants)} if e.variants else {})
            for e in entry.encoded
        ],
        "exercisedBy": [{"by": e.by, "name": e.name} for e in entry.exercised],
    }
    reason = {"reason": statement.reason, "because": statement.because} if statement.reason else {}
    return told | reason


def _repair(mended: Mended) -> dict[str, Any]:
    return {
        "name": mended.name,
        "variant": mended.variant,
        "readings": list(mended.readings),
        "mends": list(mended.mends),
        "because": mended.because,
    }
