"""The page: what was read, what happened first, the devices over time, the findings, what judged them."""

from __future__ import annotations

from base64 import b64encode
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from hashlib import sha256
from importlib.resources import files

import mmsverify
from mmsverify.incident import Dossier, Incident
from mmsverify.report.audit_text import summary, withheld
from mmsverify.report.html.finding import line, whole
from mmsverify.report.html.numbered import Group, Numbered, grouped, numbered
from mmsverify.report.html.states import path
from mmsverify.report.html.text import clock, element, folded, pairs, text
from mmsverify.report.html.timeline import timeline
from mmsverify.report.order import SEVERITIES, by_input
from mmsverify.report.wording import counted
from mmsverify.results import Audit, AuditedInput

KEY = (
    '<p class="key">What was known after each message. Solid: known; dashed: one of these; empty: not '
    "known; a triangle: a finding, with its number; a band: messages are missing. "
    "After a finding, what contradicts is no longer taken for known.</p>\n"
)
MOST_LINES = 20_000
"""Findings that are told in a line each; of more, their number is told."""


def page(audit: Audit, dossier: Dossier) -> str:
    """The whole document."""
    findings = numbered(audit)
    style, script = _asset("page.css"), _asset("page.js")
    policy = f"default-src 'none'; style-src '{_hash(style)}'; script-src '{_hash(script)}'; img-src data:"
    policy += "; base-uri 'none'; form-action 'none'"
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<link rel="icon" href="data:,">
<title>{_title(audit)}</title>
<style>{style}</style>
</head>
<body>
<header><h1>Audit</h1><p class="verdict">{text(summary(audit))}</p></header>
<main>
{_inputs(audit)}
{_first(findings)}
{_devices(findings, dossier)}
{_findings(findings, dossier)}
</main>
{_footer(dossier)}
<script>{script}</script>
</body>
</html>
"""


@cache
def _asset(name: str) -> str:
    return (files("mmsverify.report.html") / name).read_text(encoding="ascii")


def _title(audit: Audit) -> str:
    names = [entry.path for entry in audit.inputs]
    return text(f"Audit of {names[0]}" if len(names) == 1 else f"Audit of {counted(len(names), 'recording')}")


def _hash(asset: str) -> str:
    return f"sha256-{b64encode(sha256(asset.encode()).digest()).decode()}"


# What was read.


def _inputs(audit: Audit) -> str:
    names = ("messages", "audited", "skipped", "undecoded", "findings")
    head = "<tr><th>Recording</th>" + "".join(f'<th class="number">{name}</th>' for name in names) + "</tr>"
    told = [(name, entry, found) for name, entry, found in by_input(audit)]
    rows = "".join(
        _input(
            name,
            entry,
            len(found) + sum(rest.count for rest in audit.withheld if rest.path == name),
            sum(f.count for f in found if f.rule.endswith("undecodable")),
        )
        for name, entry, found in told
    )
    table = f'<table class="inputs">{head}\n{rows}</table>'
    return f'<section id="inputs"><h2>What was read</h2>{table}{_withheld(audit)}</section>'


def _withheld(audit: Audit) -> str:
    """What is counted and not told."""
    lines = [f"{name}: {line}" for name, _, _ in by_input(audit) for line in withheld(audit, name)]
    return "".join(f"<p>{text(line)}</p>\n" for line in lines)


def _input(name: str, entry: AuditedInput | None, findings: int, undecoded: int) -> str:
    cut = " (cut off: read up to the last whole message)" if entry and entry.truncated else ""
    numbers = (entry.messages, entry.events, entry.skipped, undecoded) if entry else ("-",) * 4
    told = "".join(f'<td class="number">{number}</td>' for number in (*numbers, findings))
    return f"<tr><td>{text(name)}{cut}</td>{told}</tr>\n"


# What happened first.


def _first(findings: Sequence[Numbered]) -> str:
    """The first error of each device: where to begin to read."""
    first: dict[tuple[str, str], Numbered] = {}
    for each in findings:
        if each.finding.severity == "error":
            first.setdefault((each.finding.path, each.finding.vmd or ""), each)
    if not first:
        return ""
    items = "".join(
        f"<li><b>{text(device or each.finding.path)}</b> {clock(each.finding.time)} "
        f'<a href="#{each.anchor}">{text(each.finding.message)}</a> '
        f"<small>{text(each.finding.path)}</small></li>\n"
        for (_, device), each in first.items()
    )
    return f'<section id="first"><h2>What was wrong first</h2><ul>\n{items}</ul></section>'


# The devices over time.


def _devices(findings: Sequence[Numbered], dossier: Dossier) -> str:
    own: dict[tuple[str, str | None], list[Numbered]] = {}
    for each in findings:
        own.setdefault((each.finding.path, each.finding.vmd), []).append(each)
    shown = "".join(_device(incident, own) for incident in dossier.incidents.values() if incident.devices)
    if not shown:
        return ""
    tools = (
        '<p class="tools zoom" hidden><button data-zoom="in">zoom in</button> '
        '<button data-zoom="out">zoom out</button> <button data-zoom="left">earlier</button> '
        '<button data-zoom="right">later</button> '
        '<button data-zoom="all">whole recording</button> <output></output></p>'
    )
    return f'<section id="devices"><h2>State over time</h2>\n{KEY}{tools}{shown}</section>'


def _device(incident: Incident, findings: Mapping[tuple[str, str | None], Sequence[Numbered]]) -> str:
    told = ""
    for device in incident.devices:
        own = findings.get((incident.origin.path, device.device), ())
        odd = {each.finding.index for each in own if each.finding.index is not None}
        about = f"{text(device.model or 'not judged')}, {text(incident.origin.path)}"
        title = f"<h3>{text(device.device or '(without a name)')} <small>{about}</small></h3>"
        told += element(
            "section",
            f"{title}\n{timeline(device, own)}{folded('The path through its states', path(device, odd))}",
            class_="device", data_device=device.device,
        )  # fmt: skip
    return told


# The findings.


def _findings(findings: Sequence[Numbered], dossier: Dossier) -> str:
    if not findings:
        return '<section id="findings"><h2>Findings</h2><p>None.</p></section>'
    groups = "".join(_group(group, dossier) for group in grouped(findings))
    return f'<section id="findings"><h2>Findings</h2>\n{_filters(findings)}{groups}</section>'


def _filters(findings: Sequence[Numbered]) -> str:
    """What to show; hidden where there is no script that could obey."""
    boxes = "".join(
        f'<label><input type="checkbox" name="severity" value="{severity}" checked> {severity}</label> '
        for severity in SEVERITIES
    )
    devices = sorted({each.finding.vmd or "" for each in findings})
    rules = sorted({each.finding.rule for each in findings})
    return (
        '<form class="tools filters" hidden role="search"><label>search <input type="search" name="text" '
        f'placeholder="clause, name, message (/)"></label> {boxes}{_choice("device", devices)} '
        f'{_choice("rule", rules)} <button type="reset">clear</button> '
        f"<output>{counted(len(findings), 'finding')}</output></form>\n"
        '<p class="nothing" hidden>No finding is like that: clear the filters to see all.</p>\n'
    )


def _choice(name: str, values: Sequence[str]) -> str:
    options = "".join(element("option", text(value), value=value) for value in values if value)
    return f'<label>{name} <select name="{name}"><option value="">all</option>{options}</select></label>'


def _group(group: Group, dossier: Dossier) -> str:
    device = text(group.device) if group.device else text(group.path)
    about = f"{counted(len(group.findings), 'finding')}, {text(group.path)}"
    title = f"<h3>{device}: {text(group.clause)} <small>{about}</small></h3>"
    wholes = "".join(whole(each, dossier) for each in group.findings if each.whole)
    return element("section", f"{title}\n{wholes}{_lines(group)}", class_="group") + "\n"


def _lines(group: Group) -> str:
    """The many others of their kind."""
    others = [each for each in group.findings if not each.whole]
    if not others:
        return ""
    items = "".join(map(line, others[:MOST_LINES]))
    more = f"<li>and {len(others) - MOST_LINES} more</li>" if len(others) > MOST_LINES else ""
    return folded(f"{len(others)} more of the kind", f'<ol class="lines">\n{items}{more}</ol>\n')


# What it rests on.


def _footer(dossier: Dossier) -> str:
    origins = "".join(_origin(incident) for incident in dossier.incidents.values())
    judged = pairs((name, text(value)) for name, value in dossier.judged)
    return f"<footer>{judged}{origins}<p>mmsverify {text(mmsverify.__version__)}</p></footer>"


def _origin(incident: Incident) -> str:
    return pairs(_about(incident))


def _about(incident: Incident) -> Iterator[tuple[str, str]]:
    origin = incident.origin
    yield "recording", text(origin.path)
    yield "octets", str(origin.octets)
    yield "SHA-256", f"<code>{text(origin.sha256)}</code>" if origin.sha256 else ""
