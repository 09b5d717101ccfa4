"""Profiles: what a standard leaves to the implementer, a table per model, from TOML or a trace's metadata.

from mmsverify.profiles import judge, load_profile

table = load_profile("one-program")["mms-robot"]
for finding in judge(table):
    print(finding.message)
"""

from mmsverify.profiles.checks import arm_domains
from mmsverify.profiles.framework import FRAMEWORK_TABLE, within_framework
from mmsverify.profiles.judging import CHECKS, judge
from mmsverify.profiles.reading import complete, for_recording, from_metadata, load_profile, stated
from mmsverify.profiles.registry import KEYS, ROBOT_TABLE, SIGNALS_TABLE
from mmsverify.profiles.shipped import shipped

__all__ = [
    "CHECKS",
    "FRAMEWORK_TABLE",
    "KEYS",
    "ROBOT_TABLE",
    "SIGNALS_TABLE",
    "arm_domains",
    "complete",
    "for_recording",
    "from_metadata",
    "judge",
    "load_profile",
    "shipped",
    "stated",
    "within_framework",
]
