"""Pages about mutation scores, from the fates of all mutants: what every model's page has."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from mutation_fate import AUDIT, CHECK, CLAIM, EQUAL, Fate

Reason = Callable[[Fate], str]
"""Why a mutant lives, as far as it is known."""


def share(part: int, whole: int) -> str:
    """A share in percent, rounded down: a score is never told better than it is. Of nothing there is none."""
    return f"{1000 * part // whole / 10:.1f} %" if whole else "-"


def count(fates: Sequence[Fate], *kinds: str) -> int:
    return sum(fate.fate in kinds for fate in fates)


def row(name: str, fates: Sequence[Fate]) -> str:
    """A line of the table."""
    made, check, equal, audit = len(fates), count(fates, CHECK), count(fates, EQUAL), count(fates, AUDIT)
    others = made - equal
    killed = check + audit
    cells = [made, equal, check, audit, others - killed, share(check, others), share(killed, others)]
    return f"| {name} | " + " | ".join(map(str, cells)) + " |"


def table(fates: Sequence[Fate]) -> str:
    """How many mutants of which kind were made, and what became of them."""
    kinds = dict.fromkeys((fate.what, fate.kind) for fate in fates)
    lines = [
        "| mutants of | made | equal | by `check` | then by `audit` | alive | `check` alone | killed |",
        "|---|---|---|---|---|---|---|---|",
        *(row(f"{w}: {k}", [f for f in fates if (f.what, f.kind) == (w, k)]) for w, k in kinds),
        row("all rules", rules(fates)),
        row("all properties", [fate for fate in fates if fate.what == CLAIM]),
        row("all", fates),
    ]
    return "\n".join(lines)


def rules(fates: Sequence[Fate]) -> list[Fate]:
    """Those of rules, claims apart."""
    return [fate for fate in fates if fate.what != CLAIM]


def alive(fates: Sequence[Fate], reason: Reason) -> str:
    """What nothing kills, and why."""
    return "\n".join(f"{line(fate)}: {reason(fate)}" for fate in fates if fate.open)


def equal(fates: Sequence[Fate]) -> str:
    """The changed rules that do what the real ones do."""
    return "\n".join(line(fate) for fate in rules(fates) if fate.fate == EQUAL)


def line(fate: Fate) -> str:
    """What was changed, as an item of a list."""
    return f"- {fate.what}, {fate.kind}: `{fate.place}`"


ALIVE = "\n\n## Alive\n\n"
EQUALS = "\n\n## Equal rules\n\nNo reachable state tells them apart, so no test can.\n\n"
