"""Profiles: what a standard leaves to the implementer, a table per model, from TOML or a trace's metadata.

The keys are data; validation and its messages are made from them.
"""

from __future__ import annotations

import difflib
import json
import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mmsverify.errors import ProfileError

Tables = Mapping[str, Mapping[str, Any]]


@dataclass(frozen=True, slots=True)
class Key:
    """One key of a profile table: its default, what it allows in words, and the test for that."""

    default: Any
    allows: str
    fits: Callable[[Any], bool]


def _choice(*words: str) -> Key:
    return Key(words[0], "one of " + ", ".join(f'"{w}"' for w in words), lambda v: v in words)


def _flag(default: bool) -> Key:
    return Key(default, "true or false", lambda v: isinstance(v, bool))


def _text(default: str) -> Key:
    return Key(default, "a string", lambda v: isinstance(v, str))


def _number(default: int, least: int) -> Key:
    return Key(default, f"an integer from {least}", lambda v: _is_int(v) and v >= least)


def _range(low: int, high: int) -> Key:
    return Key(
        [low, high], "two integers [first, last]", lambda v: _is_numbers(v) and len(v) == 2 and v[0] <= v[1]
    )


def _is_int(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def _is_list(value: Any) -> bool:
    return isinstance(value, list)


def _is_numbers(value: Any) -> bool:
    return isinstance(value, list) and all(map(_is_int, value))


def _is_names(value: Any) -> bool:
    return isinstance(value, list) and all(isinstance(v, str) and v for v in value)


ENTRY: Mapping[str, Key] = {
    "name": Key("", "a name", lambda v: isinstance(v, str) and v != ""),
    "control": _choice("NORMAL", "CONTROLLING", "CONTROLLED"),
    "domains": Key([], "a list of names", _is_names),
    "deletable": _flag(True),
    "reusable": _flag(True),
    "controlled": Key([], "a list of names", _is_names),
}

PREDEFINED = [
    {"name": "R_ARM", "control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False},
    {"name": "R_CAL", "control": "NORMAL", "domains": ["R_CAL"], "deletable": False},
]

KEYS: Mapping[str, Mapping[str, Key]] = {
    "mms-robot": {
        "associations": _choice("single", "multiple"),
        "step_limited": _flag(True),
        "predefined": Key(PREDEFINED, f"a list of tables {{{', '.join(ENTRY)}}}", _is_list),
        "selected_at_power_on": _text(""),
        "arms": Key(["R_ARM"], "a list of names", _is_names),
        "single_task": _flag(False),
    },
    "vr-template": {
        "homed_at_power_on": _flag(False),
        "sub_action_status": _choice("either", "11-14", "13-16"),
    },
    "modbus-signals": {
        "max_clients": _number(4, 1),
        "address_offset": Key(0, "an integer", _is_int),
        "outputs": _range(1, 960),
        "inputs": _range(1001, 1960),
        "internals": _range(2001, 2960),
        "dedicated": Key([], "a list of signal numbers", _is_numbers),
        "registers": _range(0, 1023),
    },
}  # fmt: skip


def load_profile(path: Path | None) -> dict[str, dict[str, Any]]:
    """The profile in the TOML file, completed with the defaults of every model; without a file, the defaults.

    Raises :class:`ProfileError` for a file that cannot be read, an unknown table or key, a value that is not
    allowed.
    """
    return complete({} if path is None else _read(path), str(path or ""))


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
    if "predefined" in keys:
        table["predefined"] = [_entry(entry, where) for entry in table["predefined"]]
        _check_names(table, where)
    return table


def _entry(entry: Any, where: str) -> dict[str, Any]:
    if not isinstance(entry, Mapping) or "name" not in entry:
        raise ProfileError(
            "an entry of predefined is not a table with a name",
            place=where,
            cure='write {name = "...", control = "..."}',
        )
    return _checked(entry, ENTRY, f"{where} predefined {entry['name']}")


def _checked(given: Mapping[str, Any], keys: Mapping[str, Key], where: str) -> dict[str, Any]:
    for name, value in given.items():
        if name not in keys:
            raise ProfileError(f"unknown key {name}", place=where, cure=_meant(name, keys))
        if not keys[name].fits(value):
            raise ProfileError(
                f"{name} = {value!r} is not allowed", place=where, cure=f"give {keys[name].allows}"
            )
    return {name: given.get(name, key.default) for name, key in keys.items()}


def _check_names(table: Mapping[str, Any], where: str) -> None:
    names = [entry["name"] for entry in table["predefined"]]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise ProfileError(f"{twice[0]} is predefined twice", place=where, cure="give each name once")
    controlling = [entry["name"] for entry in table["predefined"] if entry["control"] == "CONTROLLING"]
    if table["selected_at_power_on"] not in ("", *controlling):
        raise ProfileError(
            f"selected_at_power_on names {table['selected_at_power_on']!r}, which is not a predefined "
            "CONTROLLING program invocation",
            place=where,
            cure=_meant(table["selected_at_power_on"], controlling or ['""']),
        )


def _meant(name: str, known: Any) -> str:
    close = difflib.get_close_matches(name, list(known), n=1)
    return f"did you mean {close[0]}?" if close else f"known are {', '.join(known)}"


def _parsed(text: str, key: Key | None) -> Any:
    if key is not None and isinstance(key.default, str):
        return text
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        pass
    try:
        return json.loads(text)
    except ValueError:
        return text


def _read(path: Path) -> dict[str, Any]:
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise ProfileError(
            f"cannot be read: {error.strerror}", place=str(path), cure="give a readable TOML file"
        ) from None
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ProfileError(f"not valid TOML: {error}", place=str(path), cure="mend the syntax") from None
