"""``mmsverify record``: a trace from the wire, now, by a relay or by polling."""

from __future__ import annotations

import os
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from mmsverify.commands.options import Quiet, place
from mmsverify.commands.output import emit, remark, require_writable
from mmsverify.errors import InputError, UsageError
from mmsverify.formats.trace import USUAL_PORTS
from mmsverify.report import RECORD_FORMATS, render_recording, require_format

if TYPE_CHECKING:
    from mmsverify.recording import Address, Log
    from mmsverify.recording.running import Source

record = typer.Typer(help="Record a trace from the wire.", no_args_is_help=True)

Trace = Annotated[
    Path,
    typer.Option("-o", "--output", metavar="OUT.mcap", parser=place("-o"), help="The trace to write: new."),
]
Seconds = Annotated[
    float | None, typer.Option("--seconds", metavar="S", min=0.1, help="End by itself after S seconds.")
]
Name = Annotated[str, typer.Option("--name", metavar="NAME", help="Call the controller so in the trace.")]
Format = Annotated[str, typer.Option("--format", metavar="|".join(RECORD_FORMATS))]


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

    Exit status: 0; 2 if it could not begin, or the trace could not be written to its end.
    """
    role = next((known for known in USUAL_PORTS if known == protocol), None)
    if role is None:
        raise UsageError(f"no protocol {protocol!r} here", place="--protocol", cure="mms or modbus")
    from mmsverify.recording import Relay, address

    here, there = address(listen, "--listen"), address(to, "--to", USUAL_PORTS[role])
    if here == there:
        raise UsageError("is the controller itself", place="--listen", cure="name another port")
    host = _host(there, name, USUAL_PORTS[role])
    there = there.resolved()
    tell = partial(remark, quiet=quiet)

    def relay(log: Log) -> Source:
        return Relay(here, there, role, log, tell)

    return _recorded(relay, output, host, seconds, format)


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

    Exit status: 0; 2 if it could not begin, or the trace could not be written to its end.
    """
    from mmsverify.recording import Poller, address, read_map

    there, points = address(server, "HOST:PORT", USUAL_PORTS["modbus"]), read_map(map)
    host = _host(there, name or points.controller, USUAL_PORTS["modbus"])
    there = there.resolved()
    tell = partial(remark, quiet=quiet)

    def poller(log: Log) -> Source:
        return Poller(there, points, log, tell)

    return _recorded(poller, output, host, seconds, format)


def _host(server: Address, name: str, usual: int) -> str:
    """What the server is called in the trace."""
    if not server.port:
        raise UsageError("nobody listens on port 0", place=str(server), cure="name the controller's port")
    if "/" in name:
        raise UsageError(f"{name!r} cannot name a channel", place="--name", cure="leave out the /")
    host = server.host.replace("/", "")
    return name or (host if server.port == usual else f"{host}:{server.port}")


def _recorded(
    begun: Callable[[Log], Source], output: Path, host: str, seconds: float | None, format: str
) -> int:
    """Record into a new trace; what exists is never overwritten."""
    require_format(format, RECORD_FORMATS)
    require_writable(None)
    require_writable(output)
    if os.path.lexists(output):
        raise UsageError("exists already", place=str(output), cure="name another file, or remove it")
    from mmsverify.formats.mcap_write import TraceWriter
    from mmsverify.recording import Log, run

    log = Log(TraceWriter(output, indexed=False), host)
    try:
        recorded = run(begun(log), log, seconds)
    except UsageError:  # it never began
        output.unlink(missing_ok=True)
        raise
    emit(render_recording(str(output), recorded, format), None)
    if recorded.broken:
        cure = "all but its last second can be read"
        raise InputError(f"cannot be written: {recorded.broken}", place=str(output), cure=cure)
    return 0
