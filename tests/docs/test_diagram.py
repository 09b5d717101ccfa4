"""The picture of the robot model in the README is the one that the tool draws today."""

from pathlib import Path

from mmsverify.diagrams import draw

PICTURE = Path(__file__).parents[2] / "docs" / "mms-robot.svg"


def test_the_picture_of_the_robot_model_is_not_stale() -> None:
    drawn = draw("mms-robot", variant="repaired", format="svg")
    assert PICTURE.read_text(encoding="utf-8") == drawn.rstrip("\n") + "\n", (
        "draw it anew: mmsverify diagram mms-robot --format svg -o docs/mms-robot.svg"
    )
