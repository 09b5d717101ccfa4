"""An audit as JUnit XML, as continuous-integration servers read it: a suite per input, a case per rule.

Only errors fail a case: a warning or note is told in the case's output. An input without findings is one
passing case, so that a clean audit does not look like a run without tests.
"""

from __future__ import annotations

from xml.etree import ElementTree
from xml.etree.ElementTree import Element, SubElement

from mmsverify.report.audit_text import heading
from mmsverify.report.order import by_input
from mmsverify.report.wording import counted, printable
from mmsverify.results import Audit, AuditedInput, Finding, Withheld

CLEAN = "no violation"


def render(audit: Audit) -> str:
    root = Element("testsuites", name="mmsverify audit")
    for path, entry, findings in by_input(audit):
        _suite(root, path, entry, findings, [rest for rest in audit.withheld if rest.path == path])
    _add_up(root, root.findall("testsuite"))
    ElementTree.indent(root)
    # ASCII with character references: valid under whatever encoding the text is written in.
    xml: bytes = ElementTree.tostring(root, encoding="us-ascii", xml_declaration=True)
    return xml.decode("ascii") + "\n"


def _suite(
    root: Element, path: str, entry: AuditedInput | None, findings: list[Finding], withheld: list[Withheld]
) -> None:
    seconds = f"{entry.seconds if entry else 0.0:.3f}"
    suite = SubElement(root, "testsuite", name=printable(path), time=seconds)
    for rule in sorted({finding.rule for finding in findings}):
        same = [finding for finding in findings if finding.rule == rule]
        _case(suite, rule, same, [rest for rest in withheld if rest.rule == rule])
    if not findings:
        _case(suite, CLEAN, [], [])
    failures = len(suite.findall("testcase/failure"))
    suite.attrib |= {"tests": str(len(suite)), "failures": str(failures), "errors": "0", "skipped": "0"}


def _case(suite: Element, name: str, findings: list[Finding], withheld: list[Withheld]) -> None:
    case = SubElement(suite, "testcase", classname=suite.attrib["name"], name=printable(name), time="0.000")
    errors = [finding for finding in findings if finding.severity == "error"]
    others = [finding for finding in findings if finding.severity != "error"]
    more_errors = sum(rest.count for rest in withheld if rest.severity == "error")
    more_others = sum(rest.count for rest in withheld) - more_errors
    if errors:
        number = len(errors) - 1 + more_errors
        more = f" (and {counted(number, 'more event')})" if number else ""
        failure = SubElement(
            case, "failure", type=printable(name), message=printable(errors[0].message) + more
        )
        failure.text = _told(errors, more_errors)
    if others or more_others:
        SubElement(case, "system-out").text = _told(others, more_others)


def _told(findings: list[Finding], more: int) -> str:
    rest = [f"{more} more, not told (--max-per-rule)"] if more else []
    return "\n".join([line for finding in findings for line in _lines(finding)] + rest)


def _lines(finding: Finding) -> list[str]:
    clauses = " ".join((*finding.clauses, *finding.readings))
    expected = " or ".join(map(printable, finding.expected)) or "-"
    facts = f"clauses {clauses}; expected {expected}; observed {printable(finding.observed) or '-'}"
    return [heading(finding), f"  {printable(finding.message)}", f"  {facts}"]


def _add_up(root: Element, suites: list[Element]) -> None:
    for name in ("tests", "failures", "errors"):  # a root of the usual schemas counts nothing else
        root.set(name, str(sum(int(suite.attrib[name]) for suite in suites)))
