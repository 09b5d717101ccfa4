"""What a rule is, and a breach of one."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from mmsverify.formats.trace import TraceMessage
from mmsverify.model.rows import Clause
from mmsverify.results import Severity


@dataclass(frozen=True, slots=True)
class Rule:
    """One rule: its id in findings, what it rests on, how bad a breach is, the sentence about it.

    ``shown``: it is about something that every poll shows again. ``expects`` is what would have been legal,
    as results name it, and ``observed`` what was there instead; both may have words in them, as ``says``.
    """

    id: str
    clause: Clause
    severity: Severity
    says: str
    shown: bool = False
    expects: tuple[str, ...] = ()
    observed: str = ""


@dataclass(frozen=True, slots=True)
class Breach:
    """A rule that a message breaks, with the words for its sentence, and the other messages that show it.

    ``clause`` is what the thing concerned rests on, where a rule is about many: cited before the rule's own.
    ``at`` is the message that it is told of, where that is not the one that shows it. ``expects`` is what
    would have been legal, where the rule alone does not say it.
    """

    rule: str
    words: Mapping[str, Any] = field(default_factory=dict)
    related: tuple[int, ...] = ()
    clause: Clause | None = None
    at: TraceMessage | None = None
    expects: tuple[str, ...] = ()


def rule(
    name: str,
    says: str,
    *cites: str,
    severity: Severity = "error",
    shown: bool = False,
    expects: tuple[str, ...] = (),
    observed: str = "",
) -> Rule:
    return Rule(name, Clause.of(*cites), severity, says, shown, expects, observed)
