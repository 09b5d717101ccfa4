"""The words of the server: function codes, kinds of signals, sockets and connections (sections 2 and 2.1 to 2.3).

A socket is one of those that the program keeps ready: so many connections it can serve. How many there are is
not fixed, and the proofs hold for any number of sockets and clients.
"""

from mmsverify.model import BOOL, Derived, Each, Enumeration, Model, Relation, for_some, parameter


class Function(Enumeration):
    """The function codes that are opened to clients."""

    READ_COILS = "0x01"
    READ_DISCRETE_INPUTS = "0x02"
    READ_HOLDING_REGISTERS = "0x03"
    READ_INPUT_REGISTERS = "0x04"
    WRITE_SINGLE_COIL = "0x05"
    WRITE_SINGLE_REGISTER = "0x06"
    WRITE_MULTIPLE_COILS = "0x0F"
    WRITE_MULTIPLE_REGISTERS = "0x10"


class Points(Enumeration):
    """What the numbers of a request are, all of them."""

    OUTPUT = "external outputs"
    INPUT = "external inputs"
    INTERNAL = "internal signals"
    DEDICATED = "dedicated signals"
    REGISTER = "registers"
    BEYOND = "beyond the numbers of a class"


COILS = [Function.READ_COILS, Function.WRITE_SINGLE_COIL, Function.WRITE_MULTIPLE_COILS]
WORDS = [
    Function.READ_HOLDING_REGISTERS,
    Function.READ_INPUT_REGISTERS,
    Function.WRITE_SINGLE_REGISTER,
    Function.WRITE_MULTIPLE_REGISTERS,
]
WRITES = [
    Function.WRITE_SINGLE_COIL,
    Function.WRITE_MULTIPLE_COILS,
    Function.WRITE_SINGLE_REGISTER,
    Function.WRITE_MULTIPLE_REGISTERS,
]


class Vocabulary(Model):
    """Variables and parameters; no rows."""

    Socket = Each("Socket")
    Client = Each("Client")
    s, t = Socket.elements("s t")
    c, d = Client.elements("c d")

    listening = Relation(doc="the socket of TCP_LISTEN exists", cites=["M-2.1-1"])
    stopped = Relation(doc="an abnormal call has stopped the robot", cites=["M-2.1-9"])
    linked = Relation(Client, doc="the client's end of its connection is open", cites=["M-2.1-3"])
    serves = Relation(
        Socket, Client, doc="the connection socket of the client", cites=["M-2.1-12", "M-2-S2b"]
    )
    heard = Relation(
        Client, doc="a request of the client has been received, and not answered yet", cites=["M-2.1-5"]
    )
    touched = Relation(doc="something has been written that must not be, or that is not there")

    # What a request asks for.
    function = parameter("function", Function)
    points = parameter("points", Points)
    sound = parameter("sound", BOOL)

    served = Derived(for_some(s)(serves[s, c]), over=[c], doc="the client has a connection socket")
