"""The page about profiles is the one that the keys and checks make."""

from pathlib import Path

from mmsverify.profiles.page import page

ROOT = Path(__file__).parents[2]


def test_the_page_about_profiles_is_not_stale() -> None:
    written = (ROOT / "docs" / "profiles.md").read_text(encoding="utf-8")
    assert written == page(), "write it anew: python -m mmsverify.profiles > docs/profiles.md"
