"""Citations of the ASN.1 modules: the types and fields whose comments tell what they encode."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from mmsverify.formats.cited import citations
from mmsverify.model import Clause
from mmsverify.register.citations import Cited

RULE = "decode rule"


def of_modules(folder: Path) -> Iterator[Cited]:
    """What the modules in ``folder`` cite, file by file."""
    for path in sorted(folder.glob("*.asn")):
        for place, ids in citations(path.read_text(encoding="utf-8"), path.name):
            yield RULE, place, Clause.of(*ids)
