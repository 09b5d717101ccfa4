"""How fast captures are imported, on one core.

    python bench/import_speed.py [PACKETS [ROUNDS [CAPTURE ...]]]

Made captures of PACKETS packets (100,000) each: MMS, Modbus, and traffic of others, as TCP has it in a plant
(one side's acknowledgements travel alone); and any captures of one's own. The median of ROUNDS (3)
rounds is shown, and beside it what dpkt alone takes to read the same packets down to TCP.
"""

from __future__ import annotations

import io
import statistics
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import dpkt

TESTS = Path(__file__).parent.parent / "tests"
sys.path.insert(0, str(TESTS))

from capture_wire import STATUS, STATUS_ANSWER, Talk, captured, dt, mms  # noqa: E402

from mmsverify.formats.capture import import_captures  # noqa: E402
from mmsverify.formats.mcap_write import TraceWriter  # noqa: E402

ASKED = bytes.fromhex("000100000006010100000010")
ANSWERED = bytes.fromhex("0001000000050101020f0f")
TURNS = {
    "MMS": (102, dt(mms(STATUS)), dt(mms(STATUS_ANSWER))),
    "Modbus": (502, ASKED, ANSWERED),
    "others": (443, bytes(500), bytes(1400)),
}


def talk(kind: str, packets: int) -> bytes:
    """A capture of one connection: question, answer, acknowledgement."""
    port, asked, answered = TURNS[kind]
    made = Talk(server=("10.0.0.5", port))
    made = made.associate() if kind == "MMS" else made.shake()
    for _ in range(packets // 3):
        made.say(("client", asked), ("server", answered)).packet("client")
    return captured(made)


def imported(path: Path) -> int:
    """Import one capture; give its packets."""
    with TraceWriter(io.BytesIO()) as writer:
        return import_captures([path], writer)[0].frames


def read(path: Path) -> int:
    """Read its packets with dpkt, and no more."""
    with path.open("rb") as file:
        return sum(1 for _ in (dpkt.ethernet.Ethernet(data) for _, data in dpkt.pcap.Reader(file)))


def rate(work: Callable[[Path], int], path: Path, rounds: int) -> float:
    """Packets per second of CPU time, the median."""
    rates = []
    for _ in range(rounds):
        begin = time.process_time()
        count = work(path)
        rates.append(count / (time.process_time() - begin))
    return statistics.median(rates)


def captures(folder: Path, packets: int) -> Iterator[tuple[str, Path]]:
    """The made captures, written down."""
    for kind in TURNS:
        path = folder / f"{kind}.pcap"
        path.write_bytes(talk(kind, packets))
        yield kind, path


def main() -> None:
    """Print the table."""
    given = sys.argv[1:]
    packets, rounds = int(given[0]) if given else 100_000, int(given[1]) if given[1:] else 3
    print(f"{'capture':40} {'packets':>8} {'import, packets/s':>18} {'dpkt alone':>11} {'ratio':>6}")
    with tempfile.TemporaryDirectory() as folder:
        own = [(Path(name).name, Path(name)) for name in given[2:]]
        for name, path in [*captures(Path(folder), packets), *own]:
            ours, theirs = rate(imported, path, rounds), rate(read, path, rounds)
            print(f"{name[:40]:40} {read(path):8} {ours:18,.0f} {theirs:11,.0f} {ours / theirs:6.2f}")


if __name__ == "__main__":
    main()
