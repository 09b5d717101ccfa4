"""What MkDocs is told beside ``mkdocs.yml``: pages that are made, and that none loads from elsewhere."""

from __future__ import annotations

from pathlib import Path

from mkdocs.config.defaults import MkDocsConfig
from mkdocs.exceptions import PluginError
from mkdocs.structure.files import File, Files
from mkdocs.structure.pages import Page

from mmsverify.commands import reference
from mmsverify.manual import drawings, pages
from mmsverify.manual.markdown import anchored
from mmsverify.manual.standalone import loaded_from_elsewhere


def on_files(files: Files, config: MkDocsConfig) -> Files:
    """Add the pages that are made from the models, tables and commands."""
    made = {**pages(), "reference/cli.md": reference.page(), **drawings(files.src_uris)}
    for path, text in made.items():
        files.append(File.generated(config, path, content=text))
    return files


def on_page_markdown(markdown: str, page: Page, **_given: object) -> str:
    """Make places to link to on the page of readings."""
    return anchored(markdown) if page.file.src_uri == "readings.md" else markdown


def on_page_content(html: str, **_given: object) -> str:
    """Show the names of classes in docstrings without the role that marks them."""
    return html.replace(":class:<code>", "<code>")


def on_post_build(config: MkDocsConfig) -> None:
    """Refuse a site that cannot be read without a network: plants have none."""
    for page in Path(config.site_dir).rglob("*.html"):
        for address in loaded_from_elsewhere(page.read_text(encoding="utf-8")):
            raise PluginError(f"{page} loads {address}: no page may need a network")
