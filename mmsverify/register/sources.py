"""Where citations are found beside a model's own declarations. A new table of rules is listed here, once."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

from mmsverify.audit.conformance import BASE_CLASS
from mmsverify.audit.modbus import MODBUS_RULES
from mmsverify.audit.objects import OBJECTS
from mmsverify.audit.rules import RULES
from mmsverify.audit.variables import TYPES, VARIABLES
from mmsverify.audit.vr import VR_RULES
from mmsverify.formats.modbus import MBAP
from mmsverify.formats.vr import CELLS
from mmsverify.profiles import CHECKS, FRAMEWORK_TABLE, KEYS, ROBOT_TABLE, SIGNALS_TABLE
from mmsverify.register.citations import Cited, citations
from mmsverify.register.grammar import of_modules
from mmsverify.resources import asn1_dir

TABLES: Mapping[str, tuple[tuple[str, Any], ...]] = {
    "mms-robot": (
        ("rule", RULES),
        ("requirement of the base class", BASE_CLASS),
        ("standard object", OBJECTS),
        ("standard type", TYPES),
        ("standard variable", VARIABLES),
        ("profile key", KEYS[ROBOT_TABLE]),
        ("profile check", CHECKS),
    ),
    "vr-template": (("rule", VR_RULES), ("cell", CELLS), ("profile key", KEYS[FRAMEWORK_TABLE])),
    SIGNALS_TABLE: (("rule", MODBUS_RULES), ("field", MBAP), ("profile key", KEYS[SIGNALS_TABLE])),
}
"""By model: what kind of thing each entry of a table is, and the table."""

COMPANIONS: Mapping[str, tuple[str, ...]] = {"vr-template": ("vr-tasks",)}
"""Models that encode statements of another one's register, more closely."""

ASN1 = frozenset({"mms-robot"})
"""Models of which the messages have ASN.1 modules."""


def of_tables(model: str) -> Iterator[Cited]:
    """What the tables and modules that belong to a model cite."""
    for kind, table in TABLES.get(model, ()):
        yield from ((kind, name, clause) for name, clause in citations(table, kind))
    if model in ASN1:
        yield from of_modules(asn1_dir())
