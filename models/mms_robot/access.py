"""Write: it changes nothing that the model knows, but the server's state all the same (3.2.1, 6.3.7)."""

from mmsverify.model import Procedure, accept, refuse, repaired, response

from .admission import ALL_BUT_RUNNING
from .vocabulary import Vocabulary, VocabularyRepaired


class Access(Vocabulary):
    """As written: nothing stands against it."""

    write = Procedure("R-9.2.2.2.1-7", on=response("write", request, user), steps=[accept("R-9.2.2.2.1-7")])


class AccessRepaired(Access, VocabularyRepaired):
    """The repaired reading."""

    write = Procedure(
        "R-9.2.2.2.1-7",
        on=response("write", request, user),
        steps=[
            refuse("R-3.2.1-1", "RP-10", when=local_control(), rule="write.local-control", says="the robot is in local control"),
            refuse("R-6.1.3.2.5-2", "B-STATUS", "RP-11", unless=logical().isin(ALL_BUT_RUNNING), rule="write.logical-status",
                   says="the logical status of the VMD does not admit the service"),
            accept("R-9.2.2.2.1-7"),
        ],
        repairs=repaired("RP-10", "R-9.2.2.2.1-7", because="what is written changes the server, and the text does not say when that is refused"),
    )  # fmt: skip
