"""The profiles that travel with mmsverify, and how one is named: by its name, or any file by its path."""

from __future__ import annotations

import difflib
import tomllib
from pathlib import Path

from mmsverify.errors import ProfileError
from mmsverify.resources import models_dir


def shipped(model: str = "") -> dict[str, Path]:
    """The shipped profiles by name: all, or those that have a table of the model."""
    files = sorted((models_dir() / "profiles").glob("*.toml"))
    return {path.stem: path for path in files if not model or model in tomllib.loads(path.read_text("utf-8"))}


def found(profile: str | Path) -> Path:
    """The file of a profile: the one at that path, else the shipped one of that name."""
    path = Path(profile)
    if path.exists() or path.suffix or len(path.parts) != 1:
        return path
    known = shipped()
    if path.name in known:
        return known[path.name]
    close = difflib.get_close_matches(path.name, known, n=1)
    hint = f"did you mean {close[0]}?" if close else f"shipped are {', '.join(known)}"
    raise ProfileError(
        "no file, and no shipped profile of that name",
        place=str(profile),
        cure=f"give a TOML file, or a name; {hint}",
    )
