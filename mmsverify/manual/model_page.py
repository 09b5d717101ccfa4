"""The page of one model: its diagram, its variables, every row and property, what differs from the text."""

from __future__ import annotations

import sys
from collections.abc import Iterable, Iterator, Sequence
from functools import partial

from mmsverify.manual.markdown import cited, code, formula, stacked, table, text
from mmsverify.manual.row_table import Link, row_table
from mmsverify.model import Clause, ModelData, load
from mmsverify.model.load import load_variants
from mmsverify.model.rows import Claim, Row
from mmsverify.model.show import shown
from mmsverify.model.sorts import EnumSort, Sort
from mmsverify.resources import models_dir

TEXT = "as-written"

PHASES = {
    "response": "The controller answers",
    "indication": "A request arrives",
    "internal": "Without a message",
    "shown": "What a message shows",
}
"""The rows of a page, in this order, by the phase of their events."""

ORDER = (
    "Of several rows under one name the first whose guard holds is taken: each lists, and cites, only what "
    "it asks beyond not being answered by those above it. Updates are made together and read the state "
    "before; of two that touch one cell the later one counts."
)


def page(name: str, register: str) -> str:
    """The page of a model by name; its clauses stand on the page of ``register``."""
    model = load(name, models_dir())
    link = partial(_cited, page=f"../clauses/{register}.md")
    rows, claims = _rows(model.rows, link), _claims(model.claims, link)
    return "\n\n".join([*_head(model), *_state(model), *rows, *claims, *_repairs(model, link)]) + "\n"


def as_written(name: str, register: str) -> str:
    """The page of what the repaired reading of a model mends: the rows and properties of the text itself."""
    mended = load(name, models_dir()).repairs
    model = load(name, models_dir(), TEXT)
    link = partial(_cited, page=f"../clauses/{register}.md")
    rows = _rows([row for row in model.rows if row.name in mended], link)
    claims = _claims([claim for claim in model.claims if claim.name in mended], link)
    return "\n\n".join([f"# {name} as written", _as_written(name), *rows, *claims]) + "\n"


def _as_written(name: str) -> str:
    return (
        f"What [the repaired reading]({name}.md#where-it-differs-from-the-text) mends, as the text has it. "
        f"Everything else is as in {name}. `mmsverify check {name} --variant {TEXT}` shows what it breaks."
    )


def _cited(clause: Clause, *, page: str) -> str:
    return cited((*clause.ids, *clause.readings), page, "../../readings.md")


def _head(model: ModelData) -> Iterator[str]:
    yield f"# The model {model.name}"
    yield _purpose(model.name)
    yield (
        f"This page is made from the model, variant `{model.variant}`: {len(model.rows)} rows, "
        f"{len(model.claims)} properties. `mmsverify check {model.name}` proves them."
    )
    drawn = f"../../{model.name}.svg"
    yield f"[![State diagrams of {model.name}]({drawn})]({drawn})"
    yield "The diagrams show which rows lead from one value to another."


def _purpose(name: str) -> str:
    """What the file of the model says of itself."""
    source = next(iter(load_variants(name, models_dir()).values()))
    return (sys.modules[source.__module__].__doc__ or "").replace("``", "`").strip()


def _state(model: ModelData) -> Iterator[str]:
    yield "## State"
    if model.sorts:
        yield f"There may be any number of: {', '.join(f'`{name}`' for name in model.sorts)}."
    variables = model.signatures.values()
    yield table(
        ("variable", "of", "holds", "meaning"),
        ((code(v.name), _sorts(v.sorts), _values(v.of), _meaning(v.doc, v.rigid)) for v in variables),
    )


def _sorts(sorts: Iterable[Sort]) -> str:
    return ", ".join(code(getattr(sort, "short", "") or sort.name) for sort in sorts)


def _values(sort: Sort) -> str:
    """The values of an enumeration, or what else a sort is."""
    return text(", ".join(map(str, sort.members)) if isinstance(sort, EnumSort) else sort.name)


def _meaning(doc: str, rigid: bool) -> str:
    return text("; ".join(part for part in (doc, "never changes" if rigid else "") if part))


def _rows(listed: Sequence[Row], link: Link) -> Iterator[str]:
    yield "## Rows"
    yield ORDER
    for phase, title in PHASES.items():
        rows = [row for row in listed if row.on.phase == phase]
        if rows:
            yield f"### {title}"
        for name in dict.fromkeys(row.name for row in rows):
            yield from _named([row for row in rows if row.name == name], link)


def _named(rows: Sequence[Row], link: Link) -> Iterator[str]:
    yield f"#### {rows[0].name.replace('_', ' ')}"
    yield row_table(rows, link)


def _claims(claims: Sequence[Claim], link: Link) -> Iterator[str]:
    if not claims:
        return
    yield "## Properties"
    yield "`always` holds in every reachable state, `step` of every step, `sometimes` of some state or step."
    yield table(
        ("property", "kind", "says", "clauses"),
        (
            (
                code(c.title),
                c.kind,
                stacked(filter(None, (text(c.says), formula(shown(c.formula))))),
                link(c.clause),
            )
            for c in claims
        ),
    )


def _repairs(model: ModelData, link: Link) -> Iterator[str]:
    if model.repairs:
        yield "## Where it differs from the text"
        yield "Everything else is as written. [Readings](../../readings.md) explains the readings."
        yield table(
            ("declaration", "because", "mends"),
            ((code(name), text(r.because), link(r.mends)) for name, r in model.repairs.items()),
        )
