"""How a sample follows from the one before, as JSON (``mmsverify.explanation/1``)."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from mmsverify.report.account_json import account
from mmsverify.results import Account, Explanation, PathStep

SCHEMA = "mmsverify.explanation/1"


def render(explanation: Explanation, accounts: Sequence[Account]) -> str:
    """The explanation with a step for each row taken; ends with a line feed."""
    told: dict[str, Any] = {
        "schema": SCHEMA,
        "path": explanation.path,
        "index": explanation.index,
        "controller": explanation.controller,
        "sampling": "scan" if explanation.scan else "polled",
        "first": explanation.first,
        "way": None if explanation.way is None else [_step(step) for step in explanation.way],
        "violations": [asdict(finding) for finding in explanation.findings],
        "accounts": [account(told) for told in accounts],
    }
    return json.dumps(told, indent=2, ensure_ascii=True) + "\n"


def _step(step: PathStep) -> dict[str, Any]:
    return {"action": step.action, "clauses": list(step.clauses), "state": dict(step.state)}
