"""What a request may touch: signals by class, dedicated signals, registers (sections 2.2 and 2.3).

The text says which function codes belong to which signals, and that the robot stops where a number is beyond
its class or a dedicated signal is written. How a client is told so the text leaves open.
"""

from mmsverify.model import (
    Always,
    Procedure,
    Step,
    accept,
    answered,
    do,
    refuse,
    repaired,
    response,
    service_is,
    unchanged,
)

from .vocabulary import COILS, WORDS, WRITES, Function, Points, Vocabulary


class Access(Vocabulary):
    """As written: nothing is refused."""

    written = function.isin(WRITES)
    harm = (points == Points.BEYOND) | (written & points.isin([Points.DEDICATED, Points.INPUT]))
    request = Procedure("M-2.2-8", on=response("request", function, points, sound), steps=[
        do("M-2.3.2-3", touched().becomes(touched() | harm), stopped().becomes(stopped() | harm)),
        accept("M-2.2-8", "M-2-S3b"),
    ])  # fmt: skip

    nothing_is_touched = Always("M-2.3.2-2", ~touched(), "M-2.3.2-1", "M-2.3-3", "M-2.3.1-1",
                                says="no write reaches an input, a dedicated signal or a number beyond its class")  # fmt: skip
    refused_changes_nothing = Step("M-2.2-7", (service_is("request") & answered("result(-)")) >> unchanged(touched, stopped),
                                   says="a refused request changes nothing")  # fmt: skip


class AccessRepaired(Access):
    """The repaired reading: what must not be is answered by an exception, and not performed."""

    request = Procedure("M-2.2-8", on=response("request", function, points, sound), steps=[
        refuse("M-2.2-7", "M-2.2-3", "MR-02", unless=sound, rule="request.unsound", says="its data are not those of the function code"),
        refuse("M-2.3-3", "M-2.3.2-1", "M-2.3.2-3", when=points == Points.BEYOND, rule="access.beyond", says="it reaches beyond the numbers of a class"),
        refuse("M-2.3.1-1", "M-2.3.1-2", "M-2.3.1-3", when=(function == Function.READ_DISCRETE_INPUTS) & (points != Points.INPUT),
               rule="access.not-inputs", says="0x02 reads external inputs only"),
        refuse("M-2.3.1-4", "M-2.3.1-1", when=function.isin(COILS) & points.isin([Points.INPUT, Points.REGISTER]), rule="access.not-coils",
               says="0x01, 0x05 and 0x0F are for external outputs and internal signals"),
        refuse("M-2.3-7", "MR-03", when=function.isin(WORDS) & (points != Points.REGISTER), rule="access.not-registers",
               says="0x03, 0x04, 0x06 and 0x10 are for registers"),
        refuse("M-2.3.2-2", "M-2.3.2-3", when=written & (points == Points.DEDICATED), rule="access.dedicated",
               says="a dedicated signal is never written"),
        do("M-2.3.2-3", touched().becomes(touched() | harm), stopped().becomes(stopped() | harm)),
        accept("M-2.2-8", "M-2-S3b"),
    ], repairs=repaired("MR-02", "M-2.2-8", "M-2.3.2-3", because="a client must learn of it, and the robot must go on"))  # fmt: skip
