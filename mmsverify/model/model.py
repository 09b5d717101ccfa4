"""A model: a class body whose names are its declarations, assembled into plain data for the readers.

A class body sees the names that its base classes declare, so that a model can be split by clause over several
files and still read like one text. A name declared twice in one body, or in two parts that do not know of
each other, is refused; a variant may redeclare a name only with the repair that explains it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

from mmsverify.model import expr as ex
from mmsverify.model.claims import Assume, ClaimSource, Initially, Removed, Unspecified
from mmsverify.model.declare import Declared, Derived, Each, Variable
from mmsverify.model.expr import Cell, Expr
from mmsverify.model.occurrences import Occurrence, Occurs
from mmsverify.model.place import mistake
from mmsverify.model.procedure import RowSource
from mmsverify.model.rewrite import map_cells, primed, substitute
from mmsverify.model.rows import Claim, Conjunct, Gap, Repair, Row, Signature
from mmsverify.model.sorts import ElementSort


class _Body(dict[str, Any]):
    """The namespace of a class body: names declarations, refuses a second one, sees those of the bases."""

    def __init__(self, title: str, inherited: Mapping[str, Declared], words: Mapping[str, Any]) -> None:
        super().__init__()
        self.title = title
        self.inherited = inherited
        self.words = words

    def __missing__(self, name: str) -> Any:
        return self.inherited[name] if name in self.inherited else self.words[name]

    def __setitem__(self, name: str, value: Any) -> None:
        if isinstance(value, Declared):
            self._check(name, value)
            value.bind(name)
        super().__setitem__(name, value)

    def _check(self, name: str, value: Declared) -> None:
        earlier = self.get(name)
        if isinstance(earlier, Declared):
            raise mistake(
                f"the name {name} is declared twice in {self.title} (first at {earlier.place})",
                "give one of them another name",
                value.place,
            )
        repairs: Repair | None = getattr(value, "repairs", None)
        known = self.inherited.get(name)
        if known is not None and repairs is None:
            raise mistake(
                f"{name} replaces the declaration at {known.place} without a reason",
                "add repairs=repaired('RP-..', 'R-...', because='...')",
                value.place,
            )
        if known is None and isinstance(value, Removed):
            raise mistake(
                f"{name} is removed but never declared",
                "name a declaration of the model that this one extends",
                value.place,
            )


class _Assembler(type):
    """Collects the declarations of a class body and of its bases."""

    declared: Mapping[str, Declared]
    words: Mapping[str, Any]
    options: Mapping[str, Any]

    @classmethod
    def __prepare__(cls, title: str, bases: tuple[type, ...], /, **_options: Any) -> _Body:
        words = {
            name: value for base in reversed(bases) for name, value in getattr(base, "words", {}).items()
        }
        return _Body(title, _inherited(title, bases), words)

    def __new__(mcs, title: str, bases: tuple[type, ...], body: _Body, **options: Any) -> _Assembler:
        made = super().__new__(mcs, title, bases, dict(body))
        own = {name: value for name, value in body.items() if isinstance(value, Declared)}
        made.declared = {**body.inherited, **own}
        made.words = {**body.words, **{n: v for n, v in body.items() if not n.startswith("__")}}
        made.options = options
        return made

    def __init__(cls, title: str, bases: tuple[type, ...], body: _Body, **_options: Any) -> None:
        super().__init__(title, bases, dict(body))


def _inherited(title: str, bases: tuple[type, ...]) -> dict[str, Declared]:
    """The declarations of all bases; the first base that mends a name wins over one that only inherits it."""
    names: dict[str, Declared] = {}
    for base in bases:
        for name, value in getattr(base, "declared", {}).items():
            known = names.setdefault(name, value)
            if known is not value:
                names[name] = _winner(title, name, known, value, bases)
    return names


def _winner(title: str, name: str, left: Declared, right: Declared, bases: tuple[type, ...]) -> Declared:
    mended = [value for value in (left, right) if getattr(value, "repairs", None) is not None]
    if len(mended) != 1:
        parts = ", ".join(base.__name__ for base in bases)
        raise mistake(
            f"the name {name} is declared in two parts of {title} ({parts}): {left.place} and {right.place}",
            "give one of them another name",
            left.place,
        )
    return mended[0]


class Model(metaclass=_Assembler):
    """What models and parts of models extend.

    ``class Robot(Model, name="mms-robot", variant="as-written")`` is a model; a part needs no options.
    """

    declared: Mapping[str, Declared]
    options: Mapping[str, Any]


@dataclass(frozen=True)
class ModelData:
    """A model, assembled: what every reader takes."""

    name: str
    variant: str
    standard: str
    sorts: Mapping[str, ElementSort]
    signatures: Mapping[str, Signature]
    definitions: Mapping[str, tuple[tuple[ex.Ref, ...], Expr]]
    rows: tuple[Row, ...]
    initial: tuple[Conjunct, ...]
    assumptions: tuple[Conjunct, ...]
    claims: tuple[Claim, ...]
    gaps: tuple[Gap, ...]
    repairs: Mapping[str, Repair]
    options: Mapping[str, Any] = field(default_factory=dict)
    occurrences: tuple[Occurrence, ...] = ()

    @cached_property
    def always(self) -> tuple[Claim, ...]:
        """The invariants claimed."""
        return tuple(c for c in self.claims if c.kind == "always")

    @cached_property
    def actions(self) -> tuple[Row, ...]:
        """The rows that can change state; observations cannot."""
        return tuple(row for row in self.rows if row.on.phase != "shown")

    @cached_property
    def depends(self) -> Mapping[str, frozenset[str]]:
        """For each variable that a row writes, the variables that some row reads in order to write it."""
        read: dict[str, set[str]] = {}
        for row in self.actions:
            tested = ex.variables_of(row.guard_formula)
            for assign in row.assigns:
                exprs = (assign.value, assign.where, *assign.args)
                read.setdefault(assign.variable, set()).update(tested, *map(ex.variables_of, exprs))
        return {name: frozenset(names) for name, names in read.items()}

    def define(self, name: str, *args: Expr) -> Expr:
        """A definition at its arguments, expanded to the variables; a stored variable is its own cell."""
        if name in self.definitions:
            parameters, body = self.definitions[name]
            return substitute(body, {p.name: a for p, a in zip(parameters, args, strict=True)})
        signature = self.signatures[name]
        return Cell(name, args, signature.of)


def assemble(source: type[Model]) -> ModelData:
    """The plain data of a model class; definitions are expanded, every name is checked."""
    declared = {n: d for n, d in source.declared.items() if not isinstance(d, Removed)}
    signatures = {
        name: Signature(name, d.sorts, d.value_sort, d.rigid, d.doc)
        for name, d in declared.items()
        if isinstance(d, Variable)
    }
    definitions = _definitions(declared, signatures)
    rows = tuple(
        _expanded_row(row, definitions)
        for d in declared.values()
        if isinstance(d, RowSource)
        for row in d.rows()
    )
    _check_rows(rows, signatures, definitions)
    return ModelData(
        name=str(source.options.get("name", source.__name__)),
        variant=str(source.options.get("variant", "as-written")),
        standard=str(source.options.get("standard", "")),
        sorts={name: d.sort for name, d in declared.items() if isinstance(d, Each)},
        signatures=signatures,
        definitions=definitions,
        rows=rows,
        initial=tuple(_named(d, definitions) for d in declared.values() if isinstance(d, Initially)),
        assumptions=tuple(_named(d, definitions) for d in declared.values() if isinstance(d, Assume)),
        claims=tuple(_claims(declared, definitions)),
        gaps=tuple(d.gap() for d in declared.values() if isinstance(d, Unspecified)),
        repairs=dict(_repairs(source)),
        options=source.options,
        occurrences=tuple(
            _expanded_occurrence(d.occurrence(), definitions)
            for d in declared.values()
            if isinstance(d, Occurs)
        ),
    )


def _repairs(source: type[Model]) -> Iterator[tuple[str, Repair]]:
    for name, d in source.declared.items():
        repair: Repair | None = getattr(d, "repairs", None)
        if repair is not None:
            yield name, repair


Definitions = Mapping[str, tuple[tuple[ex.Ref, ...], Expr]]


def _definitions(declared: Mapping[str, Declared], signatures: Mapping[str, Signature]) -> Definitions:
    """Definitions expanded in order of use; one that leads back to itself is refused."""
    raw = {name: d for name, d in declared.items() if isinstance(d, Derived)}
    done: dict[str, tuple[tuple[ex.Ref, ...], Expr]] = {}

    def resolve(name: str, chain: tuple[str, ...]) -> None:
        if name in done or name in signatures:
            return
        if name in chain:
            raise mistake(
                f"the definition of {name} leads back to itself", "define it from variables", raw[name].place
            )
        for used in ex.variables_of(raw[name].definition):
            resolve(used, (*chain, name))
        done[name] = (raw[name].parameters, expand(raw[name].definition, done))

    for name in raw:
        resolve(name, ())
    return done


def expand(expr: Expr, definitions: Definitions) -> Expr:
    """The expression with every definition replaced by what it stands for."""

    def change(cell: Cell) -> Expr:
        if cell.variable not in definitions:
            return cell
        parameters, body = definitions[cell.variable]
        given = substitute(body, {p.name: a for p, a in zip(parameters, cell.args, strict=True)})
        return primed(given) if cell.next else given

    return map_cells(expr, change)


def _named(source: Initially | Assume, definitions: Definitions) -> Conjunct:
    """The condition, with the name of its declaration for a rule."""
    return replace(_expanded(source.conjunct, definitions), rule=source.name)


def _expanded(conjunct: Conjunct, definitions: Definitions) -> Conjunct:
    return Conjunct(
        expand(conjunct.condition, definitions), conjunct.clause, conjunct.rule, conjunct.says, conjunct.level
    )


def _expanded_occurrence(occurrence: Occurrence, definitions: Definitions) -> Occurrence:
    before, after = expand(occurrence.before, definitions), expand(occurrence.after, definitions)
    return replace(occurrence, before=before, after=after)


def _expanded_row(row: Row, definitions: Definitions) -> Row:
    assigns = tuple(
        replace(a, value=expand(a.value, definitions), where=expand(a.where, definitions))
        for a in row.assigns
    )
    guard = tuple(_expanded(c, definitions) for c in row.guard)
    return replace(row, guard=guard, assigns=assigns)


def _claims(declared: Mapping[str, Declared], definitions: Definitions) -> Iterator[Claim]:
    for d in declared.values():
        if isinstance(d, ClaimSource):
            claim = d.claim()
            yield Claim(
                claim.name,
                claim.kind,
                claim.clause,
                expand(claim.formula, definitions),
                claim.says,
                provided=expand(claim.provided, definitions),
                place=claim.place,
            )


def _check_rows(rows: tuple[Row, ...], signatures: Mapping[str, Signature], definitions: Definitions) -> None:
    ids: dict[str, Row] = {}
    for row in rows:
        other = ids.setdefault(row.id, row)
        if other is not row and not (row.step and other.step):
            raise mistake(
                f"two rows are called {row.id}", "give one of them another name or step label", row.place
            )
        for assign in row.assigns:
            _check_target(assign.variable, assign.place or row.place, signatures, definitions)


def _check_target(
    name: str, place: str, signatures: Mapping[str, Signature], definitions: Definitions
) -> None:
    if name in definitions:
        raise mistake(
            f"{name} is a definition and cannot be updated", "update the variables that it is made of", place
        )
    if name not in signatures:
        raise mistake(
            f"the variable {name} is updated but not declared in this model",
            "declare it: x = Variable(...)",
            place,
        )
    if signatures[name].rigid:
        raise mistake(f"{name} is rigid and cannot be updated", "drop rigid=True or the update", place)
