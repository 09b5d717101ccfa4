"""Recording from the wire, now: a relay between client and server, and a client that polls.

What both see goes through the same readers as a capture does, into a trace that is readable at any moment.
This is the only part of mmsverify that opens network connections.
"""

from mmsverify.recording.log import Log, Recorded
from mmsverify.recording.points import PollMap, read_map
from mmsverify.recording.polling import Poller
from mmsverify.recording.relay import Relay
from mmsverify.recording.running import Address, address, run

__all__ = ["Address", "Log", "PollMap", "Poller", "Recorded", "Relay", "address", "read_map", "run"]
