"""The page about the mutation score of the VR framework's models, from the fates of all their mutants."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from mutation_fate import EQUAL, Fate
from mutation_page import alive, equal, line, rules, share, table
from vr_score import TASKS, TEMPLATE


def page(fates: Mapping[str, Sequence[Fate]]) -> str:
    """The whole page, from the fates by model."""
    return HEAD + "\n".join(section(name, fates[name]) for name in (TEMPLATE, TASKS))


def section(name: str, fates: Sequence[Fate]) -> str:
    """What became of the mutants of one model."""
    parts = [
        f"## {name}", table(fates), told(fates),
        "### Alive", alive(fates, reason) or "None.",
        "### Equal rules", equal(fates) or "None.",
        untold(fates),
    ]  # fmt: skip
    return "\n\n".join(part for part in parts if part) + "\n"


def told(fates: Sequence[Fate]) -> str:
    """How many changed rules the recordings alone tell, where that was asked."""
    others = [fate for fate in rules(fates) if fate.fate != EQUAL]
    noticed = sum(bool(fate.told) for fate in others)
    score = f"{noticed} of {len(others)} rules that are not equal, {share(noticed, len(others))}"
    return f"An audit of the recordings, without `check`, tells {score}." if noticed else ""


def untold(fates: Sequence[Fate]) -> str:
    """The changed rules that no recording tells, where that was asked."""
    if not any(fate.told for fate in fates):
        return ""
    left = [fate for fate in rules(fates) if fate.fate != EQUAL and not fate.told]
    return "### Told by no recording\n\n" + UNTOLD + "\n" + "\n".join(map(line, left))


def reason(fate: Fate) -> str:
    """Why it lives, as far as it is known."""
    return fate.by or REASONS.get((fate.kind, fate.place), "not known")


UNTOLD = """\
`check` kills these alone. Most are of what no cell shows: `arrived` (homing has ended just now), `paused` (a
flow is held, before the status says so, and until a Resume that need not be seen), `lost` (beside CF_Home,
which tells the same); or of errors, which come from within, with no command that a sample could lack.
"""
REASONS: dict[tuple[str, str], str] = {}
"""Why mutants live, by kind and place."""

HEAD = """\
# Mutation score of the VR models

Made by `python bench/mutants.py --model vr-template vr-tasks --write`. Each rule of the two models (variant
`repaired`) is written otherwise, one at a time: a step is left out, a condition negated, an effect lost, a
value changed to another; where a rule looks a value up in a table, so is each entry. A change of a
procedure's step changes every row that the step has part in. Then:

- `check` kills a mutant if the search of its reachable states, all of them, finds a run that breaks a claim,
  or nothing any more of what is claimed to happen sometimes. Every claim is written by hand, from the clause
  that it cites; none is made from a row.
- A mutant is *equal* if Z3 proves, under the proved invariants, that its rows do what the real ones do. Which
  of two conditions refuses is not to be seen, nor whether a mode is entered by way of an inserted one before
  it is.
- `audit` kills a mutant of vr-template if some recording gives other findings: the runs written by hand,
  right and wrong ones, scan by scan and polled, and the sample recordings of the press. No recording shows
  the single steps of the two tasks, so that vr-tasks is for `check` alone.
- A claim is negated, or has a condition less, so that it says more than the text; what is to happen sometimes
  is claimed never to happen. `check` kills such a mutant if some run breaks it; it is equal if Z3 proves it,
  too.

"""
