"""The MMS companion standard for robots, GB/T 16720.3-1996 (eqv ISO/IEC 9506-3:1991), as an executable model.

``as-written`` is the text step by step; ``repaired`` differs from it in named rows only, each with the clause
that it mends and the reason. One file per clause group; the text and its repair stand together.
"""

from .access import Access, AccessRepaired
from .associations import Associations, AssociationsRepaired
from .attributes import Attributes
from .consequences import CONSEQUENCES
from .device_properties import DeviceProperties
from .devices import Devices
from .domains import Domains, DomainsRepaired
from .events import Events
from .execution import Execution
from .execution_repaired import ExecutionRepaired
from .figure8 import Figure8, Figure8Repaired
from .observations import Observations
from .outcomes import Outcomes, OutcomesRepaired
from .programs import Programs, ProgramsRepaired
from .properties import Properties
from .properties_repaired import PropertiesRepaired
from .scenario import named, scenario
from .selection import Selection, SelectionRepaired
from .services import Services
from .transfers import Transfers, TransfersRepaired
from .transitions import Transitions, TransitionsRepaired
from .vmd import Vmd, VmdRepaired
from .worlds import worlds

STANDARD = "GB/T 16720.3-1996"
VIEWS = {"robot state": "robot_state", "program invocation": "state"}


class AsWritten(
    Programs, Selection, Execution, Vmd, Access, Associations, Domains, Devices, Observations,
    Properties, DeviceProperties, Services, Attributes, Outcomes, Transfers, Figure8, Transitions, Events,
    name="mms-robot", variant="as-written", standard=STANDARD, views=VIEWS, scenario=scenario, worlds=worlds,
    consequences=CONSEQUENCES, named=named,
):  # fmt: skip
    """The text as it stands, faults included."""


class Repaired(
    ProgramsRepaired, SelectionRepaired, ExecutionRepaired, VmdRepaired, AccessRepaired, AssociationsRepaired, DomainsRepaired,
    Devices, Observations, PropertiesRepaired, DeviceProperties, Services, Attributes, OutcomesRepaired, TransfersRepaired,
    Figure8Repaired, TransitionsRepaired, Events,
    name="mms-robot", variant="repaired", standard=STANDARD, views=VIEWS, scenario=scenario, worlds=worlds,
    consequences=CONSEQUENCES, named=named,
):  # fmt: skip
    """The reading that keeps its own rules."""
