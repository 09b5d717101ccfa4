"""The HTML report in a real browser: it filters, zooms, obeys keys, and nothing hostile gets through."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from mmsverify.auditing import audit_traces
from mmsverify.formats.mcap import TraceWriter
from mmsverify.formats.trace import Channel
from mmsverify.incident import Change, DeviceLine, Dossier, Incident, Lane, Origin
from mmsverify.incidents import dossier
from mmsverify.report import render_audit
from mmsverify.resources import traces_dir
from mmsverify.results import Audit, AuditedInput, Finding

if TYPE_CHECKING:
    from chromium import Watched
    from playwright.sync_api import Page

SAMPLES = sorted(traces_dir().glob("*.mcap"))
FAULTY = [path for path in SAMPLES if path.stem.startswith("faulty")]
HOSTILE = "<img src=x onerror=alert(1)>\"'><script>alert(2)</script>&{{7*7}}\u202e"


def report(paths: list[Path], out: Path) -> Audit:
    audit = audit_traces(paths, profile=None, model=None)
    out.write_text(render_audit(audit, "html", dossier(audit)))
    return audit


@pytest.fixture(scope="module")
def all_samples(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Audit]:
    out = tmp_path_factory.mktemp("report") / "all.html"
    return out, report(SAMPLES, out)


@pytest.mark.parametrize("path", SAMPLES, ids=lambda path: path.stem)
def test_the_report_of_each_sample_opens(path: Path, watched: Watched, tmp_path: Path) -> None:
    audit = report([path], tmp_path / "report.html")
    page = watched.open(tmp_path / "report.html")
    assert page.locator(".finding[id]").count() == len(audit.findings)
    assert page.locator(".device").count() > 0
    assert page.locator("svg.sequence").count() == len(
        {f.index for f in audit.findings if f.index is not None}
    )


def shown(page: Page) -> int:
    page.wait_for_timeout(150)
    return page.locator(".finding[id]:not(.away)").count()


def test_filters_show_what_they_say(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    path, audit = all_samples
    page = watched.open(path)
    page.locator("select[name=device]").select_option("weld3")
    assert shown(page) == sum(finding.vmd == "weld3" for finding in audit.findings)
    assert page.locator(".device:not(.away)").count() == 1
    page.locator(".filters button[type=reset]").click()
    assert shown(page) == len(audit.findings)
    rule = audit.findings[0].rule
    page.locator("select[name=rule]").select_option(rule)
    assert shown(page) == sum(finding.rule == rule for finding in audit.findings)
    page.locator(".filters button[type=reset]").click()
    page.locator("input[value=error]").uncheck()
    assert shown(page) == sum(finding.severity != "error" for finding in audit.findings)
    assert f"of {len(audit.findings)} findings" in page.locator(".filters output").inner_text()


def test_the_search_finds_clauses_names_and_messages(
    all_samples: tuple[Path, Audit], watched: Watched
) -> None:
    page = watched.open(all_samples[0])
    page.keyboard.press("/")
    page.keyboard.type("r-7.4.4.2-e")
    told = page.locator(".finding[id]:not(.away)")
    assert 0 < shown(page) < len(all_samples[1].findings)
    assert all("R-7.4.4.2-e" in text for text in told.all_inner_texts())
    page.locator("input[type=search]").fill("weld_door selected")
    assert shown(page) >= 1
    page.locator("input[type=search]").fill("there is no such thing")
    assert shown(page) == 0
    assert page.locator(".group:not(.away)").count() == 0


def test_keys_go_from_finding_to_finding(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    page = watched.open(all_samples[0])
    page.keyboard.press("j")
    assert page.evaluate("location.hash") == "#finding-1"
    page.keyboard.press("j")
    assert page.evaluate("location.hash") == "#finding-2"
    page.keyboard.press("k")
    assert page.evaluate("document.activeElement.id") == "finding-1"


def test_everything_that_acts_can_be_reached_by_the_keyboard(
    all_samples: tuple[Path, Audit], watched: Watched
) -> None:
    page = watched.open(all_samples[0])
    reached = set()
    for _ in range(150):
        page.keyboard.press("Tab")
        reached.add(
            page.evaluate("(document.activeElement.getAttribute('class') || document.activeElement.tagName)")
        )
    assert {"BUTTON", "lanes-window", "mark error", "SUMMARY", "INPUT", "SELECT", "self", "scroll"} <= reached


def places(page: Page) -> list[str]:
    found: list[str] = (
        page.locator(".timeline")
        .first.locator("svg.part")
        .evaluate_all("parts => parts.filter(p => p.style.display !== 'none').map(p => p.getAttribute('x'))")
    )
    return found


def test_a_timeline_zooms_by_keys_and_by_buttons(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    page = watched.open(all_samples[0])
    whole = places(page)
    page.locator(".lanes-window").first.focus()
    for key in ("+", "+", "ArrowRight"):
        page.keyboard.press(key)
    near = places(page)
    assert 0 < len(near) < len(whole)
    assert near != whole
    page.keyboard.press("0")
    assert len(places(page)) == len(whole)
    page.locator("button[data-zoom=in]").click()
    assert page.locator(".zoom output").inner_text() == "2\u00d7"
    ends = page.locator(".timeline").first.locator(".ends time")
    assert ends.first.inner_text() != ends.last.inner_text()


def test_a_mark_on_the_timeline_leads_to_its_finding(
    all_samples: tuple[Path, Audit], watched: Watched
) -> None:
    page = watched.open(all_samples[0])
    mark = page.locator("a.mark").first
    mark.focus()
    page.keyboard.press("Enter")
    target = str(page.evaluate("location.hash"))
    assert target == mark.get_attribute("href")
    page.wait_for_timeout(100)
    assert page.locator(target).is_visible()


def test_a_sequence_chart_joins_requests_and_answers(watched: Watched, tmp_path: Path) -> None:
    report([traces_dir() / "faulty-select.mcap"], tmp_path / "report.html")
    page = watched.open(tmp_path / "report.html")
    chart = page.locator("svg.sequence").first
    assert chart.locator("g.say.finding").count() == 1
    assert chart.locator("g.say.related").count() > 0
    assert chart.locator("rect.served").count() > 2
    assert "Select request: Weld_Roof" in str(chart.text_content())
    bar = chart.locator("rect.served").last.bounding_box()
    assert bar is not None
    assert bar["height"] > 10


def test_without_scripts_everything_can_be_read(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    assert watched.page.context.browser is not None
    context = watched.page.context.browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto(all_samples[0].as_uri())
    assert page.locator("form.filters").is_hidden()
    assert page.locator("article.finding").count() == len(all_samples[1].findings)
    assert page.locator("svg.part").first.is_visible()
    page.locator("article details summary").nth(1).click()
    context.close()


def test_a_printed_page_has_no_tools(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    page = watched.open(all_samples[0])
    assert page.locator("form.filters").is_visible()
    page.emulate_media(media="print")
    assert page.locator("form.filters").is_hidden()
    assert page.locator(".zoom").is_hidden()
    assert len(page.pdf()) > 10_000


def test_names_out_of_a_recording_are_never_more_than_names(watched: Watched, tmp_path: Path) -> None:
    path, out = tmp_path / "hostile.mcap", tmp_path / "report.html"
    with TraceWriter(path) as trace:
        for number in range(3):
            trace.add(
                1000 + number,
                Channel(
                    "/a/mms/b/client",
                    "mms-ber",
                    Channel.mms("v", "a", "client").schema,
                    {"vmd": HOSTILE, "association": HOSTILE, "sender": "client"},
                ),
                b"\xff" * 4,
            )
            said = f'{{"C_RunMD": 99{number}, "{HOSTILE[:20].replace(chr(34), "")}": 1}}'
            trace.add(2000 + number, Channel.vr("<b>press", "scan"), said.encode())
    report([path], out)
    page = watched.open(out)
    assert page.locator("img, b script").count() == 0
    assert page.locator("script").count() == 1
    assert page.locator(".finding[id]").count() > 0


def test_light_and_dark_are_readable(all_samples: tuple[Path, Audit], watched: Watched) -> None:
    """The contrast of the texts that matter is that of WCAG 2.2, AA: 4.5 to 1."""
    page = watched.open(all_samples[0])
    for scheme in ("light", "dark"):
        page.emulate_media(color_scheme=scheme)
        for each in (".message", ".place", "dt", "summary", ".badge", ".lane-name"):
            ratio = page.evaluate(CONTRAST, each)
            assert ratio >= 4.5, (scheme, each, ratio)


CONTRAST = r"""(selector) => {
  const each = document.querySelector(selector);
  const light = (text) => {
    const [r, g, b] = text.match(/[0-9.]+/g).map(Number).map((c) => c / 255)
      .map((c) => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  let behind = each;
  while (/^rgba.*, 0\)$/.test(getComputedStyle(behind).backgroundColor)) behind = behind.parentElement;
  const one = light(getComputedStyle(each).color), other = light(getComputedStyle(behind).backgroundColor);
  return (Math.max(one, other) + 0.05) / (Math.min(one, other) + 0.05);
}"""


def large(messages: int, findings: int) -> tuple[Audit, Dossier]:
    """An audit of so many messages with so many findings, as an incident of one device."""
    second, words = 1_000_000_000, ("ROBOT-LOADED", "ROBOT-READY", "ROBOT-EXECUTING", "ROBOT-MOTION-PAUSED")
    begin = 1_767_592_800 * second
    apart = messages // findings
    told = [
        Finding(
            "long.mcap", number * apart, begin + number * apart * second, "/weld/mms/a/server", "weld",
            ("error", "warning", "note")[number % 3], f"rule.{number % 12}", ("R-7.4.4.2-e",),
            f"Select answered result(+), but finding {number} says no", ("result(-)",), "result(+)",
            {"robot_state": "ROBOT-READY"},
        )
        for number in range(findings)
    ]  # fmt: skip
    lanes = [
        Lane(name, [Change(n, begin + n * second, words[n // step % 4]) for n in range(0, messages, step)])
        for name, step in (("robot state", 5), ("selected", 50), ("program A", 7))
    ]
    line = DeviceLine("weld", "mms-robot", begin, begin + messages * second, messages, lanes)
    incident = Incident(Origin("long.mcap", 1, "0" * 64), [line])
    return Audit([AuditedInput("long.mcap", messages, messages, 0, False, 1.0)], told), Dossier(
        {"long.mcap": incident}
    )


def test_a_million_messages_and_ten_thousand_findings_open_in_three_seconds(
    watched: Watched, tmp_path: Path
) -> None:
    out = tmp_path / "large.html"
    audit, beside = large(1_000_000, 10_000)
    out.write_text(render_audit(audit, "html", beside))
    begin = time.perf_counter()
    page = watched.open(out)
    page.locator(".filters output").wait_for()
    assert time.perf_counter() - begin < 3
    assert page.locator(".finding[id]").count() == 10_000
    page.locator("select[name=rule]").select_option("rule.3")
    page.wait_for_timeout(1000)
    assert (
        page.locator(".filters output").inner_text()
        == f"{sum(f.rule == 'rule.3' for f in audit.findings)} of 10000 findings"
    )
    assert out.stat().st_size < 12_000_000
