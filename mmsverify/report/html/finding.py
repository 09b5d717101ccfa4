"""One finding as part of a page: the sentence, the clause, what was known, what was said around it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from mmsverify.incident import Dossier, Incident, Saying
from mmsverify.report.html.numbered import Numbered
from mmsverify.report.html.sequence import chart
from mmsverify.report.html.text import clock, element, folded, pairs, text
from mmsverify.report.html.why import why
from mmsverify.report.wording import cells
from mmsverify.results import Finding

ROW = 16
MOST_OCTETS = 512
"""Octets of a message that are shown in hex."""


def whole(each: Numbered, dossier: Dossier) -> str:
    """Everything about one finding."""
    finding, incident = each.finding, dossier.incidents.get(each.finding.path)
    account = dossier.accounts.get((finding.path, finding.index, finding.rule))
    inside = (
        f"{_head(each)}{element('p', text(finding.message), class_='message')}\n"
        f"{pairs([*_told(finding, dossier.statements), *why(account)])}"
        f"{_around(finding, incident)}{_event(finding, incident)}{_before(finding)}"
    )
    return element("article", inside, **_marks(each)) + "\n"


def line(each: Numbered) -> str:
    """One of many of its kind, in one line."""
    observed = text(each.finding.observed or each.finding.message)
    return element("li", f"{_head(each)}{observed}", **_marks(each)) + "\n"


def _marks(each: Numbered) -> dict[str, object]:
    """What the filters go by."""
    finding = each.finding
    return {
        "class_": f"finding {finding.severity}", "id": each.anchor, "data_severity": finding.severity,
        "data_device": finding.vmd or "", "data_rule": finding.rule,
    }  # fmt: skip


def _head(each: Numbered) -> str:
    finding = each.finding
    times = f' <span class="times">{finding.count} times</span>' if finding.count > 1 else ""
    index = "the whole file" if finding.index is None else f"message {finding.index}"
    link = element("a", f"#{each.number}", href=f"#{each.anchor}", class_="self")
    return (
        f'<p class="head"><span class="badge">{finding.severity}</span> {link} '
        f"<code>{text(finding.rule)}</code>{times} "
        f'<span class="place">{index} {clock(finding.time)} {text(finding.topic or "")}</span></p>\n'
    )


def _told(finding: Finding, statements: Mapping[str, str]) -> list[tuple[str, str]]:
    return [
        ("clause", "<br>".join(_cited(finding.clauses, statements))),
        ("our reading", "<br>".join(_cited(finding.readings, statements))),
        ("observed", text(_plain(finding.observed))),
        ("legal would be", text(" or ".join(map(_plain, finding.expected)))),
        ("led up to by", ", ".join(f"message {index}" for index in finding.related)),
    ]


def _plain(answer: str) -> str:
    return {"result(+)": "accepted: result(+)", "result(-)": "refused: result(-)"}.get(answer, answer)


def _cited(ids: Sequence[str], statements: Mapping[str, str]) -> Iterator[str]:
    for each in ids:
        says = statements.get(each, "")
        yield f"<b>{text(each)}</b>{f' {text(says)}' if says else ''}"


def _before(finding: Finding) -> str:
    known = [(name, text(value)) for name, value in cells(finding.before).items()]
    return folded("What was known before", pairs(known))


def _event(finding: Finding, incident: Incident | None) -> str:
    """The message itself, decoded and in hex."""
    saying = incident.sayings.get(finding.index) if incident and finding.index is not None else None
    if saying is None:
        return ""
    return folded("The message, decoded and in hex", decoded(saying) + hexdump(saying.octets))


def decoded(saying: Saying) -> str:
    """The values of a message by their names."""
    told = [(name, text(value)) for name, value in saying.fields]
    return pairs([("message", text(saying.title)), ("fault", text(saying.fault)), *told])


def hexdump(octets: bytes) -> str:
    """Octets sixteen in a row, with their offsets and what is ASCII of them."""
    rows = [
        f"{at:04x}  {octets[at : at + ROW].hex(' '):<{3 * ROW}} {_ascii(octets[at : at + ROW])}"
        for at in range(0, min(len(octets), MOST_OCTETS), ROW)
    ]
    more = len(octets) - MOST_OCTETS
    rows += [f"and {more} octets more"] if more > 0 else []
    return element("pre", "\n".join(map(text, rows)), tabindex=0) + "\n"


def _ascii(octets: bytes) -> str:
    return "".join(chr(octet) if 0x20 <= octet < 0x7F else "." for octet in octets)


def _around(finding: Finding, incident: Incident | None) -> str:
    """What was said before and after, as a chart and as a table."""
    if incident is None or finding.index is None or finding.index not in incident.windows:
        return ""
    said = [incident.sayings[index] for index in incident.windows[finding.index]]
    marked = {finding.index: "finding", **dict.fromkeys(finding.related, "related")}
    rows = "".join(_row(saying, marked.get(saying.index, "")) for saying in said)
    head = "<tr><th>message</th><th>time</th><th>from</th><th>what</th><th>values</th></tr>"
    table = folded("The same as a table", f'<table class="sayings">{head}\n{rows}</table>\n')
    return folded(
        "The messages around it", chart(said, finding.index, set(finding.related)) + table, opened=True
    )


def _row(saying: Saying, mark: str) -> str:
    values = ", ".join(f"{name} = {value}" for name, value in saying.fields)
    sender = (
        f"{saying.partner} {saying.sender}" if saying.sender == "client" else saying.sender or saying.partner
    )
    what = f"{saying.title}: {saying.about}" if saying.about else saying.title
    told = (
        str(saying.index),
        clock(saying.time),
        text(sender),
        text(what),
        text(saying.fault or values),
    )
    return element("tr", "".join(f"<td>{cell}</td>" for cell in told), class_=mark or None) + "\n"
