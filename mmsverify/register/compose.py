"""The register of a model: its statements, joined with what encodes and what exercises each of them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path

from mmsverify.model import Clause, Model, assemble, load_variants
from mmsverify.model.load import find, names
from mmsverify.register.citations import of_model
from mmsverify.register.exercised import read_exercised
from mmsverify.register.sources import COMPANIONS, of_tables
from mmsverify.register.statements import read_statements
from mmsverify.resources import models_dir
from mmsverify.results import Encoding, Entry, Mended, Register, Statement

Found = dict[str, dict[tuple[str, str], list[str]]]
"""By id of a statement: what encodes it, by kind and name, and in which variants."""


def clause_registers(models: Sequence[str] = ()) -> list[Register]:
    """The registers of models by name or path; of all that are shipped where none is named."""
    folder = models_dir()
    beside = {other for others in COMPANIONS.values() for other in others}
    wanted = models or [name for name in names(folder) if name not in beside]
    return [register(model, folder) for model in wanted]


def register(name_or_path: str, folder: Path) -> Register:
    """The register of one model, over all its variants."""
    path = find(name_or_path, folder)
    variants = load_variants(name_or_path, folder)
    any_variant = next(iter(variants.values()))
    name = str(any_variant.options.get("name", any_variant.__name__))
    statements = read_statements(path)
    found = _encodings(name, variants, known=bool(statements))
    for other in COMPANIONS.get(name, ()) if statements else ():
        for variant, source in load_variants(other, folder).items():
            for kind, own, clause in of_model(source):
                _note(found, clause, kind, f"{other} {own}", variant)
    exercised = read_exercised(path)
    every = {**statements, **{i: _unwritten(i) for i in sorted(found.keys() - statements.keys())}}
    entries = tuple(Entry(s, _listed(found.get(i, {})), exercised.get(i, ())) for i, s in every.items())
    return Register(
        name,
        str(any_variant.options.get("standard", "")),
        tuple(variants),
        entries,
        tuple(_repairs(variants)),
        tuple(i for i in every if i not in statements) if statements else (),
        _counts(entries),
    )


def _counts(entries: Sequence[Entry]) -> dict[str, int]:
    """How many statements there are, and how they are covered."""
    return {
        "statements": len(entries),
        "checkable": sum(entry.statement.checkable for entry in entries),
        "encoded": sum(bool(entry.encoded) for entry in entries),
        "reasoned": sum(bool(entry.statement.reason) and not entry.encoded for entry in entries),
        "uncovered": sum(entry.uncovered for entry in entries),
        "exercised": sum(bool(entry.exercised) for entry in entries),
    }


def _encodings(name: str, variants: Mapping[str, type[Model]], *, known: bool) -> Found:
    """What encodes each statement. The tables of a shipped model count for the one that has its register."""
    found: Found = {}
    for variant, source in variants.items():
        for kind, own, clause in of_model(source):
            _note(found, clause, kind, own, variant)
    if known:
        for kind, own, clause in of_tables(name):
            _note(found, clause, kind, own)
    return found


def _note(found: Found, clause: Clause, kind: str, name: str, *variants: str) -> None:
    for statement in clause.ids:
        holders = found.setdefault(statement, {}).setdefault((kind, name), [])
        holders += [variant for variant in variants if variant not in holders]


def _listed(holders: Mapping[tuple[str, str], Sequence[str]]) -> tuple[Encoding, ...]:
    return tuple(Encoding(kind, name, tuple(variants)) for (kind, name), variants in holders.items())


def _unwritten(statement: str) -> Statement:
    """An id that is cited, where no table says what it means."""
    return Statement(statement, "", "", (), "", "", "", checkable=False)


def _repairs(variants: Mapping[str, type[Model]]) -> Iterable[Mended]:
    """Every row that differs from the text, once, with what it mends and why."""
    told: dict[tuple[str, str], Mended] = {}
    for variant, source in variants.items():
        for row, repair in assemble(source).repairs.items():
            mended = Mended(row, variant, repair.mends.readings, repair.mends.ids, repair.because)
            told.setdefault((row, repair.because), mended)
    return told.values()
