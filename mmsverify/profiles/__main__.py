"""``python -m mmsverify.profiles > docs/profiles.md``: write the page about profiles."""

from mmsverify.profiles.page import page

print(page(), end="")
