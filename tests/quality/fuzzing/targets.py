"""Every target: what makes its inputs, what takes them, and its share of a million."""

from __future__ import annotations

import gzip
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from random import Random

from capture_wire import captured

from fuzzing import files, lies, nests, octets, seeds, wire
from fuzzing.mutate import Mutation, run
from fuzzing.trees import tree
from fuzzing.watch import Watch
from fuzzing.wire import Said

Make = Callable[[Random], bytes]


@dataclass(frozen=True, slots=True)
class Target:
    """``maker`` makes what makes inputs; ``run`` says whether it accepts one; ``share`` is of a million."""

    name: str
    share: int
    maker: Callable[[], Make]
    run: Callable[[bytes], bool]

    def input(self, seed: int, number: int) -> bytes:
        """The input with that number: the same on every machine."""
        return _made(self.maker)(Random(f"{seed} {self.name} {number}"))

    def warm(self, watch: Watch, seed: int) -> None:
        """Load what only the first input needs: models, schemas."""
        watch.judge(self.run, self.input(seed, 0))


@cache
def _made(maker: Callable[[], Make]) -> Make:
    return maker()


def _pdu() -> Mutation:
    own = ((tree, 14), (nests.ber, 0.15), (nests.own_tag, 0.15))
    return Mutation(seeds.messages("mms-ber") + seeds.pdus() * 8, own)


def _contents() -> Mutation:
    found = (
        b"\x01\xff",
        b"\x07\x80",
        b"\x2a\x86\x48\x86\xf7\x0d",
        b"20260105060000.5Z",
        "Schweißer".encode(),
        b"R_ARM",
        b"\x1b$B",
        b"\x30\x04\x02\x02\x01\x00",
        *seeds.pdus()[:4],
    )
    return Mutation(found, ((nests.ber, 0.3), (tree, 2)))


def _layers() -> Mutation:
    found = (*seeds.tsdus(), *(one[at:] for one in seeds.tsdus()[:3] for at in _inside(one)))
    return Mutation(found, ((tree, 6), (nests.ber, 0.15), (lies.lying(lies.session), 4)))


def _inside(tsdu: bytes) -> list[int]:
    """Where presentation and ACSE begin."""
    return [at for tag in (b"\x31", b"\x61\x81", b"\x61", b"\x60") if (at := tsdu.find(tag)) > 0]


def _stream() -> Mutation:
    return Mutation(seeds.streams(), ((lies.lying(lies.tpkt), 6),))


def _tsdu() -> Make:
    """A tree inside an SPDU, whose head is not touched."""
    inner = Mutation(
        [one[4:] for one in seeds.tsdus() if one[:4] == b"\x01\x00\x01\x00"], ((tree, 12), (nests.ber, 0.2))
    )
    outer = Mutation(seeds.tsdus(), ((lies.lying(lies.session), 6), (tree, 2)))

    def make(rng: Random) -> bytes:
        return b"\x01\x00\x01\x00" + inner(rng) if rng.random() < 0.5 else outer(rng)

    return make


def _modbus() -> Mutation:
    return Mutation((*seeds.adus(), b"".join(seeds.adus()[:5])), ((lies.lying(lies.mbap), 6),))


def _frame() -> Mutation:
    return Mutation(seeds.frames(), ((lies.lying(lies.frames), 6), (_wrapped, 0.4)))


def _wrapped(rng: Random, data: bytes, others: Sequence[bytes]) -> bytes:  # noqa: ARG001
    """Tags in tags, or IP in IP in IP."""
    deep = min(nests.depth(rng), 8000)
    ip = bytes.fromhex("4500000000000000ff040000 0a000001 0a000002")
    hops = b"\x00\x00" * 4
    inside = rng.choice(
        (
            b"\x81\x00\x00\x07" * deep + b"\x08\x00",
            b"\x08\x00" + ip * deep,
            b"\x86\xdd" + b"\x60" + bytes(5) + b"\x00\x40" + bytes(32) + hops * deep,
        )
    )
    return b"\x01" + bytes(12) + inside + data[15:]


def _tcp() -> Mutation:
    shake = [(1, 0, 999, 0), (16 | 1 | 8, 0, 4999, 1000), (8, 0, 1000, 5000)]
    said = [(8 + 16 * (at % 2), 10, 1000 + 5 * at, 5000 + 5 * at) for at in range(8)]
    holed = [(8 + 32, 3, 1000 + 1200 * at, 5000) for at in range(12)]
    early = [(8 + 32, 3, 1000 + 1200 * (9 - at), 5000 + 70000 * (at % 3)) for at in range(10)]
    ended = [(8 + 2, 0, 1100, 5100), (16 + 8 + 2, 0, 5100, 1101)]
    found = [shake + said + ended, shake + holed, shake + early, said + shake, shake + said + [(4, 0, 1, 1)]]
    packed = [b"".join(octets.STEP.pack(*one, 0) for one in each) for each in found]
    return Mutation(packed, largest=1 << 16)


def _capture() -> Make:
    own = ((lies.lying(lies.pcap), 8),)
    pcap = Mutation(seeds.pcaps(), own, largest=1 << 19)
    pcapng = Mutation(seeds.pcapngs(), ((lies.lying(lies.pcapng), 8),), largest=1 << 20)
    zipped = Mutation(seeds.zipped(), largest=1 << 16)

    def make(rng: Random) -> bytes:
        kind = rng.random()
        if kind < 0.1:
            return zipped(rng)
        if kind < 0.15:
            return gzip.compress(pcap(rng), 1, mtime=0)
        if kind < 0.153:
            return _optioned(rng)
        return pcap(rng) if kind < 0.5 else pcapng(rng) if kind < 0.8 else _spoken(rng)

    stream, adus = _stream(), _modbus()

    def _optioned(rng: Random) -> bytes:
        """An interface with ever so many options."""
        options = rng.choice((b"\x05\x00\x00\x00", b"\x09\x00\x01\x00\xff\x00\x00\x00", b"\x05\x00\x01\x00"))
        body = b"\x01\x00" + bytes(6) + options * int(2 ** rng.uniform(4, 18))
        return pcapng(rng)[:28] + wire.block(1, body) + pcapng(rng)[28:]

    def _spoken(rng: Random) -> bytes:
        """A true capture of octets that lie."""
        talk, data = (seeds.talk(), stream(rng)) if rng.random() < 0.6 else (seeds.signals(), adus(rng))
        for at in range(0, min(len(data), 300_000), 1400):
            talk.packet(rng.choice(octets.SIDES), data[at : at + 1400])
        return captured(talk)

    return make


def _sample() -> Mutation:
    return Mutation(seeds.samples(), ((nests.json, 0.3), (run, 0.3)))


def _event() -> Mutation:
    return Mutation(seeds.links(), ((nests.json, 0.5), (run, 0.3)))


def _table() -> Mutation:
    return Mutation(seeds.tables(), ((run, 1),), largest=1 << 17, swollen=8)


def _profile() -> Mutation:
    return Mutation(seeds.profiles(), ((nests.toml, 0.4), (run, 0.4)), largest=1 << 16)


def _metadata() -> Mutation:
    return Mutation(seeds.stated(), ((nests.toml, 0.6), (nests.json, 0.3), (run, 0.4)), largest=1 << 16)


BOMB = 64 << 20
"""Octets to which a chunk may grow."""


def _recording() -> Make:
    own = ((lies.lying(lies.mcap), 8),)
    whole = Mutation(seeds.recordings(), own)
    inside = Mutation([wire.records(seeds.said_mms(list(seeds.pdus()[:4])))], own)

    def make(rng: Random) -> bytes:
        kind = rng.random()
        if kind < 0.0004:
            return wire.bomb(rng, BOMB)
        if kind < 0.4:  # what is changed stands in a true chunk
            return wire.file(wire.chunk(inside(rng), rng.choice(("", "lz4", "zstd"))))
        return whole(rng)

    return make


def _talk(
    mutation: Make, known: Sequence[bytes], said: Callable[[list[bytes]], list[Said]], most: int
) -> Make:
    """A short recording of true messages, and among them some that are mutated."""

    def make(rng: Random) -> bytes:
        at = rng.randrange(len(known))
        spoken = list(known[at : at + rng.randint(1, most)])
        for _ in range(rng.randint(1, 4)):
            spoken.insert(rng.randint(0, len(spoken)), mutation(rng)[: 1 << 17])
        return wire.file(wire.records(said(spoken)))

    return make


def _talk_mms() -> Make:
    return _talk(_pdu(), seeds.messages("mms-ber"), seeds.said_mms, 4)


def _talk_vr() -> Make:
    return _talk(_sample(), seeds.messages("json"), seeds.said_vr, 6)


def _talk_modbus() -> Make:
    return _talk(_modbus(), seeds.adus(), seeds.said_modbus, 6)


def _any_talk() -> Make:
    makers = (_talk_mms(), _talk_modbus(), _recording())
    return lambda rng: rng.choice(makers)(rng)


TARGETS: Mapping[str, Target] = {
    target.name: target
    for target in (
        Target("mms", 300_000, _pdu, octets.decode_mms),
        Target("ber", 80_000, _contents, octets.read_ber),
        Target("layers", 100_000, _layers, octets.layers),
        Target("association", 60_000, _stream, octets.associations),
        Target("tsdu", 60_000, _tsdu, octets.tsdu),
        Target("link", 70_000, _frame, octets.frame),
        Target("tcp", 40_000, _tcp, octets.tcp),
        Target("modbus", 60_000, _modbus, octets.modbus_octets),
        Target("capture", 50_000, _capture, files.capture),
        Target("vr", 50_000, _sample, octets.sample),
        Target("csv", 30_000, _table, files.table),
        Target("mcap", 40_000, _recording, files.recording),
        Target("profile", 15_000, _profile, files.profile),
        Target("metadata", 15_000, _metadata, octets.metadata),
        Target("link-event", 11_000, _event, octets.event),
        Target("events", 10_000, _any_talk, files.events),
        Target("audit-mms", 2_500, _talk_mms, files.audit),
        Target("audit-vr", 1_500, _talk_vr, files.audit),
        Target("audit-modbus", 5_000, _talk_modbus, files.audit),
    )
}


def shares(inputs: int, names: Sequence[str]) -> dict[str, int]:
    """So many inputs over some targets, by their shares, each at least one."""
    whole = sum(TARGETS[name].share for name in names)
    counts = {name: max(1, inputs * TARGETS[name].share // whole) for name in names}
    counts[names[0]] = max(1, counts[names[0]] + inputs - sum(counts.values()))
    return counts
