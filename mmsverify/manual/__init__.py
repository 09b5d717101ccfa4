"""The pages of the documentation that are made from the models and tables, as Markdown and SVG.

Nothing of them is kept: the site makes them when it is built, so that none can be stale. What a page says is
what ``check`` and ``audit`` read: rows, claims and repairs of the models, the clause registers, the rules.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from mmsverify.diagrams import draw
from mmsverify.manual import clause_page, model_page, rules_page
from mmsverify.model.load import names
from mmsverify.register import clause_registers
from mmsverify.resources import models_dir

REGISTERS = {"vr-tasks": "vr-template"}
"""Models whose statements stand in the register of another one."""


def pages() -> dict[str, str]:
    """The text of every page and drawing that is made, by its path below ``docs``."""
    return dict(_pages())


def drawing(model: str) -> str:
    """The state diagrams of a model, as SVG."""
    return draw(model, format="svg")


def drawings(kept: Mapping[str, object]) -> dict[str, str]:
    """The state diagrams of the models, by path; those that are ``kept`` by the project are left out."""
    paths = {f"{model}.svg": model for model in names(models_dir())}
    return {path: drawing(model) for path, model in paths.items() if path not in kept}


def _pages() -> Iterator[tuple[str, str]]:
    for model in names(models_dir()):
        beside = REGISTERS.get(model, model)
        yield f"reference/models/{model}.md", model_page.page(model, beside)
        yield f"reference/models/{model}-as-written.md", model_page.as_written(model, beside)
    for register in clause_registers():
        yield f"reference/clauses/{register.model}.md", clause_page.page(register)
    yield "reference/rules.md", rules_page.page()
