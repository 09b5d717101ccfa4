"""Puts this folder on the import path, so that tests of every kind can share what lies here.

In CI the random tests draw the same examples each time: a change is judged by what it changes. Elsewhere they
keep searching.
"""

import os

import pytest
from hypothesis import settings

settings.register_profile("ci", derandomize=True, print_blob=True)
if os.environ.get("CI"):
    settings.load_profile("ci")


UNSETTLED = {
    "test_the_document_is_what_the_tool_makes",
    "test_no_fault_is_left_in_the_repaired_reading",
    "test_every_fault_says_what_it_means_for_a_plant",
}
"""Slow tests that were not seen green since the model grew. The list may only become shorter."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Mark what is unsettled, so that CI leaves it out and a person can run it by name."""
    for item in items:
        if getattr(item, "originalname", item.name) in UNSETTLED:
            item.add_marker("unsettled")
