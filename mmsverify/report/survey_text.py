"""The faults of a text as a document.

Each with its clauses, what it means for a plant, the shortest run, the repair.

Markdown, for it is kept beside the code and read on a code host.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from mmsverify.report.wording import cells, counted, printable, spoken
from mmsverify.results import Breach, Fault, Mending, Oddity, PathStep, Survey

KINDS = {
    "unreachable": "What the text says in vain",
    "contradiction": "Where two rules answer differently",
    "gap": "Where no rule answers",
    "choice": "Where two conforming robots may differ",
}
"""The kinds of oddities by the heading that they stand under."""


def render(survey: Survey) -> str:
    """The document, the same bytes for the same model."""
    return "\n".join(_document(survey)) + "\n"


def _document(survey: Survey) -> Iterator[str]:
    yield f"# Where {survey.standard or survey.model} breaks its own rules"
    yield ""
    yield (
        f"Made by `mmsverify findings {survey.model}` from the variant `{survey.variant}`: each of its "
        f"{survey.properties} properties of states and steps was held against each of {survey.procedures} "
        "procedures and internal events. A breach is the shortest run found; every run was replayed by the "
        "interpreter of the model before it was believed."
    )
    yield ""
    beside = f"Said in vain, twice, or not at all: {len(survey.oddities)}."
    yield f"Broken properties: {len(survey.faults)}. {beside}"
    yield ""
    yield "| property | clauses | broken by | mended by |"
    yield "|---|---|---|---|"
    yield from map(_line, survey.faults)
    for fault in survey.faults:
        yield from _fault(fault)
    for kind, heading in KINDS.items():
        yield from _oddities(heading, [oddity for oddity in survey.oddities if oddity.kind == kind])


def _line(fault: Fault) -> str:
    procedures = ", ".join(dict.fromkeys(breach.procedure for breach in fault.breaches))
    readings = ", ".join(sorted({r for m in fault.mendings for r in m.reading.split(", ") if r}))
    return f"| [{fault.name}](#{fault.name}) | {' '.join(fault.clauses)} | {procedures} | {readings or '-'} |"


def _fault(fault: Fault) -> Iterator[str]:
    yield from ("", f"## {fault.name}", "")
    if fault.statement:
        yield f"*{printable(fault.statement)}* ({', '.join(fault.clauses)})"
        yield ""
    if fault.consequence:
        yield f"**For a plant:** {fault.consequence}"
        yield ""
    shortest, *others = fault.breaches
    yield f"The shortest run, {_title(shortest)}:"
    yield ""
    yield from _steps(shortest.steps)
    if others:
        yield from ("", "Also broken by:", "")
        yield from (f"- {_title(breach)}: {_told(breach.steps)}" for breach in others)
    if fault.open:
        yield ""
        yield f"Not seen within the worlds searched, and not excluded by proof: {', '.join(fault.open)}."
    yield ""
    yield f"In the repaired reading: {fault.mended}."
    yield from (
        f"- `{mending.declaration}` ({_rests_on(mending)}): {mending.because}" for mending in fault.mendings
    )


def _rests_on(mending: Mending) -> str:
    return "; ".join(part for part in (mending.reading, ", ".join(mending.clauses)) if part)


def _title(breach: Breach) -> str:
    change = f", {breach.change}" if breach.change else ""
    steps = counted(len(breach.steps) - 1, "step")
    world = f"predefined: {printable(breach.world)}" if breach.world else "nothing predefined"
    return f"by `{breach.procedure}`{change} ({steps}; {world})"


def _steps(steps: Sequence[PathStep]) -> Iterator[str]:
    before: Mapping[str, str] = cells(steps[0].state)
    for number, step in enumerate(steps[1:], start=1):
        after = cells(step.state)
        moved = [
            f"{cell}: {before.get(cell)} -> {held}"
            for cell, held in after.items()
            if before.get(cell) != held
        ]
        yield f"{number}. {_action(step)} [{' '.join(step.clauses)}]"
        yield f"   - {'; '.join(moved) or 'nothing changes'}"
        before = after


def _told(steps: Sequence[PathStep]) -> str:
    return "; ".join(_action(step) for step in steps[1:])


def _action(step: PathStep) -> str:
    given = [f"{name}={spoken(value)}" for name, value in step.arguments.items() if _worth_telling(value)]
    return f"`{step.action}`" + (f" ({', '.join(given)})" if given else "")


def _worth_telling(value: object) -> bool:
    return value not in (False, None, [], 0)


def _oddities(heading: str, oddities: Sequence[Oddity]) -> Iterator[str]:
    if oddities:
        yield from ("", f"## {heading}", "")
        yield from (f"- `{odd.name}` ({' '.join(odd.clauses)}): {printable(odd.what)}" for odd in oddities)
