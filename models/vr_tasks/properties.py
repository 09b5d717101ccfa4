"""What must hold of the two tasks together, stated from what each of their functions is for."""

from mmsverify.model import Always, Initially, Sometimes, Step, repaired, service_is, unchanged

from .vocabulary import Answer, Axis, Cmd02, Command, Control02, Mode, Vocabulary


class Properties(Vocabulary):
    """The same in both readings."""

    at_power_on = Initially(
        "V-TASK-1", (command() == Command.NONE) & (mode() == Mode.WAITING) & (axis() == Axis.IN_ORDER)
        & (cmd02() == Cmd02.SCAN) & (scanned() == Answer.SUCCESS) & (examined() == Answer.NO_COMMAND)
        & (error() == Answer.SUCCESS) & (warning() == Answer.NO_COMMAND) & (checked() == Command.NONE) & ~unheard()
        & (control02() == Control02.TAKE) & (acting() == Mode.WAITING))  # fmt: skip

    only_checked_is_done = Step("V-CMD02-2b", service_is("Cmd02.DoCmd") >> (command() == checked()), "V-CHK-0",
                                says="what DoCmd does is what CheckCmd has let through")  # fmt: skip
    never_forbidden = Always(
        "V-FUN-2", mode() != Mode.FORBIDDEN, says="no command that is not allowed brings about anything"
    )
    no_mode_is_lost = Step("V-CTL02-N", (service_is("Control02.SetNextMode") & (mode() != acting())) >> unchanged(mode), "V-CMD02-2c",
                           says="a mode that a command has set meanwhile is not overwritten by SetNextMode")  # fmt: skip
    no_command_is_lost = Step("V-CMD-N", (unheard() & service_is("operator", "Cmd02.DoCmd")) >> (unheard().next & (command().next == command())),
                              "V-CMD02-2", says="a command that has been written stands until CheckCmd has seen it")  # fmt: skip
    done_once = Step("V-DO-00", service_is("Cmd02.DoCmd") >> (command().next == Command.NONE), "V-CMD02-2a",
                     says="what has been done is not found again by the next check")  # fmt: skip

    axes_before_commands = Step("V-CMD02-1", ((cmd02().next == Cmd02.CHECK) & (cmd02() != Cmd02.CHECK)) >> service_is("Cmd02.ScanMIO"),
                                says="in each round the axes are looked at before a command is examined")  # fmt: skip
    each_round_is_published = Step("V-CMD02-3", ((cmd02().next == Cmd02.SCAN) & (cmd02() != Cmd02.SCAN)) >> service_is("Cmd02.publish"),
                                   says="no round ends without its findings being published")  # fmt: skip
    ids_tell_the_last_round = Always("V-CMD02-3", (cmd02() == Cmd02.SCAN) >> ((error() == scanned()) & (warning() == examined())), "VR-19",
                                     says="between two rounds CS_ErrId tells of the axes and CS_WarnId of the command")  # fmt: skip
    ids_stand_in_a_round = Step("V-CMD02-3", ~service_is("Cmd02.publish") >> unchanged(error, warning),
                                says="the two ids change at the end of a round only")  # fmt: skip

    scan = service_is("Cmd02.ScanMIO")
    alarm_is_named = Step("V-MIO-2", (scan & (axis() == Axis.ALARM)) >> (scanned().next == Answer.AXIS_ALARM),
                          says="ScanMIO names the alarm of a servo")  # fmt: skip
    positive_limit_is_named = Step("V-MIO-3", (scan & (axis() == Axis.POSITIVE_LIMIT)) >> (scanned().next == Answer.AXIS_POSITIVE_LIMIT),
                                   says="ScanMIO names the positive limit")  # fmt: skip
    negative_limit_is_named = Step("V-MIO-4", (scan & (axis() == Axis.NEGATIVE_LIMIT)) >> (scanned().next == Answer.AXIS_NEGATIVE_LIMIT),
                                   says="ScanMIO names the negative limit")  # fmt: skip
    emergency_is_named = Step("V-MIO-1", (scan & (axis() == Axis.EMERGENCY)) >> (scanned().next == Answer.AXIS_EMERGENCY), "V-MIO-5",
                              says="ScanMIO names the emergency input, the fourth that it looks at")  # fmt: skip
    success_means_in_order = Step("V-MIO-6", (scan & (scanned().next == Answer.SUCCESS)) >> (axis() == Axis.IN_ORDER), "V-MIO-1",
                                  says="ScanMIO returns ERR_Success only where no axis is in error")  # fmt: skip
    order_is_success = Step("V-MIO-6", (scan & (axis() == Axis.IN_ORDER)) >> (scanned().next == Answer.SUCCESS),
                            says="ScanMIO tells of no fault where there is none")  # fmt: skip
    unseen_changes_nothing = Step("V-CMD02-1", service_is("axes") >> unchanged(command, mode, scanned, examined, error, warning, cmd02),
                                  says="an input brings about nothing before ScanMIO has looked at it")  # fmt: skip

    check = service_is("Cmd02.CheckCmd")
    nothing_is_told = Step("V-CHK-1", check >> ((examined().next == Answer.NO_COMMAND) == (command() == Command.NONE)),
                           says="CheckCmd returns ERR_NoCommand for 0 and for nothing else")  # fmt: skip
    forbidden_is_told = Step("V-CHK-2", check >> ((examined().next == Answer.INVALID_OPERATION) == (command() == Command.REFUSED)),
                             says="CheckCmd returns ERR_InvalidOperation for what the mode forbids and for nothing else")  # fmt: skip
    unknown_is_told = Step("V-CHK-4", check >> ((examined().next == Answer.UNKNOWN_COMMAND) == (command() == Command.UNKNOWN)),
                           says="CheckCmd returns ERR_UnknowCommand for numbers outside the table and for nothing else")  # fmt: skip
    only_let_through_is_done = Step("V-CHK-5", ((cmd02().next == Cmd02.DO) & (cmd02() != Cmd02.DO)) >> (examined().next == Answer.SUCCESS), "V-CMD02-2b",
                                    says="DoCmd follows only where CheckCmd returns ERR_Success")  # fmt: skip
    checking_orders_nothing = Step("V-CHK-0", check >> unchanged(mode), "V-CMD02-2",
                                   says="an examination sets no mode")  # fmt: skip

    do = service_is("Cmd02.DoCmd")
    unknown_does_nothing = Step("V-DO-R1", (do & (command() == Command.UNKNOWN)) >> ((examined().next == Answer.UNKNOWN_COMMAND) & unchanged(mode)),
                                "V-DO-X", says="DoCmd answers ERR_UnknowCommand to such a number, and leaves the mode alone")  # fmt: skip
    known_is_done = Step("V-DO-R2", (do & (command() != Command.UNKNOWN)) >> (examined().next == Answer.SUCCESS),
                         says="DoCmd answers ERR_Success to any other command")  # fmt: skip
    begins_as_commanded = Step("V-DO-03", (do & (checked() == Command.BEGIN) & (command() == checked())) >> (mode().next == Mode.ACTING),
                               says="DoCmd sets the mode of the action that was commanded")  # fmt: skip
    stops_as_commanded = Step("V-DO-04", (do & (checked() == Command.STOP) & (command() == checked())) >> (mode().next == Mode.STOPPING),
                              says="DoCmd sets Stop where Stop was commanded")  # fmt: skip

    acts_upon_mode = Step("V-CTL02-1", service_is("Control02.SetPreMode") >> (acting().next == mode()), "V-PRE-0",
                          says="Control02 acts upon the mode that it finds")  # fmt: skip
    action_keeps_mode = Step("V-CTL02-2", service_is("Control02.SetPreMode", "Control02.action") >> unchanged(mode, command),
                             says="an action sets neither mode nor command")  # fmt: skip
    done_is_done = Step("V-CTL02-3", (service_is("Control02.SetNextMode") & (mode() == acting())) >> (mode().next == Mode.WAITING), "V-NEXT-N",
                        says="after an action that nothing has cut short the machine waits")  # fmt: skip
    round_of_control02 = Step("V-CTL02-N", (control02().next != control02()) >> service_is("Control02.SetPreMode", "Control02.action", "Control02.SetNextMode"),
                              says="Control02 goes on by its own steps only")  # fmt: skip

    begins = Sometimes("V-CTL02-2", acting() == Mode.ACTING)
    stops = Sometimes("V-DO-04", (mode() == Mode.STOPPING) & (acting() == Mode.ACTING))
    warns = Sometimes("V-CMD02-3", (warning() == Answer.UNKNOWN_COMMAND) & (error() == Answer.AXIS_ALARM))


class PropertiesRepaired(Properties):
    """The repaired reading."""

    what_is_checked_stands = Always(
        "V-CMD02-2", ((cmd02() == Cmd02.DO) >> ((command() == checked()) & ~unheard() & ((checked() == Command.BEGIN) | (checked() == Command.STOP))))
        & (acting() != Mode.FORBIDDEN) & (unheard() >> (command() != Command.NONE)), "VR-16",
        says="between CheckCmd and DoCmd the command stands, and is one that was let through",
        repairs=repaired("VR-16", "V-CMD02-2", because="stated for the operator that waits"))  # fmt: skip
