"""The pictures of the models in the README are those that the tool draws today."""

from pathlib import Path

import pytest

from mmsverify.diagrams import draw

DOCS = Path(__file__).parents[2] / "docs"


@pytest.mark.slow
@pytest.mark.parametrize("model", ["mms-robot", "vr-template"])
def test_the_picture_of_a_model_is_not_stale(model: str) -> None:
    drawn = draw(model, variant="repaired", format="svg")
    assert (DOCS / f"{model}.svg").read_text(encoding="utf-8") == drawn.rstrip("\n") + "\n", (
        f"draw it anew: mmsverify diagram {model} --format svg -o docs/{model}.svg"
    )
