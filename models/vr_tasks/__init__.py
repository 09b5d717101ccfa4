"""The two tasks of the VR template framework, step by step over the cells that they share.

Cmd02 checks C_Cmd and sets C_RunMD; Control02 takes C_RunMD over, acts, and sets the next one; an operator writes C_Cmd
whenever he likes. Each step of a task is one row, so that a run is an interleaving. Which commands are allowed in which
mode is the model vr-template's; here there are four that tell the races apart: one that begins an action, Stop, one that
is refused, and none.
"""

from mmsverify.model import (
    Always,
    Enumeration,
    Initially,
    Model,
    Relation,
    Sometimes,
    Step,
    Transition,
    Unspecified,
    Variable,
    if_,
    internal,
    parameter,
    repaired,
    service_is,
    unchanged,
)


class Command(Enumeration):
    """VR(C_Cmd): no command, one that begins an action, Stop, one that CheckCmd refuses."""

    NONE = "NO_CMD"
    BEGIN = "Run"
    STOP = "Stop"
    REFUSED = "not allowed"


class Mode(Enumeration):
    """VR(C_RunMD): waiting, acting, stopping, and what a command that is not allowed would bring about."""

    WAITING = "OrgRdy"
    ACTING = "Run"
    STOPPING = "Stop"
    FORBIDDEN = "forbidden"


class Cmd02(Enumeration):
    """What the command task does next."""

    CHECK = "CheckCmd"
    DO = "DoCmd"


class Control02(Enumeration):
    """What the action task does next."""

    TAKE = "SetPreMode"
    ACT = "the action"
    NEXT = "SetNextMode"


STANDARD = "template framework 1.0"
VIEWS = {"Cmd02": "cmd02", "Control02": "control02", "mode": "mode"}


class AsWritten(Model, name="vr-tasks", variant="as-written", standard=STANDARD, views=VIEWS):
    """The text as it stands: DoCmd reads C_Cmd again, and SetNextMode writes C_RunMD whatever stands there."""

    command = Variable(Command, doc="VR(C_Cmd)")
    mode = Variable(Mode, doc="VR(C_RunMD)")
    cmd02 = Variable(Cmd02)
    control02 = Variable(Control02)
    checked = Variable(Command, doc="what CheckCmd has let through")
    acting = Variable(Mode, doc="the mode that Control02 acts upon")
    unheard = Relation(doc="a command has been written that CheckCmd has not seen")

    def _target(of):  # noqa: N805 - made while the class body is read
        return if_(of == Command.BEGIN, Mode.ACTING, if_(of == Command.STOP, Mode.STOPPING, Mode.FORBIDDEN))

    def _next(of):  # noqa: N805
        return if_(of == Mode.FORBIDDEN, Mode.FORBIDDEN, Mode.WAITING)

    new = parameter("new", Command)
    at_power_on = Initially("V-TASK-1", (command() == Command.NONE) & (mode() == Mode.WAITING) & (cmd02() == Cmd02.CHECK)
                            & (control02() == Control02.TAKE) & (checked() == Command.NONE) & (acting() == Mode.WAITING) & ~unheard())  # fmt: skip
    who_clears = Unspecified(
        "V-CMD-N", says="nobody is told to clear VR(C_Cmd): here DoCmd does, and CheckCmd where it refuses"
    )

    operator = Transition("V-CMD-N", on=internal("operator", new), when=[new != Command.NONE],
                          then=[command().becomes(new), unheard().becomes(True)])  # fmt: skip

    finds_nothing = Transition(
        "V-CHK-1",
        "V-CMD02-2a",
        on=internal("Cmd02"),
        when=[cmd02() == Cmd02.CHECK, command() == Command.NONE],
    )
    refuses = Transition("V-CHK-2", "V-CMD02-2b", on=internal("Cmd02"), when=[cmd02() == Cmd02.CHECK, command() == Command.REFUSED],
                         then=[command().becomes(Command.NONE), unheard().becomes(False)])  # fmt: skip
    lets_through = Transition("V-CHK-5", "V-CMD02-2", on=internal("Cmd02"),
                              when=[cmd02() == Cmd02.CHECK, (command() == Command.BEGIN) | (command() == Command.STOP)],
                              then=[cmd02().becomes(Cmd02.DO), checked().becomes(command()), unheard().becomes(False)])  # fmt: skip
    does = Transition("V-CMD02-2c", "V-DO-03", "V-DO-04", on=internal("DoCmd"), when=[cmd02() == Cmd02.DO],
                      then=[mode().becomes(_target(command())), command().becomes(Command.NONE), unheard().becomes(False),
                            cmd02().becomes(Cmd02.CHECK)])  # fmt: skip

    takes = Transition("V-CTL02-1", "V-PRE-0", on=internal("Control02"), when=[control02() == Control02.TAKE],
                       then=[acting().becomes(mode()), control02().becomes(Control02.ACT)])  # fmt: skip
    acts = Transition("V-CTL02-2", on=internal("Control02"), when=[control02() == Control02.ACT],
                      then=[control02().becomes(Control02.NEXT)])  # fmt: skip
    goes_on = Transition("V-CTL02-3", "V-NEXT-N", on=internal("SetNextMode"), when=[control02() == Control02.NEXT],
                         then=[mode().becomes(_next(acting())), control02().becomes(Control02.TAKE)])  # fmt: skip

    only_checked_is_done = Step("V-CMD02-2b", service_is("DoCmd") >> (command() == checked()), "V-CHK-0",
                                says="what DoCmd does is what CheckCmd has let through")  # fmt: skip
    never_forbidden = Always(
        "V-FUN-2", mode() != Mode.FORBIDDEN, says="no command that is not allowed brings about anything"
    )
    no_mode_is_lost = Step("V-CTL02-N", (service_is("SetNextMode") & (mode() != acting())) >> unchanged(mode), "V-CMD02-2c",
                           says="a mode that a command has set meanwhile is not overwritten by SetNextMode")  # fmt: skip
    no_command_is_lost = Step("V-CMD-N", (unheard() & service_is("operator", "DoCmd")) >> (unheard().next & (command().next == command())),
                              "V-CMD02-2", says="a command that has been written stands until CheckCmd has seen it")  # fmt: skip
    done_once = Step("V-DO-00", service_is("DoCmd") >> (command().next == Command.NONE), "V-CMD02-2a",
                     says="what has been done is not found again by the next check")  # fmt: skip

    begins = Sometimes("V-CTL02-2", acting() == Mode.ACTING)
    stops = Sometimes("V-DO-04", (mode() == Mode.STOPPING) & (acting() == Mode.ACTING))


class Repaired(AsWritten, name="vr-tasks", variant="repaired", standard=STANDARD, views=VIEWS):
    """The repaired reading: what was checked is done, what was set meanwhile stands, and the operator waits."""

    operator = Transition(
        "V-CMD-N", "VR-16", on=internal("operator", new), when=[new != Command.NONE, command() == Command.NONE],
        then=[command().becomes(new), unheard().becomes(True)],
        repairs=repaired("VR-16", "V-CMD-N", because="a command written over another one is lost"))  # fmt: skip
    does = Transition(
        "V-CMD02-2c", "V-DO-03", "V-DO-04", "VR-17", on=internal("DoCmd"), when=[cmd02() == Cmd02.DO],
        then=[mode().becomes(_target(checked())), command().becomes(Command.NONE), cmd02().becomes(Cmd02.CHECK)],
        repairs=repaired("VR-17", "V-CMD02-2c", because="between CheckCmd and DoCmd the cell may be written again"))  # fmt: skip
    goes_on = Transition(
        "V-CTL02-3", "V-NEXT-N", "VR-18", on=internal("SetNextMode"), when=[control02() == Control02.NEXT],
        then=[mode().becomes(if_(mode() == acting(), _next(acting()), mode())), control02().becomes(Control02.TAKE)],
        repairs=repaired("VR-18", "V-NEXT-N", because="a Stop that comes during the action would be overwritten"))  # fmt: skip
    what_is_checked_stands = Always(
        "V-CMD02-2", ((cmd02() == Cmd02.DO) >> ((command() == checked()) & ~unheard() & ((checked() == Command.BEGIN) | (checked() == Command.STOP))))
        & (acting() != Mode.FORBIDDEN) & (unheard() >> (command() != Command.NONE)), "VR-16",
        says="between CheckCmd and DoCmd the command stands, and is one that was let through",
        repairs=repaired("VR-16", "V-CMD02-2", because="stated for the operator that waits"))  # fmt: skip
