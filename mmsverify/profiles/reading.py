"""Reading a profile: a table per model, from TOML or a trace's metadata, completed and checked.

The keys are data; what is told of a mistake is made from them.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable, Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

from mmsverify.errors import ProfileError
from mmsverify.profiles.framework import COMMANDS, FRAMEWORK_TABLE, completed
from mmsverify.profiles.judging import require_robot
from mmsverify.profiles.keys import Key
from mmsverify.profiles.registry import KEYS, ROBOT_TABLE
from mmsverify.profiles.robot import STANDARDIZED
from mmsverify.profiles.shipped import found
from mmsverify.profiles.text import shown, toml, toml_or_json


def load_profile(profile: str | Path | None) -> dict[str, dict[str, Any]]:
    """The profile in the TOML file, completed with the defaults of every model; without a file, the defaults.

    ``profile`` may be the name of one that is shipped. Raises :class:`ProfileError` for a file that cannot be
    read, an unknown table or key, a value that is not allowed, a table that no robot can have.
    """
    if profile is None:
        return complete({}, "")
    path = found(profile)
    return complete(_read(path), str(path))


def stated(profile: str | Path, model: str) -> frozenset[str]:
    """The keys that the profile itself gives for a model."""
    return frozenset(_read(found(profile)).get(model, {}))


def from_metadata(metadata: Mapping[str, str], place: str) -> dict[str, dict[str, Any]]:
    """The profile that a trace carries: a model's name and its keys as strings.

    Values stand there as in TOML or JSON, or as bare words. ``place`` is named in errors.
    """
    model = metadata.get("model", "")
    if not model:
        return {}
    keys = {
        name: _parsed(text, KEYS.get(model, {}).get(name))
        for name, text in metadata.items()
        if name != "model"
    }
    return {model: dict(complete({model: keys}, place)[model])}


def for_recording(
    profile: str | Path | None, metadata: Mapping[str, str], place: str
) -> dict[str, dict[str, Any]]:
    """The tables that one recording is judged by: the given profile, else what the recording says itself."""
    tables = load_profile(profile)
    return tables if profile is not None else {**tables, **from_metadata(metadata, place)}


def complete(tables: Mapping[str, Any], place: str) -> dict[str, dict[str, Any]]:
    """The tables checked, with defaults for what they leave out."""
    for table in tables:
        if table not in KEYS:
            raise ProfileError(f"unknown table [{table}]", place=place, cure=_meant(table, KEYS))
    return {model: _table(model, tables.get(model, {}), keys, place) for model, keys in KEYS.items()}


def _table(model: str, given: Any, keys: Mapping[str, Key], place: str) -> dict[str, Any]:
    if not isinstance(given, Mapping):
        raise ProfileError(f"{model} is not a table", place=place, cure=f"write [{model}]")
    where = f"{place} [{model}]".strip()
    table = _checked(given, keys, where)
    if model == ROBOT_TABLE:
        table["devices"] = table["devices"] or default_devices(table)
        require_robot(table, where)
    if model == FRAMEWORK_TABLE:
        table[COMMANDS] = completed(table[COMMANDS], where)
    return table


def default_devices(table: Mapping[str, Any]) -> list[dict[str, Any]]:
    """The devices of a robot that lists none: an arm for each domain of an arm program, and the interlocks."""
    domains = {d: e["name"] for e in table["predefined"] if e["name"] in table["arms"] for d in e["domains"]}
    arms = [{"name": d, "kind": "arm", "domain": d, "program": program} for d, program in domains.items()]
    safety = {"name": "safety interlocks", "kind": "safety", "domain": "R_SAFE", "calibration": False}
    entries = KEYS[ROBOT_TABLE]["devices"].entries
    return [_checked(device, entries, "") for device in [*arms, safety]]


def _checked(given: Mapping[str, Any], keys: Mapping[str, Key], where: str) -> dict[str, Any]:
    """The values of a table, nested ones too; what is left out has its default."""
    for name in given:
        if name not in keys:
            raise ProfileError(f"unknown key {name}", place=where, cure=_meant(name, keys))
    return {name: _value(name, given, key, where) for name, key in keys.items()}


def _value(name: str, given: Mapping[str, Any], key: Key, where: str) -> Any:
    value = given.get(name, deepcopy(key.default))
    if not key.fits(value):
        what = f"{name} = {shown(value)} is not allowed" if name in given else f"{name} is missing"
        raise ProfileError(what, place=where, cure=f"give {key.allows}{_near(value, key)}")
    if key.table:
        return _checked(value, key.entries, f"{where} {name}")
    if key.entries:
        return [_entry(each, key.entries, f"{where} {name}") for each in value]
    return value


def _entry(entry: Any, keys: Mapping[str, Key], where: str) -> dict[str, Any]:
    if not isinstance(entry, Mapping) or "name" not in entry:
        raise ProfileError(
            f"an entry of {where.rpartition(' ')[2]} is not a table with a name",
            place=where,
            cure=f'write {{name = "...", {", ".join(key for key in keys if key != "name")}}}',
        )
    fixed = STANDARDIZED.get(str(entry["name"]), {}) if "control" in keys else {}
    return _checked({**deepcopy(dict(fixed)), **entry}, keys, f"{where} {entry['name']}")


def _near(value: Any, key: Key) -> str:
    """The word that was meant, where one is given that is not known."""
    given = value if isinstance(value, list) else [value]
    odd = [v for v in given if isinstance(v, str) and v not in key.known]
    close = difflib.get_close_matches(odd[0], key.known, n=1) if odd else []
    return f"; did you mean {close[0]}?" if close else ""


def _meant(name: str, known: Iterable[str]) -> str:
    close = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}"


def _parsed(text: str, key: Key | None) -> Any:
    if key is not None and isinstance(key.default, str):
        return text
    try:
        return toml_or_json(text)
    except ValueError:
        return text


def _read(path: Path) -> dict[str, Any]:
    try:
        return toml(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ProfileError(
            f"cannot be read: {error.strerror}", place=str(path), cure="give a readable TOML file"
        ) from None
    except ValueError as error:  # what TOML, UTF-8 and the size of a profile refuse
        raise ProfileError(f"not valid TOML: {error}", place=str(path), cure="mend the syntax") from None
