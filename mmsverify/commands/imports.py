"""``mmsverify import``: captures of network traffic to a trace that ``mmsverify audit`` reads."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import typer

from mmsverify.commands.options import Quiet
from mmsverify.commands.output import emit, remark, replacing, require_writable
from mmsverify.commands.paths import CAPTURES, input_paths
from mmsverify.errors import UsageError
from mmsverify.report import IMPORT_FORMATS, render_import, require_format

Captures = Annotated[list[str], typer.Argument(metavar="CAPTURE", help="Files, folders of them, patterns.")]
Trace = Annotated[Path, typer.Option("-o", "--output", metavar="OUT.mcap", help="The trace to write.")]
MmsPort = Annotated[
    list[int] | None,
    typer.Option("--mms-port", metavar="N", min=1, max=65535, help="A further port of MMS."),
]
ModbusPort = Annotated[
    list[int] | None,
    typer.Option("--modbus-port", metavar="N", min=1, max=65535, help="A further port of Modbus."),
]
Name = Annotated[
    list[str] | None,
    typer.Option("--name", metavar="ADDRESS=NAME", help="Call the controller at ADDRESS so."),
]


def import_(
    captures: Captures,
    *,
    output: Trace,
    mms_port: MmsPort = None,
    modbus_port: ModbusPort = None,
    name: Name = None,
    format: Annotated[str, typer.Option("--format", metavar="|".join(IMPORT_FORMATS))] = "text",
    quiet: Quiet = False,
) -> int:
    """Turn captures (pcap, pcapng) into a trace.

    What cannot be read becomes a gap on its connection. Exit status: 0 if anything could be read, else 2.
    """
    require_format(format, IMPORT_FORMATS)
    paths = input_paths(captures, CAPTURES)
    require_writable(None)
    require_writable(output, paths)
    hosts = _hosts(name or [])
    from mmsverify.formats.capture import Ports, import_captures
    from mmsverify.formats.mcap_write import TraceWriter

    usual = Ports()
    ports = Ports(usual.mms.union(mms_port or ()), usual.modbus.union(modbus_port or ()))
    with replacing(output) as part, TraceWriter(part) as writer:
        result = import_captures(paths, writer, ports=ports, hosts=hosts)
    remark(f"wrote {output}", quiet=quiet)
    emit(render_import(result, format), None)
    return 0


def _hosts(pairs: Sequence[str]) -> dict[str, str]:
    """``10.0.0.5=cell7`` as address to name."""
    hosts: dict[str, str] = {}
    for pair in pairs:
        address, _, name = pair.partition("=")
        if not address or not name or "/" in name:
            raise UsageError(
                f"cannot read {pair!r}", place="--name", cure="write it like 10.0.0.5=cell7, without /"
            )
        hosts[address] = name
    return hosts
