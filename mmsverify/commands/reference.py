"""The page of the command line, made from the commands themselves."""

from __future__ import annotations

import re
from collections.abc import Iterator
from html import escape
from typing import Any

import typer

from mmsverify.cli import app

TYPE = re.compile(r" <\S+>$")
"""What Typer adds to the name of an argument."""

HEAD = """# Command line

`mmsverify COMMAND` or `python -m mmsverify COMMAND`. Results are on stdout; progress and remarks on stderr,
and a bar only on a terminal. Bad input is one line on stderr: where, what, and what mends it.

| exit status | means |
|---|---|
| 0 | everything holds |
| 1 | a property is violated, or a recording has an error-level violation |
| 2 | the request is bad, or nothing could be read |
| 3 | undecided: a limit was reached |

Where several apply: 2, 1, 3, 0."""


def page() -> str:
    """The page as Markdown: every command with its arguments and options."""
    root = typer.main.get_command(app)
    context = root.make_context("mmsverify", [], resilient_parsing=True)
    return "\n\n".join([HEAD, *_commands(root, context)]) + "\n"


def _commands(group: Any, context: Any) -> Iterator[str]:
    """Each command; of a group those that are in it."""
    for name in group.list_commands(context):
        command = group.get_command(context, name)
        inner = type(context)(command, info_name=name, parent=context)
        if hasattr(command, "list_commands"):
            yield from _commands(command, inner)
        else:
            yield from _command(command, inner)


def _command(command: Any, context: Any) -> Iterator[str]:
    yield f"## {context.command_path}"
    yield _paragraphs(command.help or "")
    yield f"```text\n{' '.join([context.command_path, *command.collect_usage_pieces(context)])}\n```"
    records = [_record(parameter, context) for parameter in command.get_params(context)]
    lines = [f"| {said} | {meaning} |" for said, meaning in filter(None, records)]
    yield "\n".join(["| argument or option | meaning |", "|---|---|", *lines])


def _paragraphs(help_text: str) -> str:
    return "\n\n".join(" ".join(part.split()) for part in help_text.split("\n\n"))


def _record(parameter: Any, context: Any) -> tuple[str, str] | None:
    """How a parameter is written, and what it says of itself; ``--help`` needs no line everywhere."""
    record = parameter.get_help_record(context)
    if record is None or "--help" in parameter.opts:
        return None
    return _cell(TYPE.sub("", record[0])), _words(record[1])


def _cell(text: str) -> str:
    return f"<code>{_words(text)}</code>"


def _words(text: str) -> str:
    return escape(" ".join(text.split()), quote=False).replace("|", "&#124;").replace("*", "&#42;")
