"""Puts this folder on the import path, so that tests of every kind can share what lies here.

In CI the random tests draw the same examples each time: a change is judged by what it changes. Elsewhere they
keep searching.
"""

import os

from hypothesis import settings

pytest_plugins = ["chromium"]

settings.register_profile("ci", derandomize=True, print_blob=True)
if os.environ.get("CI"):
    settings.load_profile("ci")
