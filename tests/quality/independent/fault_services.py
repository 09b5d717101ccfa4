"""Faults: a service is accepted in a wrong state, or by who may not ask; or refused for nothing."""

from __future__ import annotations

from independent import views
from independent.desk import (
    Desk,
    altering,
    control,
    creation,
    download,
    loading,
    named,
    starting,
    writing,
)
from independent.fault import add, fault
from independent.objects import CONFLICT, UNKNOWN
from independent.server import positive
from independent.situations import normal
from independent.wrongly import CTRL, SEVERAL, Ask, refusing, wrongly

# Services in the wrong state of the program: part 1's machine.
ADMITTED = {
    "start": {"idle"}, "stop": {"running"}, "resume": {"stopped"}, "reset": {"stopped"},
    "deleteProgramInvocation": {"idle", "stopped", "unrunnable"},
}  # fmt: skip
STEPS = {
    "start": "R-7.3.3.3.3-*", "stop": "R-7.3.3.4.1-*", "resume": "R-7.3.3.5.3-*", "reset": "R-7.3.3.6.1-*",
    "deleteProgramInvocation": "R-7.3.3.8.1-*",
}  # fmt: skip
for _service, _states in ADMITTED.items():
    _body = "COUNT" if _service == "deleteProgramInvocation" else named("COUNT")
    for _state in ("idle", "running", "stopped", "unrunnable"):
        if _state == "running" and _service in ("start", "deleteProgramInvocation", "stop"):
            continue  # it may just have ended by itself
        if _state not in _states:
            add(f"{_service}_{_state}", wrongly(normal(_state), _service, _body), "B-*", STEPS[_service])
        else:
            run = refusing(normal(_state), CONFLICT, _service, _body)
            add(f"refused_{_service}_{_state}", run, "*", level="any")
    _missing = "NONE" if _service == "deleteProgramInvocation" else named("NONE")
    add(
        f"{_service}_unknown",
        wrongly(lambda d: d.absent("NONE"), _service, _missing, why="unknown"),
        "B-*",
        "RP-14",
        STEPS[_service],
    )
add(
    "kill_unknown",
    wrongly(lambda d: d.absent("NONE"), "kill", named("NONE")),
    "B-*",
    "RP-14",
    "R-7.3.3.7.1-*",
)
add("kill_refused", refusing(normal("running"), CONFLICT, "kill", named("COUNT")), "*", level="any")
add(
    "attributes_refused",
    refusing(normal("idle"), UNKNOWN, "getProgramInvocationAttributes", "COUNT"),
    "*",
    level="any",
)

# Without R_CTRL.
GUARDED: dict[str, tuple[Ask, str]] = {
    "start": (("start", named("PAINT"), starting()), "R-7.3.3.3.3-b"),
    "stop": (("stop", named("COUNT"), None), "R-7.3.3.4.1-b"),
    "resume": (("resume", named("HOLD"), None), "R-7.3.3.5.3-b"),
    "reset": (("reset", named("HOLD"), None), "R-7.3.3.6.1-b"),
    "kill": (("kill", named("COUNT"), None), "R-7.3.3.7.1-b"),
    "delete": (("deleteProgramInvocation", "HOLD", None), "R-7.3.3.8.1-b"),
    "select": (("select", {}, None), "R-7.4.4.2-a"),
    "alter": (("alterPI", altering("PAINT", "cycleCount", 2), None), "R-7.4.5.2-a"),
    "vmd_stop": (("vMDStop", None, None), "R-7.4.2.2-1"),
    "vmd_reset": (("vMDReset", False, None), "R-7.4.3.2-a"),
}


def shop(d: Desk) -> None:
    """Programs in every state; whoever set it up holds R_CTRL."""
    if d.robot.several:
        d.does("takeControl", control())
    for name in ("COUNT", "HOLD"):
        d.create(name, 0)
        d.run("start", name)
    d.run("stop", "HOLD")
    d.ready("PAINT")


def elsewhere(d: Desk) -> None:
    """The same, and R_CTRL was given back."""
    shop(d)
    d.does("relinquishControl", CTRL)
    d.look()


def of_another(d: Desk) -> None:
    """The same, and another client has taken R_CTRL."""
    elsewhere(d)
    other = Desk(d.tape, d.robot, "other").open()
    other.does("takeControl", control())
    other.look()


for _name, (_ask, _clause) in GUARDED.items():
    for _where, _come in (("free", elsewhere), ("taken", of_another)):
        add(
            f"without_control_{_name}_{_where}", wrongly(_come, *_ask, why="control"), _clause, "R-5.1.3-2",
            "R-5.3.1.2-1", "R-8.6.1*", robot=SEVERAL,
        )  # fmt: skip

# Local control (3.2.1, RP-10), intervention (5.3.1.3.3.13, Table 8), logical status.
CHANGES: dict[str, Ask] = {
    **{name: ask for name, (ask, _) in GUARDED.items()},
    "create": ("createProgramInvocation", creation("NEW"), None),
    "write": ("write", writing("Part_Count", ("integer", 3)), None),
    "download": ("initiateDownloadSequence", download("EXTRA"), None),
    "load": ("loadDomainContent", loading("EXTRA"), None),
    "delete_domain": ("deleteDomain", "NEW", None),
}


def local(d: Desk) -> None:
    d.download("NEW")
    shop(d)
    d.panel(local=True)
    d.status()


def stopped(d: Desk) -> None:
    d.download("NEW")
    shop(d)
    d.does("vMDStop")
    d.status()
    d.look()


for _name, _ask in CHANGES.items():
    _gives = {"write": [("success", None)]}.get(_name)
    add(
        f"local_{_name}",
        wrongly(local, *_ask, gives=_gives),
        "R-3.2.1-1",
        "R-T1-1",
        "R-6.2.1-6",
        "R-5.3.1.4*",
        "B-*",
        "RP-10",
        "RP-11",
    )
    if _name != "vmd_stop":
        add(
            f"intervention_{_name}", wrongly(stopped, *_ask, gives=_gives), "R-5.3.1.3.3.13*", "R-5.3.1.3.2.6*", "R-T1*", "R-T8*",
            "R-7.4.2.2-5", "R-6.3.4.7*", "B-*", "RP-09", "RP-11", STEPS.get(_ask[0], "RP-09"),
        )  # fmt: skip


def limited(d: Desk) -> None:
    """Local control with LIMITED-SERVICES-PERMITTED."""
    shop(d)
    d.robot.local, d.robot.logical = True, 2
    d.unasked()


@fault("B-*", "RP-11", "R-T1*", level="any")
def limited_attributes(d: Desk) -> None:
    limited(d)
    asked = d.request("getProgramInvocationAttributes", "R_CAL")
    body, detail = views.program(d.robot, "R_CAL")
    d.say("server", positive(asked, body, detail))
    d.tape.wrong()
