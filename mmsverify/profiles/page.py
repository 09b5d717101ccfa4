"""The page about profiles (``docs/profiles.md``): every key and every check, written from the registries."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping

from mmsverify.profiles.checks import Level
from mmsverify.profiles.judging import CHECKS
from mmsverify.profiles.keys import Key
from mmsverify.profiles.registry import KEYS
from mmsverify.profiles.shipped import shipped

HEAD = """# Profiles

What a standard leaves to the implementer (of a robot: its PICS, clause 9.4) stands in a TOML file with a table for each
model. `mmsverify check --profile` and `mmsverify audit --profile` take a file, or the name of a profile that is shipped; a
recording may carry the same keys as strings. What a profile leaves out has its default.

`check --profile` proves or refutes every property for robots with that profile, of any number of program invocations beside
those that it predefines, and judges the profile itself. An error among its findings makes the exit status 1; a profile that
no robot can have is refused with exit status 2. A table of commands of one's own that goes beyond the template framework is no
such profile: the property that it breaks is refuted, with the shortest run that leads there and the name of the command.

This page is written by `python -m mmsverify.profiles`."""

LEVELS: Mapping[Level, str] = {
    "refused": "With a breach of these a profile describes no robot, and is refused.",
    "error": "A breach of these is an error: a statement of the standard forbids it.",
    "warning": "A breach of these is a warning: the standard recommends otherwise.",
    "note": "A breach of these is a note: it is worth knowing.",
}


def page() -> str:
    """The page as Markdown."""
    return "\n\n".join([HEAD, *_shipped(), *_tables(), *_checks()]) + "\n"


def _shipped() -> Iterator[str]:
    yield "## Shipped profiles"
    yield "\n".join(["| name | what it is |", "|---|---|", *(f"| `{n}` | {_about(n)} |" for n in shipped())])


def _about(name: str) -> str:
    """The comment at the top of a shipped profile."""
    head = shipped()[name].read_text(encoding="utf-8").partition("\n\n")[0]
    return " ".join(line.removeprefix("#").strip() for line in head.splitlines())


def _tables() -> Iterator[str]:
    for model, keys in KEYS.items():
        yield f"## `[{model}]`"
        yield _table(keys)
        for name, key in keys.items():
            if key.entries:
                yield f"### {'The table' if key.table else 'An entry of'} `{name}`"
                yield _table(key.entries)


def _table(keys: Mapping[str, Key]) -> str:
    rows = (
        f"| `{n}` | {k.says} | {k.allows} | {_default(k)} | {' '.join(k.clauses)} |" for n, k in keys.items()
    )
    return "\n".join(["| key | meaning | allows | default | statements |", "|---|---|---|---|---|", *rows])


def _default(key: Key) -> str:
    """The default as TOML has it, where it is short."""
    if key.default is None:
        return "none: it must be given"
    if key.table or (key.entries and key.default):
        return "see below" if key.table else ", ".join(entry["name"] for entry in key.default)
    return f"`{json.dumps(key.default)}`"


def _checks() -> Iterator[str]:
    yield "## Checks"
    for level, says in LEVELS.items():
        rows = [f"| `{c.rule}` | {c.says} | {' '.join(c.clauses)} |" for c in CHECKS if c.level == level]
        yield says
        yield "\n".join(["| rule | meaning | statements |", "|---|---|---|", *rows])
