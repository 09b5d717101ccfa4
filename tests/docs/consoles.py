"""What the consoles on the pages show, and what the commands print today.

A block ``console`` is a run of commands, each after ``$``, with what they print; ``...`` is lines left
out. A block with a ``title`` is a file that the commands find beside them, or what is ``added to`` one; the
samples are in ``traces``. A block after a comment ``<!-- not run: why -->`` is not run.
``python tests/docs/consoles.py`` writes what has changed into the pages.
"""

from __future__ import annotations

import contextlib
import io
import os
import re
import shlex
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from mmsverify.cli import main

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
FENCE = re.compile(
    r"^(?P<aside><!-- not run: .+ -->\n)?```(?P<kind>\w+)(?: title=\"(?P<title>[^\"]+)\")?\n"
    r"(?P<text>.*?)^```$",
    re.MULTILINE | re.DOTALL,
)
SECONDS = re.compile(r"\(\d+\.\d s\)|(?<=  )\d+\.\d\d$|(?<=\"seconds\": )[\d.]+")
"""How long something took: what differs from run to run."""
LEFT_OUT = "..."
ADDED = "added to "


@dataclass(frozen=True)
class Command:
    """A command of a page, what the page says that it prints, and what it printed now."""

    line: str
    told: Sequence[str]
    printed: Sequence[str]

    @property
    def holds(self) -> bool:
        """Whether the page tells what was printed."""
        return matches([alike(line) for line in self.told], [alike(line) for line in self.printed])

    @property
    def shown(self) -> str:
        """The command with its lines: those of the page where they hold, else those of now."""
        lines = self.told if self.holds else self.printed
        return "".join(f"{line}\n" for line in (f"$ {self.line}", *lines))


def with_consoles() -> list[Path]:
    """The pages on which commands are run."""
    return [page for page in sorted(DOCS.rglob("*.md")) if any(map(is_run, fences(page)))]


def fences(page: Path) -> list[re.Match[str]]:
    """The blocks of a page, in order."""
    return list(FENCE.finditer(page.read_text(encoding="utf-8")))


def is_run(fence: re.Match[str]) -> bool:
    """Whether the commands of a block are run."""
    return fence["kind"] == "console" and not fence["aside"]


def replayed(page: Path, folder: Path) -> Iterator[tuple[re.Match[str], list[Command]]]:
    """The consoles of a page with their commands, run in an empty folder that has the samples."""
    (folder / "traces").symlink_to(ROOT / "traces")
    for fence in fences(page):
        if fence["title"]:
            write(folder, fence["title"], fence["text"])
        elif is_run(fence):
            yield fence, [Command(line, told, run(line, folder)) for line, told in commands(fence["text"])]


def write(folder: Path, title: str, text: str) -> None:
    """Write a file, or add to it; what was loaded from it before is loaded anew."""
    path = folder / title.removeprefix(ADDED)
    before = path.read_text(encoding="utf-8") if title.startswith(ADDED) else ""
    path.write_text(before + text, encoding="utf-8")
    for name in [
        name for name, module in sys.modules.items() if getattr(module, "__file__", "") == str(path)
    ]:
        del sys.modules[name]


def commands(text: str) -> Iterator[tuple[str, list[str]]]:
    """The commands of a block, each with the lines below it."""
    for part in re.split(r"^\$ ", text, flags=re.MULTILINE)[1:]:
        line, *told = part.splitlines()
        yield line, told


def run(line: str, folder: Path) -> list[str]:
    """What a command prints on stdout and stderr; a plain ``mmsverify`` needs no process of its own."""
    plain = line.startswith("mmsverify ") and not set(line) & set("|><;&$*")
    printed = called(shlex.split(line)[1:], folder) if plain else in_shell(line, folder)
    return [text.replace(f"{folder}/", "").rstrip() for text in printed.splitlines()]


def called(arguments: Sequence[str], folder: Path) -> str:
    """What the command line prints."""
    printed = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", write_through=True)
    with contextlib.chdir(folder), contextlib.redirect_stdout(printed), contextlib.redirect_stderr(printed):
        main(arguments)
    printed.seek(0)
    return printed.read()


def in_shell(line: str, folder: Path) -> str:
    """What a shell prints that has the commands ``mmsverify`` and ``python``."""
    tools = (
        f'mmsverify() {{ "{sys.executable}" -m mmsverify "$@"; }}; python() {{ "{sys.executable}" "$@"; }}\n'
    )
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "LC_ALL": "C.UTF-8"}
    done = subprocess.run(
        ["bash", "-c", tools + line], cwd=folder, env=environment, text=True, check=False, timeout=300,
        stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
    )  # fmt: skip
    return done.stdout


def alike(line: str) -> str:
    """A line without what differs from run to run."""
    return SECONDS.sub("#", line.rstrip())


def matches(told: Sequence[str], printed: Sequence[str]) -> bool:
    """Whether ``told`` is ``printed``, or that with lines left out where ``...`` stands."""
    if LEFT_OUT not in told:
        return list(told) == list(printed)
    cut = told.index(LEFT_OUT)
    head, rest = list(told[:cut]), told[cut + 1 :]
    if list(printed[:cut]) != head:
        return False
    return any(matches(rest, printed[start:]) for start in range(cut, len(printed) + 1))


def renew(page: Path) -> bool:
    """Write what the commands print now into a page; whether anything has changed."""
    text = page.read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        for fence, ran in replayed(page, Path(folder)):
            now = fence[0].replace(fence["text"], "".join(command.shown for command in ran))
            text = text.replace(fence[0], now)
    changed = text != page.read_text(encoding="utf-8")
    page.write_text(text, encoding="utf-8")
    return changed


if __name__ == "__main__":
    for asked in [Path(name).resolve() for name in sys.argv[1:]] or with_consoles():
        print(f"{asked.relative_to(DOCS)}: {'written anew' if renew(asked) else 'as it was'}")
