"""How many MMS PDUs a second are decoded, beside asn1tools on the same octets.

    python bench/decoder.py [PDUS [ROUNDS]]

The PDUs are those of the shipped samples, of a robot's routine, and of a log in which each is another
(``logs.py``), PDUS (3,000) of either. ``tables`` is this decoder by its tables only, which is how a short
recording is read, and what is not regular. Told are PDUs a second of CPU time, the best of ROUNDS (5); the
ways take turns, so that a busy machine is as hard on each. What asn1tools, a dependency of the tests, cannot
read is counted.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent / "tests")]

import asn1tools  # noqa: E402
from logs import write_diverse, write_routine  # noqa: E402
from one_module import one_module  # noqa: E402

from mmsverify.formats import mms  # noqa: E402
from mmsverify.formats.codec import Walk  # noqa: E402
from mmsverify.formats.mcap import read_trace  # noqa: E402
from mmsverify.formats.schema import Schema  # noqa: E402
from mmsverify.resources import asn1_dir, traces_dir  # noqa: E402

Way = Callable[[bytes], object]


def pdus(paths: Iterable[Path]) -> list[bytes]:
    """The PDUs of some recordings."""
    return [one.data for path in paths for one in read_trace(path) if one.message_encoding == "mms-ber"]


def recordings(count: int) -> Iterator[tuple[str, list[bytes]]]:
    """What is decoded."""
    yield "samples", pdus(sorted(traces_dir().glob("*.mcap")))
    with tempfile.TemporaryDirectory() as folder:
        for name, write in (("routine", write_routine), ("diverse", write_diverse)):
            path = Path(folder) / f"{name}.mcap"
            write(path, count)
            yield name, pdus([path])


def by_tables() -> Way:
    """The way of `mms.decode` without the functions made of the types."""
    readers = Schema.of_folder(asn1_dir()).type("MMSpdu").readers

    def read(octets: bytes) -> object:
        begin = 2 if octets[1] < 0x80 else 2 + (octets[1] & 0x7F)
        return readers[octets[0]](Walk(octets), begin, len(octets), 1)

    return read


def by_asn1tools() -> Way:
    """The other decoder."""
    compiled: Any = asn1tools.compile_string(one_module(), "ber")
    return lambda octets: compiled.decode("MMSpdu", octets)


def seconds(way: Way, octets: Sequence[bytes]) -> tuple[float, int]:
    """CPU time, and how many could not be read."""
    refused = 0
    begin = time.process_time()
    for one in octets:
        try:
            way(one)
        except Exception:
            refused += 1
    return time.process_time() - begin, refused


def main() -> None:
    """Print the table."""
    count, rounds = (int(text) for text in (sys.argv[1:] + ["3000", "5"][len(sys.argv) - 1 :]))
    ways = {"mmsverify": mms.decode, "tables": by_tables(), "asn1tools": by_asn1tools()}
    print(
        f"{'PDUs/s':10}{'PDUs':>8}" + "".join(f"{name:>12}" for name in ways) + f"{'ratio':>8}{'unread':>8}"
    )
    for name, octets in recordings(count):
        seconds(
            mms.decode, octets * (200_000 // len(octets))
        )  # functions are made of what is asked for often
        found = [[seconds(way, octets) for way in ways.values()] for _ in range(rounds)]
        best = [len(octets) / min(one[0] for one in way) for way in zip(*found, strict=True)]
        print(
            f"{name:10}{len(octets):8,}"
            + "".join(f"{rate:12,.0f}" for rate in best)
            + f"{best[0] / best[2]:8.1f}{found[0][2][1]:8}",
            flush=True,
        )


if __name__ == "__main__":
    main()
