"""Findings and per-recording summaries as Parquet, for fleets. One row each, columns as in the JSON results.

The only module that needs pyarrow, which the extra ``parquet`` installs. pandas reads integers that may be
missing as ``Int64``; ``before`` is the JSON of the state. ``time`` is UTC to the nanosecond, and missing
where a clock stood beyond the year 2262, which its type cannot tell.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from mmsverify.report.audit_json import summary, violation
from mmsverify.report.order import ordered, tally
from mmsverify.results import Audit

TEXTS, WHOLE = pa.list_(pa.string()), pa.int64()
LATEST = 2**63 - 1


def _schema(fields: Mapping[str, pa.DataType]) -> pa.Schema:
    """The columns; pandas is told which integers may be missing, or it would make them floats."""
    columns = [
        {"name": name, "field_name": name, "pandas_type": "int64", "numpy_type": "Int64", "metadata": None}
        for name, kind in fields.items()
        if kind == WHOLE
    ]
    told = {"index_columns": [], "column_indexes": [], "columns": columns, "pandas_version": "2.2"}
    return pa.schema(list(fields.items()), {"pandas": json.dumps(told)})


FINDINGS = _schema({
    "path": pa.string(), "index": WHOLE, "time": pa.timestamp("ns", "UTC"), "topic": pa.string(),
    "vmd": pa.string(), "severity": pa.string(), "rule": pa.string(), "clauses": TEXTS, "readings": TEXTS,
    "message": pa.string(), "expected": TEXTS, "observed": pa.string(), "before": pa.string(),
    "related": pa.list_(WHOLE), "count": WHOLE,
})  # fmt: skip
INPUTS = _schema({
    "path": pa.string(), "read": pa.bool_(), "messages": WHOLE, "events": WHOLE, "skipped": WHOLE,
    "truncated": pa.bool_(), "seconds": pa.float64(), "errors": WHOLE, "warnings": WHOLE, "notes": WHOLE,
    "withheld": WHOLE,
})  # fmt: skip


def findings(audits: Sequence[Audit]) -> bytes:
    """A Parquet file with a row for each finding; without any it has its columns all the same."""
    return _file(
        [_finding(violation(each)) for audit in audits for each in ordered(audit.findings)], FINDINGS
    )


def inputs(audits: Sequence[Audit]) -> bytes:
    """A Parquet file with a row for each recording, of audits of one recording each.

    ``errors``, ``warnings`` and ``notes`` count all findings, ``withheld`` those of them that have no row.
    """
    return _file([_input(audit) for audit in audits], INPUTS)


def _file(rows: list[dict[str, Any]], schema: pa.Schema) -> bytes:
    table = pa.Table.from_pylist([_valid(row) for row in rows], schema=schema)
    pq.write_table(table, file := io.BytesIO())
    return file.getvalue()


def _finding(row: dict[str, Any]) -> dict[str, Any]:
    time = row["time"] if row["time"] is None or row["time"] <= LATEST else None
    return {"count": 1, **row, "time": time, "before": json.dumps(row["before"])}


def _input(audit: Audit) -> dict[str, Any]:
    counts = tally(audit.findings, audit.withheld)
    row = summary(audit.inputs[0]) if audit.inputs else {"path": audit.findings[0].path}
    numbers = {"errors": counts["error"], "warnings": counts["warning"], "notes": counts["note"]}
    numbers["withheld"] = sum(rest.count for rest in audit.withheld)
    return {**row, "read": bool(audit.inputs), **numbers}


def _valid(value: Any) -> Any:
    """With the letters of a name that are no text escaped: Parquet keeps UTF-8."""
    if isinstance(value, str):
        return value.encode("utf-8", "backslashreplace").decode("utf-8")
    if isinstance(value, list):
        return [_valid(each) for each in value]
    return {name: _valid(each) for name, each in value.items()} if isinstance(value, dict) else value
