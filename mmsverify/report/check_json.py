"""Verdicts as JSON, schema ``mmsverify.check/1``. Its keys are stable; new ones may be added."""

from __future__ import annotations

import json
from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

from mmsverify.report.wording import plain, seconds
from mmsverify.results import ModelCheck, PathStep, Verdict

SCHEMA = "mmsverify.check/1"


def render(checks: Sequence[ModelCheck]) -> str:
    models = [_model(check) for check in checks]
    return json.dumps({"schema": SCHEMA, "models": models}, indent=2, ensure_ascii=True) + "\n"


def _model(check: ModelCheck) -> dict[str, Any]:
    model: dict[str, Any] = {
        "model": check.model,
        "variant": check.variant,
        "properties": [_property(verdict) for verdict in check.verdicts],
    }
    if check.profile:
        model["profile"] = [plain(asdict(found)) for found in check.profile]
    if check.left_out:
        model["left_out"] = list(check.left_out)
    return model | ({"notes": list(check.notes)} if check.notes else {})


def _property(verdict: Verdict) -> dict[str, Any]:
    told = {
        "name": verdict.name,
        "kind": verdict.kind,
        "clauses": list(verdict.clauses),
        "result": verdict.result,
        "method": verdict.method,
        "scope": verdict.scope,
        "depth": verdict.depth,
        "seconds": seconds(verdict.seconds),
        "counterexample": _path(verdict.counterexample),
        "witness": _path(verdict.witness),
    }
    return told | ({"reason": verdict.reason} if verdict.reason else {})


def _path(steps: Sequence[PathStep] | None) -> dict[str, Any] | None:
    return None if steps is None else {"steps": [_step(step) for step in steps]}


def _step(step: PathStep) -> dict[str, Any]:
    return {
        "action": step.action,
        "arguments": plain(step.arguments),
        "clauses": list(step.clauses),
        "state": plain(step.state),
    }
