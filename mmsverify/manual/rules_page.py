"""The page of rules: every id that a finding may have, what it says and what it rests on."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mmsverify.audit.modbus import MODBUS_RULES
from mmsverify.audit.rules import RULES
from mmsverify.audit.vr import VR_RULES
from mmsverify.manual.markdown import cited, code, table, text
from mmsverify.model import Clause, load
from mmsverify.resources import models_dir

BESIDE = {"mms-robot": RULES, "vr-template": VR_RULES, "modbus-signals": MODBUS_RULES}
"""Rules that no row of the model states: what the text says of messages, values and objects."""

HEAD = """# Rules

The name of the rule is the last word in the first line of a finding. Each rule rests on statements of the
clause registers; words in braces are filled in. `input.unreadable` is of a file that cannot be read;
`error.left` says that a controller left an error state without ResetErr (VR-11)."""


def page() -> str:
    """The rules of the models by which recordings are judged."""
    parts = [part for model in BESIDE for part in _rules(model)]
    return "\n\n".join([HEAD, *parts]) + "\n"


def _rules(model: str) -> Iterator[str]:
    told = {**_of_rows(model), **_beside(model)}
    yield f"## {model}"
    yield table(("rule", "severity", "says", "clauses"), (told[rule] for rule in sorted(told)))


def _of_rows(model: str) -> Mapping[str, tuple[str, ...]]:
    """What the conditions of the rows say of a breach."""
    rows = load(model, models_dir()).rows
    named = {c.rule: c for row in rows for c in row.guard if c.rule and c.says}
    return {rule: _told(model, rule, c.level, c.says, c.clause) for rule, c in named.items()}


def _beside(model: str) -> Mapping[str, tuple[str, ...]]:
    return {r.id: _told(model, r.id, r.severity, r.says, r.clause) for r in BESIDE[model].values()}


def _told(model: str, rule: str, severity: str, says: str, clause: Clause) -> tuple[str, ...]:
    ids = (*clause.ids, *clause.readings)
    return code(rule), severity, text(says), cited(ids, f"clauses/{model}.md", "../readings.md")
