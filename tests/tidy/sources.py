"""The project's own files and what they import, read without running them, for the tests of tidiness."""

from __future__ import annotations

import ast
import subprocess
from collections.abc import Iterator
from functools import cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PACKAGE = "mmsverify"

Function = ast.FunctionDef | ast.AsyncFunctionDef


@cache
def tracked() -> tuple[Path, ...]:
    """Every file under version control that is there, relative to the root; all files without git."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, capture_output=True, text=True, check=False)
    if listed.returncode == 0:
        found = [Path(name) for name in listed.stdout.split("\0") if name]
    else:
        found = [path.relative_to(ROOT) for path in ROOT.rglob("*") if "/." not in path.as_posix()]
    return tuple(sorted(path for path in found if (ROOT / path).is_file()))


def python_files(folder: str = "") -> list[Path]:
    """The tracked Python files below ``folder``, relative to the root."""
    return [path for path in tracked() if path.suffix == ".py" and path.is_relative_to(folder)]


@cache
def parsed(path: Path) -> ast.Module:
    return ast.parse((ROOT / path).read_text(encoding="utf-8"), filename=str(path))


def functions(path: Path) -> Iterator[Function]:
    return (node for node in ast.walk(parsed(path)) if isinstance(node, Function))


def length(function: Function) -> int:
    """Lines from ``def`` to the last one."""
    return (function.end_lineno or function.lineno) - function.lineno + 1


def imports(path: Path) -> set[str]:
    """The dotted names that a file imports, at any depth; of ``from a import b`` both ``a`` and ``a.b``.

    The second may name a function; who asks for modules compares with ``modules()``.
    """
    names: set[str] = set()
    for node in ast.walk(parsed(path)):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            names |= {node.module or "", *(f"{node.module}.{alias.name}" for alias in node.names)}
    return names


def module_name(path: Path) -> str:
    parts = path.with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


@cache
def modules() -> frozenset[str]:
    return frozenset(map(module_name, python_files(PACKAGE)))


def part(module: str) -> str:
    """The folder or file right below the package that a module belongs to; empty for the package itself."""
    return module.split(".")[1] if "." in module else ""


def imported_parts(path: Path) -> set[str]:
    """The parts of the package that a file imports, its own left out."""
    inside = {part(name) for name in imports(path) & modules() if name.startswith(f"{PACKAGE}.")}
    return inside - {part(module_name(path))}


def top_level(path: Path) -> set[str]:
    """The first components of everything a file imports."""
    return {name.split(".")[0] for name in imports(path)}
