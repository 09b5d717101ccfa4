"""Cmd02, one round: ScanMIO, CheckCmd, DoCmd if the command is let through, then the two ids (its main flow).

An operator writes VR(C_Cmd), and the inputs of the axes change, whenever they like.
"""

from mmsverify.model import Removed, Transition, Unspecified, if_, internal, repaired

from .vocabulary import Answer, Axis, Cmd02, Command, Mode, Vocabulary


class CommandTask(Vocabulary):
    """As written: DoCmd reads C_Cmd again, and a negative limit has two names."""

    inputs = Transition("V-MIO-1", on=internal("axes", seen), then=[axis().becomes(seen)])
    operator = Transition("V-CMD-N", on=internal("operator", new), when=[new != Command.NONE],
                          then=[command().becomes(new), unheard().becomes(True)])  # fmt: skip
    who_clears = Unspecified(
        "V-CMD-N", says="nobody is told to clear VR(C_Cmd): here DoCmd does, and CheckCmd where it refuses"
    )

    scans = [cmd02() == Cmd02.SCAN]
    scan_ends = [cmd02().becomes(Cmd02.CHECK)]
    finds_alarm = Transition("V-MIO-2", "V-CMD02-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.ALARM],
                             then=[*scan_ends, scanned().becomes(Answer.AXIS_ALARM)])  # fmt: skip
    finds_positive_limit = Transition("V-MIO-3", "V-CMD02-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.POSITIVE_LIMIT],
                                      then=[*scan_ends, scanned().becomes(Answer.AXIS_POSITIVE_LIMIT)])  # fmt: skip
    finds_negative_limit = Transition("V-MIO-4", "V-CMD02-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.NEGATIVE_LIMIT],
                                      then=[*scan_ends, scanned().becomes(Answer.AXIS_NEGATIVE_LIMIT)])  # fmt: skip
    finds_emergency = Transition("V-MIO-5", "V-CMD02-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.NEGATIVE_LIMIT],
                                 then=[*scan_ends, scanned().becomes(Answer.AXIS_EMERGENCY)])  # fmt: skip
    finds_no_name = Transition(
        "V-MIO-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.EMERGENCY], then=scan_ends
    )
    finds_axes_in_order = Transition("V-MIO-6", "V-CMD02-1", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.IN_ORDER],
                                     then=[*scan_ends, scanned().becomes(Answer.SUCCESS)])  # fmt: skip

    checks = [cmd02() == Cmd02.CHECK]
    check_ends = [cmd02().becomes(Cmd02.PUBLISH), command().becomes(Command.NONE), unheard().becomes(False)]
    finds_nothing = Transition("V-CHK-1", "V-CMD02-2a", on=internal("Cmd02.CheckCmd"), when=[*checks, command() == Command.NONE],
                               then=[*check_ends, examined().becomes(Answer.NO_COMMAND)])  # fmt: skip
    refuses = Transition("V-CHK-2", "V-CMD02-2b", on=internal("Cmd02.CheckCmd"), when=[*checks, command() == Command.REFUSED],
                         then=[*check_ends, examined().becomes(Answer.INVALID_OPERATION)])  # fmt: skip
    does_not_know = Transition("V-CHK-4", "V-CMD02-2b", on=internal("Cmd02.CheckCmd"), when=[*checks, command() == Command.UNKNOWN],
                               then=[*check_ends, examined().becomes(Answer.UNKNOWN_COMMAND)])  # fmt: skip
    lets_through = Transition("V-CHK-5", "V-CMD02-2", on=internal("Cmd02.CheckCmd"),
                              when=[*checks, (command() == Command.BEGIN) | (command() == Command.STOP)],
                              then=[cmd02().becomes(Cmd02.DO), checked().becomes(command()), unheard().becomes(False),
                                    examined().becomes(Answer.SUCCESS)])  # fmt: skip

    def _target(of):  # noqa: N805 - made while the class body is read
        return if_(of == Command.BEGIN, Mode.ACTING, if_(of == Command.STOP, Mode.STOPPING, Mode.FORBIDDEN))

    def _known(of):  # noqa: N805
        return of != Command.UNKNOWN

    do_ends = [cmd02().becomes(Cmd02.PUBLISH), command().becomes(Command.NONE)]
    does = Transition("V-CMD02-2c", "V-DO-03", "V-DO-04", "V-DO-R2", on=internal("Cmd02.DoCmd"), when=[cmd02() == Cmd02.DO, _known(command())],
                      then=[*do_ends, mode().becomes(_target(command())), unheard().becomes(False), examined().becomes(Answer.SUCCESS)])  # fmt: skip
    does_nothing = Transition("V-DO-R1", "V-DO-X", on=internal("Cmd02.DoCmd"), when=[cmd02() == Cmd02.DO, ~_known(command())],
                              then=[*do_ends, unheard().becomes(False), examined().becomes(Answer.UNKNOWN_COMMAND)])  # fmt: skip

    publishes = Transition("V-CMD02-3", "VR-19", on=internal("Cmd02.publish"), when=[cmd02() == Cmd02.PUBLISH],
                           then=[cmd02().becomes(Cmd02.SCAN), error().becomes(scanned()), warning().becomes(examined())])  # fmt: skip


class CommandTaskRepaired(CommandTask):
    """The repaired reading: what was checked is done, each input has its name, and the operator waits."""

    operator = Transition(
        "V-CMD-N", "VR-16", on=internal("operator", new), when=[new != Command.NONE, command() == Command.NONE],
        then=[command().becomes(new), unheard().becomes(True)],
        repairs=repaired("VR-16", "V-CMD-N", because="a command written over another one is lost"))  # fmt: skip
    misprint = repaired(
        "VR-15", "V-MIO-5", because="as printed an emergency input has no name, and a negative limit two"
    )
    finds_emergency = Transition("V-MIO-5", "V-CMD02-1", "VR-15", on=internal("Cmd02.ScanMIO"), when=[*scans, axis() == Axis.EMERGENCY],
                                 then=[*scan_ends, scanned().becomes(Answer.AXIS_EMERGENCY)], repairs=misprint)  # fmt: skip
    finds_no_name = Removed(repairs=misprint)
    as_checked = repaired(
        "VR-17", "V-CMD02-2c", because="between CheckCmd and DoCmd the cell may be written again"
    )
    does = Transition(
        "V-CMD02-2c", "V-DO-03", "V-DO-04", "V-DO-R2", "VR-17", on=internal("Cmd02.DoCmd"), when=[cmd02() == Cmd02.DO, _known(checked())],
        then=[*do_ends, mode().becomes(_target(checked())), examined().becomes(Answer.SUCCESS)], repairs=as_checked)  # fmt: skip
    does_nothing = Transition(
        "V-DO-R1", "V-DO-X", "VR-17", on=internal("Cmd02.DoCmd"), when=[cmd02() == Cmd02.DO, ~_known(checked())],
        then=[*do_ends, examined().becomes(Answer.UNKNOWN_COMMAND)], repairs=as_checked)  # fmt: skip
