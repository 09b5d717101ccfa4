"""The keys of ``[mms-robot]``: what the robot standard leaves to the implementer, its PICS among it (clause 9.4).

A key's default is what a robot is taken to be of which nothing is said; for the standardized program
invocations it is what the standard fixes (8.3).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mmsverify.profiles import words
from mmsverify.profiles.keys import Key, choice, choices, flag, name, names, number, table, tables, text

ENTRY: Mapping[str, Key] = {
    "name": name(says="its name"),
    "control": choice("NORMAL", "CONTROLLING", "CONTROLLED", says="its control attribute", clauses=("R-6.3.2.2-1",)),
    "domains": names([], says="the domains that it is bound to"),
    "deletable": flag(True, says="whether DeleteProgramInvocation and VMD Reset can remove it"),
    "reusable": flag(True, says="whether it returns to IDLE at its end"),
    "controlled": names([], says="what it controls at power-on, if it is selected then", clauses=("R-6.3.2.3-2",)),
}  # fmt: skip

STANDARDIZED: Mapping[str, Mapping[str, Any]] = {
    "R_ARM": {"control": "CONTROLLED", "domains": ["R_ARM"], "deletable": False, "reusable": True},
    "R_CAL": {"control": "NORMAL", "domains": ["R_CAL"], "deletable": False, "reusable": True},
}
"""What 8.3.1 and 8.3.2 fix of the standardized program invocations; where an entry does not say, it is so."""

PREDEFINED = [{"name": name_, **fixed} for name_, fixed in STANDARDIZED.items()]

DEVICE: Mapping[str, Key] = {
    "name": name(says="what it is called"),
    "kind": choice("auxiliary", "arm", "safety", says="an arm, an auxiliary device, or a safety interlock",
                   clauses=("R-6.2.1-3", "R-6.2.1-4", "R-6.2.3.1-1")),
    "domain": text("", says="the predefined domain that represents it", clauses=("R-6.1.1-3", "R-6.2.1-1")),
    "program": text("", says="the predefined CONTROLLED program invocation that drives it, if one does",
                    clauses=("R-6.1.2.1-1", "R-6.1.2.4-1", "R-6.3.7-1")),
    "power": flag(True, says="whether its domain has a power attribute (R_DPWR)", clauses=("R-6.2.1-2", "R-6.3.7-2")),
    "local_control": flag(True, says="whether its domain has a control attribute (R_DLOCAL)", clauses=("R-6.2.1-2",)),
    "calibration": flag(True, says="whether it can be calibrated (R_DCAL)", clauses=("R-6.2.1-2", "R-6.2.3.4-1")),
}  # fmt: skip

ADDITIONAL: Mapping[str, Key] = {
    service: choice(*words.ROLES, says=f"the role in which {service} is supported; blank where it is not",
                    clauses=("R-9.4.2-1", "R-T14-1"))
    for service in words.ADDITIONAL
}  # fmt: skip

ROBOT: Mapping[str, Key] = {
    "associations": choice(
        "single", "multiple", clauses=("R-5.1.2-1", "R-5.1.3-1", "R-9.2.2.1-2", "R-9.2.2.1-3", "R-9.2.2.1-5"),
        says="one association at a time, whose client holds R_CTRL; or several, which take and give R_CTRL"),
    "step_limited": flag(
        True, clauses=("R-5.3.2-2", "R-6.3.2.5-5", "R-7.3.3.3.1.5-3", "R-T15-1"),
        says="whether the running mode STEP-LIMITED is supported"),
    "predefined": tables(
        PREDEFINED, ENTRY, clauses=("R-6.3.5.1-1", "R-6.3.5.2-2", "R-8.3.1-1", "R-8.3.2-1"),
        says="the program invocations that exist at power-on"),
    "selected_at_power_on": text(
        "", clauses=("R-6.3.5.2-3", "R-6.3.5.4-3"),
        says="the predefined CONTROLLING one that is selected at power-on, if one is"),
    "arms": names(["R_ARM"], clauses=("R-6.1.2.1-1", "R-8.3.1-1"),
                  says="the program invocations that are bound to the domain of an arm"),
    "single_task": flag(
        False, clauses=("R-5.3.1.3.3.4-2",),
        says="whether the robot holds one task program only, so that creating it also selects it"),
    "classes": choices(
        [words.BASE, words.DOWNLOAD], words.CLASSES, clauses=("R-9.1-1", "R-9.2.2.1-1", "R-9.2.2.2.1-9", "R-9.2.3.1-1"),
        says="the conformance classes that are claimed; several associations are told by `associations`"),
    "services": choices(
        [], words.SERVICES, allows="a list of services, spelt as in servicesSupported", clauses=("R-7.5.1.4-3", "R-9.2.2.2.1-1", "R-9.4.1-1"),
        says="the services that the robot performs as a server (PICS part 3); empty where nothing is said"),
    "additional_services": table(
        ADDITIONAL, clauses=("R-7.4.1.1-1", "R-9.4.2-1", "R-T14-1"),
        says="the role in which each additional service is supported (PICS part 5)"),
    "parameters": choices(
        list(words.BASE_PARAMETERS), words.PARAMETERS, clauses=("R-9.2.2.3-1", "R-9.2.2.2.2.2-2"),
        says="the parameter CBBs that are supported"),
    "nest": number(2, 0, clauses=("R-9.2.2.3-1",), says="how deep data may be nested"),
    "devices": tables(
        [], DEVICE, clauses=("R-6.3.4.1-1", "R-T15-2", "R-6.1.1-3", "R-6.2.1-1"),
        says="the devices that the state of the VMD reflects (PICS part 6); where nothing is said, the arms "
             "and their safety interlocks (domain R_SAFE)"),
    "first_step": text("", clauses=("R-T15-3",), says="what the first step is (PICS part 6)"),
    "orientation": text("", clauses=("R-T15-4", "R-8.4.2-1"), says="what the four numbers of R_OIS mean (PICS part 6)"),
    "program_location": text(
        "", clauses=("R-T15-5", "R-6.3.2.4-1", "R-7.3.3.9.2.5-1"), says="what a program location is (PICS part 6)"),
}  # fmt: skip
