"""The rounds of the two tasks: what comes in which order, and who writes C_Cmd (sections on the two main flows)."""

from mmsverify.model import Always, Sometimes, Step, repaired, service_is

from .vocabulary import Answer, Axis, Cmd02, Command, Control02, Vocabulary


class Rounds(Vocabulary):
    """The same in both readings."""

    axes_come_first = Step("V-CMD02-1", service_is("Cmd02.ScanMIO") >> ((cmd02() == Cmd02.SCAN) & (cmd02().next == Cmd02.CHECK)), "V-TASK-1",
                           says="a round of Cmd02 begins with the axes, and goes on to the command")  # fmt: skip
    command_comes_next = Step("V-CMD02-2", service_is("Cmd02.CheckCmd") >> ((cmd02() == Cmd02.CHECK) & cmd02().next.isin([Cmd02.DO, Cmd02.PUBLISH])),
                              says="the command is examined once a round, then it is done or the round ends")  # fmt: skip
    doing_comes_after = Step("V-CMD02-2c", service_is("Cmd02.DoCmd") >> ((cmd02() == Cmd02.DO) & (cmd02().next == Cmd02.PUBLISH)),
                             says="DoCmd comes after CheckCmd, once a round")  # fmt: skip
    publishing_ends_a_round = Step("V-CMD02-3", service_is("Cmd02.publish") >> ((cmd02() == Cmd02.PUBLISH) & (cmd02().next == Cmd02.SCAN)), "V-TASK-1",
                                   says="a round of Cmd02 ends with the two ids, and the next one begins")  # fmt: skip
    only_cmd02_goes_on = Step("V-TASK-1", (cmd02().next != cmd02()) >> service_is("Cmd02.ScanMIO", "Cmd02.CheckCmd", "Cmd02.DoCmd", "Cmd02.publish"),
                              says="Cmd02 goes on by its own steps only")  # fmt: skip

    status_comes_first = Step("V-CTL02-1", service_is("Control02.SetPreMode") >> ((control02() == Control02.TAKE) & (control02().next == Control02.ACT)),
                              says="a round of Control02 begins with the status")  # fmt: skip
    action_comes_next = Step("V-CTL02-2", service_is("Control02.action") >> ((control02() == Control02.ACT) & (control02().next == Control02.NEXT)),
                             says="after the status comes the action")  # fmt: skip
    next_mode_ends_a_round = Step("V-CTL02-3", service_is("Control02.SetNextMode") >> ((control02() == Control02.NEXT) & (control02().next == Control02.TAKE)), "V-TASK-1",
                                  says="a round of Control02 ends with the next mode, and the next one begins")  # fmt: skip

    commands_come_from_outside = Step("V-CMD-N", (command().next != command()) >> (service_is("operator") | (command().next == Command.NONE)), "V-CMD02-2a",
                                      says="no task makes a command of its own: it only clears the cell")  # fmt: skip
    new_command_is_unheard = Step("V-CMD-N", service_is("operator") >> unheard().next, "V-CMD02-2",
                                  says="a command that has just been written has not been examined")  # fmt: skip
    done_after_success = Always("V-CHK-5", (cmd02() == Cmd02.DO) >> (examined() == Answer.SUCCESS), says="what is to be done has been examined, with success")  # fmt: skip
    lets_nothing_else_through = Always("V-CHK-5", checked().isin([Command.NONE, Command.BEGIN, Command.STOP]), "V-CHK-2", "V-CHK-4",
                                       says="CheckCmd lets only commands through that are known and allowed")  # fmt: skip

    emergency = Sometimes("V-MIO-1", axis() == Axis.EMERGENCY)


class RoundsRepaired(Rounds):
    """The repaired reading."""

    refused_is_cleared = Step("V-CMD-N", (service_is("Cmd02.CheckCmd") & command().isin([Command.REFUSED, Command.UNKNOWN])) >> (command().next == Command.NONE), "VR-16",
                              says="a command that is refused makes room for the next one",
                              repairs=repaired("VR-16", "V-CMD-N", because="otherwise an operator who waits for 0 waits for ever"))  # fmt: skip
