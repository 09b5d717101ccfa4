"""Cmd02: what CheckCmd lets through of VR(C_Cmd), and what DoCmd makes of it (sections on the two functions).

A refusal is ERR_InvalidOperation: nothing changes. Where only a reading forbids a command, it is a warning.
"""

from mmsverify.model import BOOL, Procedure, accept, do, if_, parameter, refuse, repaired, response

from .vocabulary import Mode, Vocabulary


class Commands(Vocabulary):
    """As written: only what the text itself says of the states in which a command is allowed."""

    left = [arrived().becomes(False)]
    runs = mode().isin([Mode.RUN, Mode.RUN_SUB])
    # SetNextMode knows modes by which an action is cut short; who sets them the text does not say.
    cuts_in = parameter("cuts_in", BOOL)

    home = Procedure("V-DO-01", on=response("home"), steps=[
        refuse("V-CHK-3", "V-CHK-2", when=runs, rule="home.while-running", says="Home while the automatic flow runs"),
        do("V-DO-01", mode().becomes(Mode.HOME), *left), accept("V-DO-01", "V-CMD-01"),
    ])  # fmt: skip
    org = Procedure("V-DO-02", on=response("org"), steps=[
        refuse("V-SM-5", "V-FUN-2", unless=homed(), rule="org.unhomed", says="Org of a machine that has not been homed"),
        do("V-DO-02", mode().becomes(Mode.ORG), *left), accept("V-DO-02", "V-CMD-02"),
    ])  # fmt: skip
    run = Procedure("V-DO-03", on=response("run"), steps=[
        refuse("V-FUN-2", "V-CHK-2", unless=mode() == Mode.ORG_RDY, rule="run.not-ready", says="Run outside OrgRdy"),
        do("V-DO-03", mode().becomes(Mode.RUN), paused().becomes(False)), accept("V-DO-03", "V-CMD-03"),
    ])  # fmt: skip
    stop = Procedure("V-DO-04", on=response("stop", cuts_in), steps=[
        do("V-DO-04", mode().becomes(if_(cuts_in, Mode.STOP_INSERT, Mode.STOP)), paused().becomes(False), *left), accept("V-DO-04", "V-CMD-04"),
    ])  # fmt: skip
    pause = Procedure("V-DO-05", on=response("pause"), steps=[
        do("V-DO-05", paused().becomes(mode() == Mode.RUN)), accept("V-DO-05", "V-CMD-05", "V-RUN-3"),
    ])  # fmt: skip
    step = Procedure("V-DO-06", on=response("step"), steps=[
        do("V-DO-06", paused().becomes(mode() == Mode.RUN)), accept("V-DO-06", "V-CMD-06", "V-RUN-2"),
    ])  # fmt: skip
    resume = Procedure("V-DO-07", on=response("resume"), steps=[
        do("V-DO-07", paused().becomes(False)), accept("V-DO-07", "V-CMD-07"),
    ])  # fmt: skip
    serious = [
        mode().becomes(if_(cuts_in, Mode.ERR_B_INSERT, Mode.ERR_B)),
        paused().becomes(False),
        lost().becomes(True),
        *left,
    ]
    on_serious_error = Procedure("V-DO-08", on=response("onErrB", cuts_in), steps=[
        do("V-DO-08", *serious), accept("V-DO-08", "V-CMD-08", "V-SM-ErrB"),
    ])  # fmt: skip
    on_general_error = Procedure("V-DO-09", on=response("onErrS", cuts_in), steps=[
        do("V-DO-09", mode().becomes(if_(cuts_in, Mode.ERR_S_INSERT, Mode.ERR_S)), paused().becomes(False), *left), accept("V-DO-09", "V-CMD-09", "V-SM-ErrS"),
    ])  # fmt: skip
    cleared = [mode().becomes(if_((mode() == Mode.ERR_S) & homed(), Mode.HOME_RDY, Mode.DBG_RDY))]
    reset_error = Procedure("V-DO-10a", on=response("resetErr"), steps=[
        refuse("V-CHK-2", unless=mode().isin([Mode.ERR_B, Mode.ERR_S]), rule="reset.no-error", says="ResetErr without an error"),
        do("V-DO-10a", *cleared, cites=["V-DO-10b", "V-DO-10c", "V-SM-3", "V-SM-4"]),
        accept("V-DO-10a", "V-CMD-10", "V-DEV-3", "V-DEV-4"),
    ])  # fmt: skip


class CommandsRepaired(Commands):
    """The repaired reading: each command has its states, and a serious error clears CF_Home."""

    home = Procedure("V-DO-01", on=response("home"), steps=[
        refuse("V-CHK-3", "V-CHK-2", when=runs, rule="home.while-running", says="Home while the automatic flow runs"),
        refuse("V-CHK-2", "VR-01", unless=waits(), rule="home.not-waiting", level="warning", says="Home outside DbgRdy, HomeRdy and OrgRdy"),
        do("V-DO-01", mode().becomes(Mode.HOME), *left), accept("V-DO-01", "V-CMD-01"),
    ], repairs=repaired("VR-01", "V-CHK-2", because="the diagram that tells where Home is allowed is lost"))  # fmt: skip
    org = Procedure("V-DO-02", on=response("org"), steps=[
        refuse("V-SM-5", "V-FUN-2", when=~homed() | lost(), rule="org.unhomed", says="Org of a machine that has not been homed since power-on or a serious error"),
        refuse("V-CHK-2", "VR-02", unless=mode().isin([Mode.HOME_RDY, Mode.ORG_RDY]), rule="org.not-ready", level="warning",
               says="Org outside HomeRdy and OrgRdy"),
        do("V-DO-02", mode().becomes(Mode.ORG), *left), accept("V-DO-02", "V-CMD-02"),
    ], repairs=repaired("VR-02", "V-CHK-2", because="the diagram that tells where Org is allowed is lost"))  # fmt: skip
    stop = Procedure("V-DO-04", on=response("stop", cuts_in), steps=[
        refuse("V-CHK-2", "VR-03", unless=acts_by_itself(), rule="stop.nothing-runs", level="warning", says="Stop where no action runs"),
        do("V-DO-04", mode().becomes(if_(cuts_in, Mode.STOP_INSERT, Mode.STOP)), paused().becomes(False), *left), accept("V-DO-04", "V-CMD-04"),
    ], repairs=repaired("VR-03", "V-CHK-2", because="in a waiting state, and in an error, there is nothing to stop"))  # fmt: skip
    pause = Procedure("V-DO-05", on=response("pause"), steps=[
        refuse("V-CHK-2", "VR-04", unless=mode() == Mode.RUN, rule="pause.not-running", level="warning", says="Pause outside Run"),
        do("V-DO-05", paused().becomes(True)), accept("V-DO-05", "V-CMD-05", "V-RUN-3"),
    ], repairs=repaired("VR-04", "V-CHK-2", because="only the automatic flow pauses"))  # fmt: skip
    step = Procedure("V-DO-06", on=response("step"), steps=[
        refuse("V-CHK-2", "VR-05", unless=mode() == Mode.RUN, rule="step.not-running", level="warning", says="Step outside Run"),
        do("V-DO-06", paused().becomes(True)), accept("V-DO-06", "V-CMD-06", "V-RUN-2"),
    ], repairs=repaired("VR-05", "V-CHK-2", because="only the automatic flow goes step by step"))  # fmt: skip
    resume = Procedure("V-DO-07", on=response("resume"), steps=[
        refuse("V-CHK-2", "VR-05", unless=(mode() == Mode.RUN) & paused(), rule="resume.not-paused", level="warning", says="Resume of a flow that is not paused"),
        do("V-DO-07", paused().becomes(False)), accept("V-DO-07", "V-CMD-07"),
    ], repairs=repaired("VR-05", "V-CHK-2", because="only a paused flow can be resumed"))  # fmt: skip
    on_serious_error = Procedure("V-DO-08", on=response("onErrB", cuts_in), steps=[
        do("V-DO-08", *serious, homed().becomes(False), cites=["V-SM-5"]), accept("V-DO-08", "V-CMD-08", "V-SM-ErrB"),
    ], repairs=repaired("VR-08", "V-DO-08", "V-SM-5", because="otherwise a Stop leads to HomeRdy, and on to Org, without a new Home"))  # fmt: skip
    reset_error = Procedure("V-DO-10a", on=response("resetErr"), steps=[
        refuse("V-CHK-2", "VR-06", unless=mode().isin([Mode.ERR_B, Mode.ERR_S]), rule="reset.no-error", level="warning", says="ResetErr without an error"),
        do("V-DO-10a", *cleared, cites=["V-DO-10b", "V-DO-10c", "V-SM-3", "V-SM-4"]), accept("V-DO-10a", "V-CMD-10", "V-DEV-3", "V-DEV-4"),
    ], repairs=repaired("VR-06", "V-CHK-2", because="where there is no error there is nothing to clear"))  # fmt: skip
