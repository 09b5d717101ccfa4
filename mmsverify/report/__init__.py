"""Results to print: an audit or a check goes in, one string in the asked format comes out.

The registry of formats stands here, one file per format beside it. Renderers read results and decide nothing:
what is a violation, and why, was settled before. No file is opened here, nothing is printed, and the same
result gives the same characters every time. Names out of a trace are other people's text: every format shows
them escaped.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from mmsverify.errors import UsageError
from mmsverify.incident import Dossier
from mmsverify.report import (
    account_json,
    account_text,
    audit_json,
    audit_junit,
    audit_sarif,
    audit_text,
    check_json,
    check_text,
    clauses_json,
    clauses_text,
    explanation_json,
    explanation_text,
    html,
    imports,
    recording,
    survey_json,
    survey_text,
)
from mmsverify.results import Account, Audit, Explanation, ModelCheck, Register, Survey

__all__ = [
    "ACCOUNT_FORMATS",
    "AUDIT_FORMATS",
    "CHECK_FORMATS",
    "CLAUSES_FORMATS",
    "EXPLANATION_FORMATS",
    "FINDINGS_FORMATS",
    "IMPORT_FORMATS",
    "RECORD_FORMATS",
    "render_accounts",
    "render_audit",
    "render_check",
    "render_clauses",
    "render_explanation",
    "render_findings",
    "render_import",
    "render_recording",
    "require_format",
]

AUDIT_FORMATS: Mapping[str, Callable[[Audit], str]] = {
    "text": audit_text.render,
    "json": audit_json.render,
    "sarif": audit_sarif.render,
    "junit": audit_junit.render,
    "html": html.render,
}

CHECK_FORMATS: Mapping[str, Callable[[Sequence[ModelCheck]], str]] = {
    "text": check_text.render,
    "json": check_json.render,
}

CLAUSES_FORMATS: Mapping[str, Callable[..., str]] = {
    "text": clauses_text.render,
    "json": clauses_json.render,
}

ACCOUNT_FORMATS: Mapping[str, Callable[[str, int, Sequence[Account]], str]] = {
    "text": account_text.render,
    "json": account_json.render,
}

EXPLANATION_FORMATS: Mapping[str, Callable[[Explanation, Sequence[Account]], str]] = {
    "text": explanation_text.render,
    "json": explanation_json.render,
}

FINDINGS_FORMATS: Mapping[str, Callable[[Survey], str]] = {
    "text": survey_text.render,
    "json": survey_json.render,
}

IMPORT_FORMATS: Mapping[str, Callable[[Sequence[imports.Imported]], str]] = {
    "text": imports.render_text,
    "json": imports.render_json,
}

RECORD_FORMATS: Mapping[str, Callable[[str, recording.Recording], str]] = {
    "text": recording.render_text,
    "json": recording.render_json,
}


def render_accounts(path: str, index: int, accounts: Sequence[Account], format: str) -> str:
    """Why the findings of one message stand in ``format``, a key of ``ACCOUNT_FORMATS``."""
    return ACCOUNT_FORMATS[require_format(format, ACCOUNT_FORMATS)](path, index, accounts)


def render_audit(audit: Audit, format: str, dossier: Dossier | None = None) -> str:
    """The audit in ``format``, a key of ``AUDIT_FORMATS``; the text ends with a line feed.

    ``dossier``: what a page shows beside the findings; of it SARIF tells what the clauses say, as the help of
    its rules. The other formats have no room for it.
    """
    render = AUDIT_FORMATS[require_format(format, AUDIT_FORMATS)]
    if render is audit_sarif.render:
        return audit_sarif.render(audit, dossier.statements if dossier else None)
    return html.render(audit, dossier) if render is html.render else render(audit)


def render_check(checks: Sequence[ModelCheck], format: str) -> str:
    """The verdicts in ``format``, a key of ``CHECK_FORMATS``; the text ends with a line feed."""
    return CHECK_FORMATS[require_format(format, CHECK_FORMATS)](checks)


def render_clauses(registers: Sequence[Register], format: str, *, long: bool = False) -> str:
    """The registers in ``format``, a key of ``CLAUSES_FORMATS``; ``long``: every statement in full."""
    return CLAUSES_FORMATS[require_format(format, CLAUSES_FORMATS)](registers, long=long)


def render_explanation(explanation: Explanation, format: str, accounts: Sequence[Account] = ()) -> str:
    """How a sample follows from the one before in ``format``, a key of ``EXPLANATION_FORMATS``.

    ``accounts`` are those of its findings.
    """
    return EXPLANATION_FORMATS[require_format(format, EXPLANATION_FORMATS)](explanation, accounts)


def render_findings(survey: Survey, format: str) -> str:
    """The faults of a text in ``format``, a key of ``FINDINGS_FORMATS``; the text ends with a line feed."""
    return FINDINGS_FORMATS[require_format(format, FINDINGS_FORMATS)](survey)


def render_import(inputs: Sequence[imports.Imported], format: str) -> str:
    """What an import read in ``format``, a key of ``IMPORT_FORMATS``; the text ends with a line feed."""
    return IMPORT_FORMATS[require_format(format, IMPORT_FORMATS)](inputs)


def render_recording(path: str, recorded: recording.Recording, format: str) -> str:
    """What the recording at ``path`` holds in ``format``, a key of ``RECORD_FORMATS``."""
    return RECORD_FORMATS[require_format(format, RECORD_FORMATS)](path, recorded)


def require_format(format: str, known: Mapping[str, object] | Sequence[str]) -> str:
    """``format`` itself if it is one of ``known``; else a usage error that lists them."""
    if format not in known:
        raise UsageError(f"no format {format!r} here", place="--format", cure=f"one of {', '.join(known)}")
    return format
