"""The faults of a text as JSON, schema ``mmsverify.findings/1``."""

from __future__ import annotations

import json
from dataclasses import asdict

from mmsverify.report.wording import plain
from mmsverify.results import Survey

SCHEMA = "mmsverify.findings/1"


def render(survey: Survey) -> str:
    return json.dumps({"schema": SCHEMA, **plain(asdict(survey))}, ensure_ascii=False, indent=1) + "\n"
