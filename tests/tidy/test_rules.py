"""Every rule of the audit is applied by its code and tried by a test."""

from __future__ import annotations

import pytest
from sources import ROOT, python_files

from mmsverify.audit.rules import RULES


def text(folder: str, *, without: str = "") -> str:
    files = [ROOT / path for path in python_files(folder) if not without or without not in path.name]
    return "".join(path.read_text(encoding="utf-8") for path in files)


@pytest.mark.parametrize("folder", ["mmsverify", "tests"])
def test_every_rule_is_named_where_it_is_applied_and_where_it_is_tried(folder: str) -> None:
    written = text(folder, without="rules")
    assert [name for name in RULES if f'"{name}"' not in written] == []
