"""A Modbus/TCP server on a robot controller that opens its signals, as an executable model.

The sockets of the server are in ``server``, what each call is for in ``calls``, what requests may touch in ``access``.
"""

from .access import Access, AccessRepaired
from .calls import Calls
from .server import Server, ServerRepaired

STANDARD = "Modbus/TCP server of a robot controller"
VIEWS = {"listening": "listening"}


class AsWritten(Access, Server, Calls, name="modbus-signals", variant="as-written", standard=STANDARD):
    """The text as it stands."""


class Repaired(
    AccessRepaired, ServerRepaired, Calls, name="modbus-signals", variant="repaired", standard=STANDARD
):
    """The reading that keeps its own rules."""
