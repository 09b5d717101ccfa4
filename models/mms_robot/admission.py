"""What stands before every repaired service procedure: local control and logical status (RP-10, RP-11)."""

from mmsverify.model import refuse
from mmsverify.model.steps import Refuse
from mmsverify.model.terms import Term

from .vocabulary import Logical

EVERYTHING = (Logical.STATE_CHANGES_ALLOWED,)
ALL_BUT_RUNNING = (Logical.STATE_CHANGES_ALLOWED, Logical.SUPPORT_SERVICES_ALLOWED)


def admission(
    service: str, panel: Term, local_control: Term, logical: Term, admitting: tuple[Logical, ...]
) -> list[Refuse]:
    """The refusals before step a): from a client in local control, from the panel without it, in a status that forbids it.

    ``admitting`` are the logical statuses in which the base standard admits the service.
    """
    return [
        refuse("R-3.2.1-1", "RP-10", when=local_control & ~panel, rule=f"{service}.local-control",
               says="the robot is in local control"),
        refuse("R-6.1.3.2.5-1", "R-5.3.1.4-3", "RP-18", when=panel & ~local_control, rule=f"{service}.panel",
               says="nobody at the panel holds control"),
        refuse("R-6.1.3.2.5-2", "B-STATUS", "RP-11", unless=panel | logical.isin(admitting), rule=f"{service}.logical-status",
               says="the logical status of the VMD does not admit the service"),
    ]  # fmt: skip
