"""How a sample follows from the one before, as text: each step with its clauses and what it changes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from mmsverify.report.account_text import account
from mmsverify.report.wording import printable
from mmsverify.results import Account, Explanation, PathStep


def render(explanation: Explanation, accounts: Sequence[Account]) -> str:
    """The shortest legal way, or why there is none, then the accounts of findings; ends with a line feed."""
    told = ["\n".join(_lines(explanation)), *map(account, accounts)]
    return "\n\n".join(told) + "\n"


def _lines(explanation: Explanation) -> Iterator[str]:
    whose = f" of {printable(explanation.controller)}" if explanation.controller else ""
    gap = "one scan" if explanation.scan else "any number of scans"
    when = "the first one" if explanation.first else f"{gap} after the one before"
    yield f"{printable(explanation.path)}: sample {explanation.index}{whose}, {when}"
    for finding in explanation.findings:
        cited = " ".join((*finding.clauses, *finding.readings))
        yield f"  {finding.severity} {finding.rule}: {printable(finding.message)}  [{cited}]"
    if explanation.way is None:
        yield "no legal way leads to it"
    elif explanation.first:
        yield "a recording may begin at any time"
    elif not explanation.way:
        yield "nothing need have happened"
    else:
        steps = len(explanation.way)
        yield f"the shortest legal way, {steps} step{'s' * (steps > 1)}"
        yield from _steps(explanation.way)


def _steps(way: tuple[PathStep, ...]) -> Iterator[str]:
    for number, step in enumerate(way, start=1):
        shown = ", ".join(f"{name} {printable(str(held))}" for name, held in step.state.items())
        yield f"  {number:>3}. {printable(step.action):<18} {shown}  [{' '.join(step.clauses)}]"
