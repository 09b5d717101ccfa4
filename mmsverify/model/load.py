"""Model files, by name or by path: one of ours is loaded exactly as a user's own."""

from __future__ import annotations

import importlib.util
import sys
from collections.abc import Mapping
from functools import lru_cache
from pathlib import Path
from types import ModuleType
from typing import Any

from mmsverify.errors import ModelError, UsageError
from mmsverify.model.misread import told
from mmsverify.model.model import Model, ModelData, assemble


def load(name_or_path: str, folder: Path, variant: str | None = None) -> ModelData:
    """The model called ``name_or_path`` in ``folder``, or in the file or package at that path.

    Without ``variant``: ``repaired`` where the file has one, else its only variant. Who asks again gets the
    same model, which nobody may change. Raises
    :class:`ModelError` for a file that is not a model, :class:`UsageError` for a name or variant that does
    not exist.
    """
    variants = load_variants(name_or_path, folder)
    wanted = variant or ("repaired" if "repaired" in variants else next(iter(variants)))
    if wanted not in variants:
        raise UsageError(
            f"the model {name_or_path} has no variant {wanted}",
            cure=f"use one of {', '.join(sorted(variants))}",
        )
    return _assembled(variants[wanted])


@lru_cache(maxsize=16)
def _assembled(source: type[Model]) -> ModelData:
    """The model of a class, put together once for all recordings and checks of a process."""
    return assemble(source)


def made_for(model: ModelData, profile: Mapping[str, Any]) -> ModelData:
    """The model of what a profile describes, where that is more than facts: see its option ``made_for``."""
    make = model.options.get("made_for")
    made = make(profile) if make is not None else None
    return model if made is None else assemble(made)


def load_variants(name_or_path: str, folder: Path) -> dict[str, type[Model]]:
    """The model classes of a file by variant: those that state one, or else the last class of the file."""
    path = find(name_or_path, folder)
    module = _execute(path)
    classes = [
        c for c in vars(module).values() if isinstance(c, type) and issubclass(c, Model) and c is not Model
    ]
    if not classes:
        raise ModelError(
            "no model in this file",
            place=str(path),
            cure="write a class that extends mmsverify.model.Model",
        )
    stated = {str(c.options["variant"]): c for c in classes if "variant" in c.options}
    if stated:
        return stated
    own = [c for c in classes if c.__module__ == module.__name__] or classes
    return {"as-written": own[-1]}


def names(folder: Path) -> list[str]:
    """The names of the models shipped in ``folder``."""
    files = [p.stem for p in folder.glob("*.py")] + [p.parent.name for p in folder.glob("*/__init__.py")]
    return sorted(stem.replace("_", "-") for stem in files)


def find(name_or_path: str, folder: Path) -> Path:
    """The file of a model: by path if there is such a file or folder, else by name."""
    for path in (Path(name_or_path), Path(name_or_path) / "__init__.py"):
        if path.is_file():
            return path
    stem = name_or_path.replace("-", "_")
    for path in (folder / f"{stem}.py", folder / stem / "__init__.py"):
        if stem.isidentifier() and path.is_file():
            return path
    known = ", ".join(names(folder)) or "none"
    raise UsageError(
        f"no model named or filed as {name_or_path!r}",
        cure=f"give a path to a model file, or one of: {known}",
    )


def _execute(path: Path) -> ModuleType:
    """Run the model file as a module of its own; what goes wrong in it is told with its line."""
    package = path.name == "__init__.py"
    stem = path.parent.name if package else path.stem
    name = f"mmsverify_models.{stem}_{abs(hash(str(path.resolve())))}"
    if name in sys.modules:
        return sys.modules[name]
    spec = importlib.util.spec_from_file_location(
        name, path, submodule_search_locations=[str(path.parent)] if package else None
    )
    if spec is None or spec.loader is None:
        raise ModelError("not a Python file", place=str(path), cure="a model is a .py file or a package")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    try:
        spec.loader.exec_module(module)
    except ModelError:
        _forget(name)
        raise
    except Exception as error:
        _forget(name)
        raise told(error, path) from None
    return module


def _forget(name: str) -> None:
    for loaded in [n for n in sys.modules if n == name or n.startswith(name + ".")]:
        del sys.modules[loaded]
