"""``mmsverify record``: a trace from the wire, now, by a relay or by polling."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mmsverify.commands.options import Quiet
from mmsverify.commands.output import emit, remark, require_writable
from mmsverify.errors import InputError, UsageError
from mmsverify.report import RECORD_FORMATS, render_recording, require_format

if TYPE_CHECKING:
    from mmsverify.formats.trace import Role
    from mmsverify.recording import Address, Log
    from mmsverify.recording.running import Source

record = typer.Typer(help="Record a trace from the wire.", no_args_is_help=True)

Trace = Annotated[Path, typer.Option("-o", "--output", metavar="OUT.mcap", help="The trace to write: new.")]
Seconds = Annotated[
    float | None, typer.Option("--seconds", metavar="S", min=0.1, help="End by itself after S seconds.")
]
Name = Annotated[str, typer.Option("--name", metavar="NAME", help="Call the controller so in the trace.")]
Format = Annotated[str, typer.Option("--format", metavar="|".join(RECORD_FORMATS))]
_PORTS = {"mms": 102, "modbus": 502}


@record.command("proxy")
def proxy(
    *,
    listen: Annotated[str, typer.Option("--listen", metavar="HOST:PORT", help="Where clients connect to.")],
    to: Annotated[str, typer.Option("--to", metavar="HOST:PORT", help="The controller.")],
    protocol: Annotated[str, typer.Option("--protocol", metavar="mms|modbus", help="What they speak.")],
    output: Trace,
    name: Name = "",
    seconds: Seconds = None,
    format: Format = "text",
    quiet: Quiet = False,
) -> int:
    """Relay between clients and a controller, and record what passes.

    The octets pass unchanged, also those that cannot be read. The trace is readable at any moment, and
    complete after Ctrl-C.

    Exit status: 0; 2 if nothing could be recorded, or the trace could not be written to its end.
    """
    if protocol not in _PORTS:
        raise UsageError(f"no protocol {protocol!r} here", place="--protocol", cure="mms or modbus")
    from mmsverify.recording import Relay, address

    here, there = address(listen, "--listen"), address(to, "--to", _PORTS[protocol])
    if here == there:
        raise UsageError("is the controller itself", place="--listen", cure="name another port")
    role: Role = "mms" if protocol == "mms" else "modbus"
    tell = partial(remark, quiet=quiet)

    def relay(log: Log) -> Source:
        return Relay(here, there, role, log, tell)

    return _recorded(relay, output, _named(there, name), seconds, format)


@record.command("modbus")
def modbus(
    server: Annotated[str, typer.Argument(metavar="HOST:PORT", help="The controller.")],
    *,
    map: Annotated[Path, typer.Option("--map", metavar="FILE", help="What to poll (TOML).")],
    output: Trace,
    name: Name = "",
    seconds: Seconds = None,
    format: Format = "text",
    quiet: Quiet = False,
) -> int:
    """Poll a controller by Modbus: VR cells become samples, signals are recorded as they are read.

    The map says where each cell stands, and which addresses of signals to read.

    Exit status: 0; 2 if nothing could be recorded, or the trace could not be written to its end.
    """
    from mmsverify.recording import Poller, address, read_map

    there, points = address(server, "HOST:PORT", _PORTS["modbus"]), read_map(map)
    tell = partial(remark, quiet=quiet)

    def poller(log: Log) -> Source:
        return Poller(there, points, log, tell)

    return _recorded(poller, output, _named(there, name or points.controller), seconds, format)


def _named(server: Address, name: str) -> dict[str, str]:
    if "/" in name:
        raise UsageError(f"{name!r} cannot name a channel", place="--name", cure="leave out the /")
    return {f"{server.host}:{server.port}": name} if name else {}


def _recorded(
    begun: Callable[[Log], Source], output: Path, hosts: dict[str, str], seconds: float | None, format: str
) -> int:
    """Record into a new trace; a recording that exists is never overwritten."""
    require_format(format, RECORD_FORMATS)
    require_writable(None)
    require_writable(output)
    if output.exists() and output.is_file():
        raise UsageError("exists already", place=str(output), cure="name another file, or remove it")
    from mmsverify.formats.mcap_write import TraceWriter
    from mmsverify.recording import Log, run

    log = Log(TraceWriter(output), hosts)
    try:
        recorded = run(begun(log), log, seconds)
    except UsageError:  # it never began
        output.unlink(missing_ok=True)
        raise
    emit(render_recording(str(output), recorded, format), None)
    if recorded.broken:
        cure = "what was written before can be read"
        raise InputError(f"cannot be written: {recorded.broken}", place=str(output), cure=cure)
    return 0
