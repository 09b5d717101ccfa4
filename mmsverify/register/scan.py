"""Which tests exercise a statement: read from the tests' source, without running them.

A test exercises what it names: an id of the register, or the name of what encodes one (a row, a rule, a
property), in its own text or in that of the constants, fixtures and helpers that it uses. A marker tells what
no text can, because it is computed: ``@pytest.mark.exercises("R-7.4.4.*", every="property")``, and with
``of="mms-robot"`` of that model only.

A test that only prints results made by hand exercises nothing: it counts where its file, or a helper of it,
uses a part of mmsverify that judges.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping, Set
from dataclasses import dataclass, field
from fnmatch import fnmatchcase
from functools import cached_property
from pathlib import Path

from mmsverify.register.citations import KINDS
from mmsverify.results import Exercise, Register

TELLING = {"cli", "commands", "errors", "events", "model", "register", "report", "resources", "results"}
"""Parts of mmsverify that judge nothing."""

UNSPOKEN = {KINDS["Relation"], KINDS["Derived"], "variable", "profile key"}
"""Kinds whose names are common words, which a test may use without meaning what they encode."""

MARK = "exercises"


@dataclass(frozen=True, slots=True)
class Vocabulary:
    """What a test can name: ids, and what encodes them by name and by kind."""

    model: str
    ids: Set[str]
    by_name: Mapping[str, Set[str]]
    by_kind: Mapping[str, Set[str]]

    @staticmethod
    def of(register: Register) -> Vocabulary:
        """The words of one model's register."""
        by_name: dict[str, set[str]] = {}
        by_kind: dict[str, set[str]] = {}
        for entry in register.entries:
            for encoding in entry.encoded:
                by_kind.setdefault(encoding.kind, set()).add(entry.statement.id)
                if encoding.kind not in UNSPOKEN and not encoding.name.isalpha():
                    by_name.setdefault(encoding.name, set()).add(entry.statement.id)
        return Vocabulary(
            register.model, {entry.statement.id for entry in register.entries}, by_name, by_kind
        )

    def named(self, text: str) -> Set[str]:
        """The statements that a text names."""
        return {text} if text in self.ids else self.by_name.get(text, set())

    def marked(self, mark: ast.Call) -> Set[str]:
        """The statements that a marker names: by id or pattern, or every one that a kind of thing encodes."""
        patterns = [node.value for node in mark.args if isinstance(node, ast.Constant)]
        words = {k.arg: str(k.value.value) for k in mark.keywords if isinstance(k.value, ast.Constant)}
        if words.get("of", self.model) != self.model:
            return set()
        every = (words["every"],) if "every" in words else ()
        found = {i for i in self.ids for pattern in patterns if fnmatchcase(i, str(pattern))}
        return found.union(*(ids for kind, ids in self.by_kind.items() if kind.startswith(every)))


@dataclass(slots=True)
class _Part:
    """A definition at the top of a test file: what it names, which other definitions it uses."""

    named: set[str] = field(default_factory=set)
    marked: set[str] = field(default_factory=set)
    uses: set[str] = field(default_factory=set)


class _File:
    """One file of the tests, by its top-level definitions."""

    def __init__(self, path: Path, words: Vocabulary) -> None:
        self.path, self.words = path, words
        self.parts: dict[str, _Part] = {}
        self.imported: dict[str, tuple[str, str]] = {}
        self.libraries: set[str] = set()
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            self._take(node)

    def _take(self, node: ast.stmt) -> None:
        if isinstance(node, ast.ImportFrom | ast.Import):
            self._import(node)
        for name in _defined(node):
            part = self.parts.setdefault(name, _Part())
            for inner in ast.walk(node):
                self._read(inner, part)

    def _import(self, node: ast.ImportFrom | ast.Import) -> None:
        module = node.module if isinstance(node, ast.ImportFrom) else None
        for alias in node.names:
            self.libraries.add(f"{module}.{alias.name}" if module else alias.name)
            self.imported[alias.asname or alias.name] = (module or alias.name, alias.name if module else "")

    def _read(self, node: ast.AST, part: _Part) -> None:
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            part.named |= self.words.named(node.value)
        elif isinstance(node, ast.Name):
            part.uses.add(node.id)
        elif isinstance(node, ast.arg):
            part.uses.add(node.arg)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name):
            part.uses.add(f"{node.value.id}.{node.attr}")
        elif isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == MARK:
            part.marked |= self.words.marked(node)

    @cached_property
    def judges(self) -> bool:
        """Whether the file uses a part of mmsverify that judges."""
        parts = {name.split(".")[1] for name in self.libraries if name.startswith("mmsverify.")}
        return bool(parts - TELLING)


def _defined(node: ast.stmt) -> list[str]:
    """The names that a statement at the top of a file defines."""
    if isinstance(node, ast.FunctionDef | ast.ClassDef):
        return [node.name]
    targets = [node.target] if isinstance(node, ast.AnnAssign) else getattr(node, "targets", [])
    return [name.id for target in targets for name in ast.walk(target) if isinstance(name, ast.Name)]


class _Tests:
    """All files of the tests, which import each other by their bare names."""

    def __init__(self, root: Path, words: Vocabulary) -> None:
        self.root = root
        self.files = {path.stem: _File(path, words) for path in sorted(root.glob("tests/**/*.py"))}

    def exercises(self) -> Iterator[tuple[str, Exercise]]:
        for file in self.files.values():
            for name, part in file.parts.items():
                if file.path.stem.startswith("test_") and name.startswith("test_"):
                    where = f"{file.path.relative_to(self.root).as_posix()}::{name}"
                    found = self._reached(file.path.stem, name, set()) | self._marked(file, part)
                    yield from ((i, Exercise("test", where)) for i in sorted(found))

    def _marked(self, file: _File, part: _Part) -> set[str]:
        """What the marker of a test names, and that of its file."""
        return part.marked | (file.parts["pytestmark"].marked if "pytestmark" in file.parts else set())

    def _reached(self, module: str, name: str, seen: set[tuple[str, str]]) -> set[str]:
        """What a definition names, itself or by what it uses, where somewhere on the way something judges."""
        if (module, name) in seen or module not in self.files or name not in self.files[module].parts:
            return set()
        seen.add((module, name))
        file, part = self.files[module], self.files[module].parts[name]
        found = set(part.named) if self._judges(module, set()) else set()
        for used in part.uses:
            found |= self._reached(module, used, seen)
            base, _, attribute = used.partition(".")
            source, original = file.imported.get(base, ("", ""))
            found |= self._reached(source, original or attribute, seen)
        return found

    def _judges(self, module: str, seen: set[str]) -> bool:
        if module in seen or module not in self.files:
            return False
        seen.add(module)
        file = self.files[module]
        return file.judges or any(self._judges(source, seen) for source, _ in file.imported.values())


def scanned(root: Path, register: Register) -> Iterable[tuple[str, Exercise]]:
    """What the tests of the checkout at ``root`` exercise of a register, statement by statement."""
    return _Tests(root, Vocabulary.of(register)).exercises()
