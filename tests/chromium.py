"""A real browser for the report: Chromium without a window, steered by Playwright.

The browser is the system's, or the one that ``playwright install chromium`` brings. Without either, or
without Playwright, these tests are skipped; where ``MMSVERIFY_BROWSER`` is set, as in CI, that is a failure.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from playwright.sync_api import Browser, Page

NAMES = ("chromium", "chromium-browser", "google-chrome", "chrome")


def missing(why: str) -> None:
    if os.environ.get("MMSVERIFY_BROWSER"):
        pytest.fail(why)
    pytest.skip(why)


@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """One for a module, and no longer: while it runs, so does an event loop, and others want their own."""
    try:
        from playwright.sync_api import Error, sync_playwright
    except ImportError:
        missing("Playwright is not installed")
    system = next((path for path in map(shutil.which, NAMES) if path), None)
    with sync_playwright() as playwright:
        try:
            begun = playwright.chromium.launch(executable_path=system, args=["--no-sandbox"])
        except Error:
            missing("no Chromium is installed")
        yield begun
        begun.close()


class Watched:
    """A page that takes down what it should not do: errors on its console, requests of the network."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.wrong: list[str] = []
        page.on("console", lambda said: self.wrong.append(f"console: {said.text}"))
        page.on("pageerror", lambda error: self.wrong.append(f"error: {error}"))
        page.on("dialog", lambda dialog: self.wrong.append(f"dialog: {dialog.message}"))
        page.on("request", lambda asked: self.asked(asked.url))

    def asked(self, url: str) -> None:
        if not url.startswith(("file:", "data:")):
            self.wrong.append(f"request: {url}")

    def open(self, path: Path) -> Page:
        self.page.goto(path.as_uri())
        return self.page


@pytest.fixture
def watched(browser: Browser) -> Iterator[Watched]:
    """A new page; at the end it has done nothing wrong."""
    page = browser.new_page(viewport={"width": 1280, "height": 900})
    made = Watched(page)
    yield made
    page.close()
    assert made.wrong == []
