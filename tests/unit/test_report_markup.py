"""JUnit and HTML output: well-formed whatever the recording holds, and read alike by servers and people."""

from __future__ import annotations

import re
from base64 import b64encode
from collections import Counter
from dataclasses import replace
from hashlib import sha256
from html.parser import HTMLParser
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

from hypothesis import given
from hypothesis import strategies as st
from report_samples import AUDIT, CLEAN, HOSTILE, READ, SELECT, START

from mmsverify.report import render_audit
from mmsverify.results import Audit

ANY_TEXT = st.text(st.characters(exclude_categories=()), max_size=20)


class Page(HTMLParser):
    """Counts the tags of a page, collects its attributes' names and checks that what opens closes."""

    def __init__(self, page: str) -> None:
        super().__init__()
        self.tags: Counter[str] = Counter()
        self.attributes: set[str] = set()
        self.open: list[str] = []
        self.feed(page)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags[tag] += 1
        self.attributes |= {name for name, _ in attrs}
        if tag not in {"meta", "link", "input", "br"}:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def suites(audit: Audit) -> Element:
    return ElementTree.fromstring(render_audit(audit, "junit"))


def hostile(text: str) -> Audit:
    finding = replace(
        SELECT, topic=text, message=text, observed=text, before={text: text}, rule=text, path=text
    )
    return Audit([replace(READ, path=text)], [finding])


def test_each_input_is_a_suite_and_each_rule_a_case() -> None:
    root = suites(AUDIT)
    assert [(suite.get("name"), [case.get("name") for case in suite]) for suite in root] == [
        ("a.mcap", ["select.controlled-elsewhere", "start.direct"]),
        ("b.mcap", ["input.unreadable"]),
    ]


def test_only_errors_fail_and_the_totals_agree() -> None:
    root = suites(AUDIT)
    failed = {case.get("name") for case in root.iter("testcase") if case.find("failure") is not None}
    assert failed == {"select.controlled-elsewhere", "input.unreadable"}
    assert (root.get("tests"), root.get("failures")) == ("3", "2")
    assert [(suite.get("tests"), suite.get("failures")) for suite in root] == [("2", "1"), ("1", "1")]


def test_a_failure_tells_all_findings_of_its_rule() -> None:
    (failure,) = suites(Audit([READ], [SELECT, replace(SELECT, index=20, message="again")])).iter("failure")
    assert failure.get("message") == SELECT.message + " (and 1 more event)"
    assert "#17" in str(failure.text)
    assert "#20" in str(failure.text)
    assert "clauses R-7.4.4.2-d; expected result(-); observed result(+)" in str(failure.text)


def test_a_clean_input_is_one_passing_case() -> None:
    (case,) = suites(CLEAN).iter("testcase")
    assert case.get("name") == "no violation"
    assert len(case) == 0


def test_the_page_shows_every_finding_with_its_clauses() -> None:
    page = render_audit(AUDIT, "html")
    assert Page(page).tags["article"] == 3
    for text in (
        "R-7.4.4.2-d",
        "RP-06",
        "select.controlled-elsewhere",
        "2025-11-24T16:00:00.123456789Z",
        "message 17",
    ):
        assert text in page


def test_the_page_needs_nothing_from_elsewhere() -> None:
    text = render_audit(AUDIT, "html")
    page = Page(text)
    assert not {"img", "iframe", "object"} & set(page.tags)
    assert not {"src", "onclick", "onload"} & page.attributes
    assert (page.tags["script"], page.tags["link"]) == (1, 1)
    assert set(re.findall(r'href="(?!#)([^"]*)"', text)) == {"data:,"}
    assert "url(" not in text


def test_the_policy_names_the_script_and_the_style_of_the_page() -> None:
    text = render_audit(AUDIT, "html")
    for tag in ("script", "style"):
        (inside,) = re.findall(rf"<{tag}>(.*?)</{tag}>", text, re.DOTALL)
        digest = b64encode(sha256(inside.encode()).digest()).decode()
        assert f"{tag}-src 'sha256-{digest}'" in text


@given(ANY_TEXT)
def test_no_text_of_a_recording_breaks_the_xml(text: str) -> None:
    assert len(list(suites(hostile(text)).iter("failure"))) == 1


@given(ANY_TEXT)
def test_no_text_of_a_recording_becomes_markup(text: str) -> None:
    benign, page = Page(render_audit(hostile("x"), "html")), Page(render_audit(hostile(text), "html"))
    assert page.tags.keys() <= benign.tags.keys()
    assert page.tags["article"] == 1


def test_hostile_text_is_shown_escaped() -> None:
    page = render_audit(hostile(HOSTILE), "html")
    assert page.count("<script") == 1
    assert "&lt;script&gt;" in page
    assert page.isascii()


def test_the_same_audit_gives_the_same_characters() -> None:
    shuffled = Audit(AUDIT.inputs, [START, SELECT, AUDIT.findings[0]])
    for format in ("text", "json", "sarif", "junit", "html"):
        assert render_audit(AUDIT, format) == render_audit(shuffled, format)
