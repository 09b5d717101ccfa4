"""Nothing is written as CSV: a cell that begins with = + - or @ would be a formula in a spreadsheet."""

from __future__ import annotations

import re

from sources import PACKAGE, ROOT, python_files

WRITES = re.compile(r"\bcsv\.(writer|DictWriter)\b|\.to_csv\(|\.to_excel\(")


def test_nothing_writes_tables_that_a_spreadsheet_would_compute() -> None:
    places = [*python_files(PACKAGE), *sorted(ROOT.glob("notebooks/*.ipynb"))]
    assert [str(path) for path in places if WRITES.search((ROOT / path).read_text(encoding="utf-8"))] == []
