"""``mmsverify import``: captures of network traffic and tables of VR samples to a trace."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Literal

import typer

from mmsverify.commands.options import Quiet, place
from mmsverify.commands.output import emit, remark, replacing, require_writable
from mmsverify.errors import UsageError
from mmsverify.formats.paths import CAPTURES, input_paths
from mmsverify.report import IMPORT_FORMATS, render_import, require_format

if TYPE_CHECKING:
    from mmsverify.formats.csv_samples import Tables

Captures = Annotated[list[str], typer.Argument(metavar="CAPTURE", help="Files, folders of them, patterns.")]
Trace = Annotated[
    Path, typer.Option("-o", "--output", metavar="OUT.mcap", parser=place("-o"), help="The trace to write.")
]
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
Map = Annotated[
    list[str] | None,
    typer.Option(
        "--map", metavar="COLUMN=CELL,...", help="CSV: the VR cell of a column, by header or number."
    ),
]
Time = Annotated[
    str, typer.Option("--time", metavar="COLUMN", help="CSV: the column of the time, by header or number.")
]
Unit = Annotated[
    str,
    typer.Option(
        "--unit", metavar="ns|us|ms|s", help="CSV: the unit of the time; else the header's, else s."
    ),
]
Controller = Annotated[
    str, typer.Option("--controller", metavar="NAME", help="CSV: whose VR cells; else the file's name.")
]
Sampling = Annotated[
    str, typer.Option("--sampling", metavar="scan|polled", help="CSV: scan: no scan lies between two rows.")
]


def import_(
    captures: Captures,
    *,
    output: Trace,
    mms_port: MmsPort = None,
    modbus_port: ModbusPort = None,
    name: Name = None,
    map: Map = None,
    time: Time = "",
    unit: Unit = "",
    controller: Controller = "",
    sampling: Sampling = "polled",
    format: Annotated[str, typer.Option("--format", metavar="|".join(IMPORT_FORMATS))] = "text",
    quiet: Quiet = False,
) -> int:
    """Turn captures (pcap, pcapng) and tables of VR samples (CSV) into a trace.

    What cannot be read of a capture becomes a gap on its connection; a line of a table that cannot be read
    ends it. Columns that are named after a VR cell are found.

    Exit status: 0 if anything could be read, else 2.
    """
    require_format(format, IMPORT_FORMATS)
    paths = input_paths(captures, CAPTURES)
    require_writable(None)
    require_writable(output, paths)
    hosts = _hosts(name or [])
    tables = _tables(map or [], time, unit, controller, sampling)
    from mmsverify.formats.capture import Ports, import_captures
    from mmsverify.formats.mcap_write import TraceWriter

    usual = Ports()
    ports = Ports(usual.mms.union(mms_port or ()), usual.modbus.union(modbus_port or ()))
    with replacing(output) as part, TraceWriter(part) as writer:
        result = import_captures(paths, writer, ports=ports, hosts=hosts, tables=tables)
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


def _tables(pairs: Sequence[str], time: str, unit: str, controller: str, sampling: str) -> Tables:
    """What the command line says of tables."""
    from mmsverify.formats.csv_layout import Asked
    from mmsverify.formats.csv_samples import Tables
    from mmsverify.formats.csv_values import UNITS

    if unit and unit not in UNITS:
        raise UsageError(f"no unit {unit!r} here", place="--unit", cure=f"one of {', '.join(UNITS)}")
    if "/" in controller:
        raise UsageError(
            f"{controller!r} cannot name a channel", place="--controller", cure="leave out the /"
        )
    sampled: Mapping[str, Literal["scan", "polled"]] = {"scan": "scan", "polled": "polled"}
    if sampling not in sampled:
        cure = "scan: one row each scan; polled: scans may lie between"
        raise UsageError(f"no sampling {sampling!r} here", place="--sampling", cure=cure)
    cells = dict(_mapped(",".join(pairs)))
    return Tables(Asked(cells, time, unit), controller, sampled[sampling])


def _mapped(text: str) -> Iterator[tuple[str, str]]:
    """``VR0=C_RunMD,3=CS_RunSTA`` as column to cell; a column's name may hold commas and equals signs."""
    from mmsverify.formats.csv_layout import cell_names
    from mmsverify.formats.vr import cell

    column, taken = "", dict[str, str]()
    for piece in text.split(",") if text else ():
        column, equals, name = f"{column},{piece}".removeprefix(",").rpartition("=")
        if not equals:
            column = name
            continue
        found = cell(name)
        if not column or found is None:
            cure = f"write it like VR0=C_RunMD; the cells are {', '.join(cell_names())}, or VR0 to VR15"
            raise UsageError(f"{name!r} is no VR cell", place="--map", cure=cure)
        if found.name in taken:
            raise UsageError(f"two columns are {found.name}", place="--map", cure="leave out one")
        if column in taken.values():
            raise UsageError(f"column {column!r} is two cells", place="--map", cure="leave out one")
        taken[found.name] = column
        yield column, found.name
        column = ""
    if column:
        raise UsageError(
            f"cannot read {column!r}", place="--map", cure="write it like VR0=C_RunMD,VR1=CS_RunSTA"
        )
