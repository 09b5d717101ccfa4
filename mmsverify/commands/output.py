"""Where results go: stdout or a file, and what may be said beside them on stderr."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from mmsverify.errors import InputError, UsageError
from mmsverify.report.wording import printable


def require_writable(output: Path | None, inputs: Iterable[Path] = ()) -> None:
    """Refuse, before the work is done, a place that cannot be written or that is one of the inputs."""
    if output is None:
        _require_stdout()
        return
    if os.path.isdir(output):
        raise UsageError("is a folder", place=str(output), cure="name a file to write to")
    if not os.path.isdir(output.parent):
        raise UsageError("its folder does not exist", place=str(output), cure=f"make {output.parent} first")
    if os.path.exists(output) and any(os.path.exists(entry) and output.samefile(entry) for entry in inputs):
        raise UsageError("is an input and would be overwritten", place=str(output), cure="name another file")


def _require_stdout() -> None:
    if sys.stdout is None:  # started with a closed stdout (``>&-``)
        raise InputError("is closed", place="stdout", cure="name a file with -o")


def emit(text: str, output: Path | None) -> None:
    """Write a result to ``output``, or to stdout where none is named."""
    if output is None:
        _print(text)
        return
    try:
        # A file name out of the recording's file system need not be valid text: escape it rather than fail.
        output.write_text(text, encoding="utf-8", errors="backslashreplace")
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", place=str(output)) from error


@contextmanager
def replacing(output: Path) -> Iterator[Path]:
    """A path to write a file to; at the end it becomes ``output``, after a failure nothing is left of it."""
    if os.path.exists(output) and not output.is_file():  # a device or a pipe cannot be replaced
        yield output
        return
    part = output.with_name(f"{output.name}.part")
    try:
        yield part
        os.replace(part, output)
    except BaseException:
        part.unlink(missing_ok=True)
        raise


def _print(text: str) -> None:
    """Print and flush; a reader that stops reading (``| head``) changes nothing about the exit status."""
    stream = sys.stdout
    try:
        stream.buffer.write(text.encode(stream.encoding, errors="backslashreplace"))
        stream.flush()
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", place="stdout") from error


def remark(text: str, *, quiet: bool) -> None:
    """One line on stderr for whoever watches."""
    if not quiet and sys.stderr is not None:  # print would take stdout for a stderr that is closed
        with suppress(OSError):  # nobody listens any more
            print(printable(text), file=sys.stderr)


@contextmanager
def progress(*, quiet: bool) -> Iterator[Callable[[str], None] | None]:
    """A line on stderr that says what is being done; ``None`` where nobody watches."""
    if quiet or sys.stderr is None or not sys.stderr.isatty():
        yield None
        return
    from rich.console import Console
    from rich.text import Text

    with Console(stderr=True).status("") as status:
        yield lambda text: status.update(Text(printable(text)))
