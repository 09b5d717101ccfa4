"""The command line: which commands there are, and how a run ends. What each does stands in ``commands``.

Exit status: 0 everything holds; 1 a property is violated or a trace has an error; 2 the request is bad or
nothing could be read; 3 undecided. Bad input is one line on stderr, never a traceback; a traceback is a bug.
"""

from __future__ import annotations

import gc
import os
import sys
from collections.abc import Sequence
from typing import Annotated

import typer

import mmsverify
from mmsverify.commands.audit import audit
from mmsverify.commands.check import check
from mmsverify.commands.clauses import clauses
from mmsverify.commands.diagram import diagram
from mmsverify.commands.explain import explain
from mmsverify.commands.findings import findings
from mmsverify.commands.imports import import_
from mmsverify.commands.record import record
from mmsverify.commands.timeline import timeline
from mmsverify.errors import MmsverifyError
from mmsverify.fleet.tasks import SELDOM
from mmsverify.report.wording import printable

BAD_REQUEST = 2
INTERRUPTED = 130  # 128 + SIGINT, as shells count it

# Typer carries its own copy of click in some versions and imports it in others: its family of errors has no
# address that all of them share, but an ancestor that all of them name alike.
BadCommandLine: type[Exception] = next(
    kind for kind in typer.BadParameter.__mro__ if kind.__name__ == "ClickException"
)

app = typer.Typer(
    name="mmsverify",
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
    context_settings={"help_option_names": ["-h", "--help"]},
)
app.command("check")(check)
app.command("audit")(audit)
app.command("explain")(explain)
app.command("import")(import_)
app.add_typer(record, name="record")
app.command("diagram")(diagram)
app.command("timeline")(timeline)
app.command("clauses")(clauses)
app.command("findings")(findings)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"mmsverify {mmsverify.__version__}")
        raise typer.Exit


@app.callback()
def _entry(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Print the version and exit.")
    ] = False,
) -> None:
    """Model checker and log analyzer for industrial robot controllers.

    Exit status: 0 everything holds, 1 violated, 2 bad request, 3 undecided.
    """


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line and return its exit status."""
    try:
        return _run(list(sys.argv[1:] if arguments is None else arguments))
    except (KeyboardInterrupt, typer.Abort):
        return INTERRUPTED
    except MmsverifyError as error:
        return _refuse(str(error))
    except BrokenPipeError:
        _abandon_stdout()
        return 0
    except OSError as error:
        return _refuse(str(_told(error)))
    except BadCommandLine as error:
        return _refuse(_usage(error))


def _run(arguments: list[str]) -> int:
    gc.set_threshold(*SELDOM)
    status = typer.main.get_command(app).main(arguments, prog_name="mmsverify", standalone_mode=False)
    return status if isinstance(status, int) else 0


def _refuse(line: str) -> int:
    print(f"mmsverify: {printable(' '.join(line.split()))}", file=sys.stderr)
    return BAD_REQUEST


def _told(error: OSError) -> MmsverifyError:
    return MmsverifyError(error.strerror or str(error), place=os.fsdecode(error.filename or ""))


def _usage(error: Exception) -> str:
    message = str(getattr(error, "format_message", error.__str__)()).rstrip(".")
    context = getattr(error, "ctx", None)
    cure = (
        "" if message.endswith(")") else f" (see {context.command_path if context else 'mmsverify'} --help)"
    )
    return f"{message[:1].lower()}{message[1:]}{cure}"


def _abandon_stdout() -> None:
    """Nobody reads on: what is still buffered goes nowhere, and the interpreter's last flush cannot fail."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
