"""An audit as one HTML page that needs nothing but itself: no script, no font, no picture from elsewhere.

Every text that comes from a recording is escaped, and a content security policy forbids what might
slip by.
"""

from __future__ import annotations

from collections.abc import Iterable
from html import escape

import mmsverify
from mmsverify.report.audit_text import summary
from mmsverify.report.order import by_input
from mmsverify.report.wording import cells, counted, instant, printable
from mmsverify.results import Audit, AuditedInput, Finding

STYLE = """
:root { color-scheme: light dark; --line: #8884; --error: #c62828; --warning: #b26a00; --note: #1565c0; }
body { font: 15px/1.5 system-ui, sans-serif; max-width: 72rem; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.15rem; margin-top: 2rem; overflow-wrap: anywhere; }
table { border-collapse: collapse; } td, th { padding: .15rem .8rem .15rem 0;
         text-align: left; vertical-align: top; }
table.inputs { width: 100%; } table.inputs td, table.inputs th { border-bottom: 1px solid var(--line); }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
article { border: 1px solid var(--line); border-left: .4rem solid; border-radius: .3rem;
          margin: .8rem 0; padding: .6rem 1rem; }
article.error { border-left-color: var(--error); } article.warning { border-left-color: var(--warning); }
article.note { border-left-color: var(--note); }
article p { margin: .3rem 0; } .message { font-weight: 600; overflow-wrap: anywhere; }
.place { margin-left: .6rem; }
.place, code, dd { font-family: ui-monospace, monospace; font-size: .9em; overflow-wrap: anywhere; }
.badge { color: #fff; border-radius: .25rem; padding: 0 .45rem; font: bold .8em system-ui, sans-serif; }
.error .badge { background: var(--error); } .warning .badge { background: var(--warning); }
.note .badge { background: var(--note); }
dl { display: grid; grid-template-columns: max-content 1fr; gap: .1rem 1rem; margin: .4rem 0; }
dt { opacity: .7; } dd { margin: 0; } footer { margin-top: 3rem; opacity: .7; }
"""


def render(audit: Audit) -> str:
    body = "".join(_section(path, findings) for path, _, findings in by_input(audit))
    page = f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; style-src 'unsafe-inline'">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>mmsverify audit</title>
<style>{STYLE}</style>
</head>
<body>
<h1>Audit</h1>
<p>{_text(summary(audit))}</p>
{_inputs(audit)}
{body}<footer>mmsverify {_text(mmsverify.__version__)}</footer>
</body>
</html>
"""
    return page.encode("ascii", "xmlcharrefreplace").decode("ascii")


def _text(value: str) -> str:
    return escape(printable(value))


def _inputs(audit: Audit) -> str:
    head = "<tr><th>Input</th>" + "".join(
        f'<th class="number">{name}</th>' for name in ("Messages", "Events", "Skipped", "Findings")
    )
    rows = "".join(_input(path, entry, len(findings)) for path, entry, findings in by_input(audit))
    return f'<table class="inputs">{head}</tr>\n{rows}</table>\n'


def _input(path: str, entry: AuditedInput | None, findings: int) -> str:
    cut = " (cut off: read up to the last whole message)" if entry and entry.truncated else ""
    numbers = (entry.messages, entry.events, entry.skipped) if entry else ("-", "-", "-")
    cells_ = "".join(f'<td class="number">{number}</td>' for number in (*numbers, findings))
    return f"<tr><td>{_text(path)}{cut}</td>{cells_}</tr>\n"


def _section(path: str, findings: list[Finding]) -> str:
    if not findings:
        return ""
    articles = "".join(map(_article, findings))
    return f"<section>\n<h2>{_text(path)}: {counted(len(findings), 'finding')}</h2>\n{articles}</section>\n"


def _article(finding: Finding) -> str:
    times = f" &times; {finding.count}" if finding.count > 1 else ""
    return (
        f'<article class="{finding.severity}">\n'
        f'<p><span class="badge">{finding.severity}</span> <code>{_text(finding.rule)}</code>{times} '
        f'<span class="place">{_place(finding)}</span></p>\n'
        f'<p class="message">{_text(finding.message)}</p>\n'
        f"{_facts(_pairs(finding))}{_before(finding)}</article>\n"
    )


def _place(finding: Finding) -> str:
    index = "whole file" if finding.index is None else f"#{finding.index}"
    time = "" if finding.time is None else instant(finding.time)
    return " &middot; ".join(_text(part) for part in (index, time, finding.topic or "") if part)


def _pairs(finding: Finding) -> list[tuple[str, str]]:
    return [
        ("clauses", " ".join(finding.clauses)),
        ("readings", " ".join(finding.readings)),
        ("expected", " or ".join(finding.expected)),
        ("observed", finding.observed),
        ("related", " ".join(f"#{index}" for index in finding.related)),
    ]


def _before(finding: Finding) -> str:
    if not finding.before:
        return ""
    return f"<details><summary>state before</summary>{_facts(cells(finding.before).items())}</details>\n"


def _facts(pairs: Iterable[tuple[str, str]]) -> str:
    told = "".join(f"<dt>{_text(name)}</dt><dd>{_text(value)}</dd>\n" for name, value in pairs if value)
    return f"<dl>\n{told}</dl>\n" if told else ""
