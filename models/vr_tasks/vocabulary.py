"""What the two tasks share, and where each of them stands.

Which commands are allowed in which mode is the model vr-template's; here there are five that tell the races apart.
"""

from mmsverify.model import Enumeration, Model, Relation, Variable, parameter


class Command(Enumeration):
    """VR(C_Cmd): no command, one that begins an action, Stop, one that the mode forbids, one outside the numbers."""

    NONE = "NO_CMD"
    BEGIN = "Run"
    STOP = "Stop"
    REFUSED = "not allowed"
    UNKNOWN = "unknown"


class Mode(Enumeration):
    """VR(C_RunMD): waiting, acting, stopping, and what a command that is not allowed would bring about."""

    WAITING = "OrgRdy"
    ACTING = "Run"
    STOPPING = "Stop"
    FORBIDDEN = "forbidden"


class Axis(Enumeration):
    """The inputs of the axes that ScanMIO looks at, the first that is on."""

    IN_ORDER = "in order"
    ALARM = "ALM"
    POSITIVE_LIMIT = "PEL"
    NEGATIVE_LIMIT = "NEL"
    EMERGENCY = "EMG"


class Answer(Enumeration):
    """What ScanMIO, CheckCmd and DoCmd return."""

    SUCCESS = "ERR_Success"
    AXIS_ALARM = "ERR_AxisAlmError"
    AXIS_POSITIVE_LIMIT = "ERR_AxisPelError"
    AXIS_NEGATIVE_LIMIT = "ERR_AxisNelError"
    AXIS_EMERGENCY = "ERR_AxisEmgError"
    NO_COMMAND = "ERR_NoCommand"
    INVALID_OPERATION = "ERR_InvalidOperation"
    UNKNOWN_COMMAND = "ERR_UnknowCommand"


class Cmd02(Enumeration):
    """What the command task does next."""

    SCAN = "ScanMIO"
    CHECK = "CheckCmd"
    DO = "DoCmd"
    PUBLISH = "publish"


class Control02(Enumeration):
    """What the action task does next."""

    TAKE = "SetPreMode"
    ACT = "the action"
    NEXT = "SetNextMode"


class Vocabulary(Model):
    """Variables; no rows."""

    axis = Variable(Axis, doc="what the inputs of the axes say")
    command = Variable(Command, doc="VR(C_Cmd)", cites=["V-CMD-N"])
    mode = Variable(Mode, doc="VR(C_RunMD)")
    warning = Variable(Answer, doc="VR(CS_WarnId)")
    error = Variable(Answer, doc="VR(CS_ErrId)")

    cmd02 = Variable(Cmd02)
    scanned = Variable(Answer, doc="what ScanMIO has returned in this round")
    examined = Variable(Answer, doc="what CheckCmd, or DoCmd after it, has returned in this round")
    checked = Variable(Command, doc="what CheckCmd has let through")
    unheard = Relation(doc="a command has been written that CheckCmd has not seen")

    control02 = Variable(Control02)
    acting = Variable(Mode, doc="the mode that Control02 acts upon")

    new = parameter("new", Command)
    seen = parameter("seen", Axis)
