"""Imports go one way: vocabulary, language, engines, audit, reports, composition roots, commands.

Each heavy library has one home.
"""

from __future__ import annotations

import ast
import sys
from pathlib import Path

import pytest
from sources import (
    PACKAGE,
    ROOT,
    imported_parts,
    imports,
    module_name,
    modules,
    parsed,
    part,
    python_files,
    top_level,
)

VOCABULARY = {"errors", "events", "results", "resources", "incident"}

# What each part may import of the package, from the first to the last. Formats know no model and engines no
# format; only the audit brings the two together.
ALLOWED = {
    "errors": set[str](),
    "events": {"errors"},
    "results": {"errors", "events"},
    "incident": {"errors", "events", "results"},
    "resources": {"errors"},
    "profiles": {"errors", "resources", "results"},
    "model": VOCABULARY,
    "formats": {"errors", "events", "resources"},
    "recording": {"errors", "formats"},
    "samples": {"errors", "events", "formats"},
    "symbolic": VOCABULARY | {"model"},
    "concrete": VOCABULARY | {"model"},
    "graph": VOCABULARY | {"model", "concrete"},
    "audit": VOCABULARY | {"model", "concrete", "formats"},
    "report": VOCABULARY | {"model"},
    "fleet": VOCABULARY | {"formats"},
}
# The composition roots tie the engines together: they may import all of the above, and the command line them.
ROOTS = {
    "auditing": ALLOWED.keys() - {"symbolic", "graph", "report"},
    "explaining": ALLOWED.keys() - {"symbolic", "graph", "report", "fleet"} | {"register"},
    "incidents": ALLOWED.keys() - {"symbolic", "graph", "report", "fleet"} | {"register", "explaining"},
    "annotating": ALLOWED.keys() - {"symbolic", "graph", "fleet"} | {"incidents"},
    "timelines": ALLOWED.keys() - {"symbolic", "graph"} | {"auditing", "incidents"},
    "checking": ALLOWED.keys() - {"graph", "report"},
    "faults": ALLOWED.keys() - {"audit", "graph", "report"} | {"checking"},
    "diagrams": ALLOWED.keys() - {"audit", "report"},
    "register": ALLOWED.keys() - {"symbolic", "graph", "report"},
    "manual": ALLOWED.keys() - {"symbolic", "graph"} | {"diagrams", "register"},
    "notebook": ALLOWED.keys() - {"symbolic", "graph"}
    | {"auditing", "checking", "diagrams", "explaining", "incidents"},
}
COMMAND_LINE = {"cli", "commands", "__main__"}

HOMES = {
    "z3": {"symbolic"},
    "networkx": {"graph"},
    "typer": {"cli", "commands"},
    "rich": {"commands"},
    "asn1tools": {"formats"},
    "altair": {"report"},
    "pyarrow": {"report"},
    "dask": {"fleet"},
    "distributed": {"fleet"},
    "dpkt": {"formats"},
    "mcap": {"formats"},
    "lz4": {"formats"},
    "zstandard": {"formats"},
    "fsspec": {"formats"},
    "aiohttp": {"formats"},
    "numba": {"audit"},
}
THIRD_PARTY = {"errors": set[str](), "events": set[str](), "results": set[str](), "model": set[str](),
               "concrete": {"numpy", "numba"}, "symbolic": {"z3"}}  # fmt: skip

NETWORK = {
    "socket", "socketserver", "http", "urllib.request", "asyncio", "ssl", "requests",
    "fsspec", "aiohttp", "s3fs", "gcsfs", "botocore",
}  # fmt: skip
REMOTE = Path(PACKAGE, "formats", "remote.py")


def own_part(path: Path) -> str:
    return part(module_name(path))


def test_each_part_imports_only_what_lies_before_it() -> None:
    may = {**ALLOWED, **ROOTS}
    offences = [
        f"{path} imports {imported}"
        for path in python_files(PACKAGE)
        if own_part(path) in may
        for imported in sorted(imported_parts(path) - may[own_part(path)])
    ]
    assert offences == []


def test_every_part_has_its_place_in_the_order() -> None:
    parts = {own_part(path) for path in python_files(PACKAGE)} - {""}
    assert sorted(parts - ALLOWED.keys() - ROOTS.keys() - COMMAND_LINE) == []


def test_a_belief_knows_nothing_of_recordings_and_proofs() -> None:
    engine = {"model", "errors", "results", "concrete"}
    offences = [
        f"{path} imports {imported}"
        for path in python_files("mmsverify/concrete/belief")
        for imported in sorted(imported_parts(path) - engine)
    ]
    assert offences == []


def test_nothing_but_the_command_line_imports_the_command_line() -> None:
    offences = [
        f"{path} imports {imported}"
        for path in python_files(PACKAGE)
        if own_part(path) not in COMMAND_LINE
        for imported in sorted(imported_parts(path) & COMMAND_LINE)
    ]
    assert offences == []


@pytest.mark.parametrize("library", HOMES)
def test_a_heavy_library_is_imported_at_home_only(library: str) -> None:
    users = [path for path in python_files(PACKAGE) if library in top_level(path)]
    assert [str(path) for path in users if own_part(path) not in HOMES[library]] == []


@pytest.mark.parametrize("folder", THIRD_PARTY)
def test_the_core_needs_the_standard_library_only(folder: str) -> None:
    known = {*sys.stdlib_module_names, PACKAGE, ""} | THIRD_PARTY[folder]
    offences = [
        f"{path} imports {name}"
        for path in python_files(PACKAGE)
        if own_part(path) == folder
        for name in sorted(top_level(path) - known)
    ]
    assert offences == []


def test_nothing_but_the_recorder_and_remote_recordings_open_a_network_connection() -> None:
    others = [path for path in python_files(PACKAGE) if own_part(path) != "recording" and path != REMOTE]
    users = {str(path): imports(path) & NETWORK for path in others}
    assert {path: names for path, names in users.items() if names} == {}


def test_remote_recordings_reach_the_network_by_fsspec_alone_and_only_when_there_is_one() -> None:
    assert imports(REMOTE) & NETWORK == {"fsspec", "aiohttp"}
    at_once = [
        ast.unparse(node) for node in parsed(REMOTE).body if isinstance(node, ast.Import | ast.ImportFrom)
    ]
    assert [line for line in at_once if line.split()[1].split(".")[0] in NETWORK] == []


def test_model_files_know_the_language_only() -> None:
    offences = [
        f"{path} imports {name}"
        for path in python_files("models")
        for name in sorted(imports(path) & modules())
        if name != PACKAGE and part(name) not in {"model", "errors", "events"}
    ]
    assert offences == []


def test_imports_are_absolute() -> None:
    relative = [
        f"{path}:{node.lineno}"
        for path in python_files(PACKAGE)
        for node in ast.walk(parsed(path))
        if isinstance(node, ast.ImportFrom) and node.level
    ]
    assert relative == []


def test_every_module_is_used() -> None:
    used = {name for path in python_files() for name in imports(path) if name != module_name(path)}
    notebooks = "".join(path.read_text(encoding="utf-8") for path in ROOT.glob("notebooks/*.ipynb"))
    used |= {module for module in modules() if f"from {module} import" in notebooks}
    packages = {module.rpartition(".")[0] for module in modules()}
    started = {module for module in modules() if module.endswith(".__main__")}
    assert sorted(modules() - used - packages - started) == []
