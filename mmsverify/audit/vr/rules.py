"""Rules of VR samples beside the rows of the model: what a cell can hold, and that nothing else happens."""

from __future__ import annotations

from collections.abc import Mapping

from mmsverify.audit.rule import Rule, rule

VR_RULES: Mapping[str, Rule] = {
    listed.id: listed
    for listed in (
        rule("vr.undecodable", "this is no sample of VR cells: {cause}", "V-VR-N"),
        rule("vr.cell", "{cell} is {found}, not a number", "V-VR-N"),
        rule(
            "mode.unknown",
            "C_RunMD is {found}, and no mode has this number",
            "V-SM-0",
            "V-CTL02-N",
            expects=("C_RunMD=0..16",),
            observed="C_RunMD={found}",
        ),
        rule(
            "mode.unhomed",
            "CF_Home is 0 in mode {mode}, which only a homed machine enters",
            "V-FUN-2",
            "V-SM-5",
            "V-VR-10",
            expects=("CF_Home=1",),
            observed="CF_Home=0",
        ),
        rule(
            "status.unknown",
            "CS_RunSTA is {found}, and no status has this number",
            "V-STA-N",
            "V-PRE-0",
            observed="CS_RunSTA={found}",
        ),
        rule(
            "status.two-tables",
            "CS_RunSTA is {found}: the text's tables give the statuses of user actions two numbers each, "
            "and the profile does not say which hold (sub_action_status)",
            "V-STA-11",
            "V-PRE-13",
            "VR-12",
            severity="note",
        ),
        rule("status.mode", "the status cannot be so in mode {mode}", "V-PRE-0", "V-STA-N", "V-CTL02-1"),
        rule(
            "command.none",
            "no command stands in C_Cmd: {held} is followed by {shown}",
            "V-CMD02-2a",
            "V-DO-00",
            "V-CTL02-N",
        ),
        rule(
            "command.other",
            "C_Cmd holds {number}, which is another command: {held} is followed by {shown}",
            "V-CMD02-2c",
            "V-CTL02-N",
        ),
        rule(
            "command.unknown",
            "C_Cmd holds {number}, which is no command: {held} is followed by {shown}",
            "V-CHK-4",
            "V-DO-X",
            "V-CMD02-2b",
            "V-CTL02-N",
        ),
        rule(
            "origin.unasked",
            "CF_AutoOrg is 0: {held} is followed by {shown} without a command",
            "V-NEXT-03b",
            "V-CMD02-2a",
            "V-CTL02-N",
        ),
        rule(
            "sub-mode.number",
            "an action of the user's begins and C_SubMD is {found}, where DoCmd sets {right}",
            "V-VR-04",
            "V-CMD02-2c",
            "VR-20",
            observed="C_SubMD={found}",
        ),
        rule(
            "sub-mode.changed",
            "C_SubMD goes from {before} to {found} by a command that leaves it as it is",
            "V-VR-04",
            "V-CMD02-2",
            "VR-20",
            observed="C_SubMD={found}",
        ),
        rule(
            "sub-mode.unasked",
            "C_SubMD goes from {before} to {found}, and no command is given",
            "V-VR-04",
            "V-CMD02-2a",
            "VR-20",
            severity="warning",
            observed="C_SubMD={found}",
        ),
        rule(
            "origin.not-after-home",
            "CF_AutoOrg leads on to the origin, though Home has not ended just now",
            "V-NEXT-03a",
            "V-CTL02-N",
            "VR-10",
            severity="warning",
        ),
        rule("mode.next", "{held} is followed by {shown}", "V-NEXT-N", "V-CTL02-3", "V-CTL02-N"),
    )
}
