"""Polling: cells become samples, signals ADUs; what the controller refuses, or does not answer, is told."""

from __future__ import annotations

import asyncio
import json
import struct
from collections.abc import Awaitable, Callable
from dataclasses import dataclass, field
from pathlib import Path

import pytest
from wire import HOST, rows, serving

from mmsverify.cli import main
from mmsverify.formats.mcap import TraceWriter, read_trace
from mmsverify.recording import Address, Log, Poller, PollMap, Recorded
from mmsverify.recording.points import Point, Read

MODE = Point("C_RunMD", "holding", 0)
STATE = Point("CS_RunSTA", "holding", 1)
HOME = Point("CF_Home", "coil", 3)


@dataclass
class Controller:
    """A Modbus server of a test: registers, coils, and what it does wrong."""

    registers: list[int] = field(default_factory=lambda: [0] * 16)
    coils: int = 0
    change: Callable[[bytes], bytes] = lambda answer: answer
    asked: list[bytes] = field(default_factory=list)

    async def serve(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        try:
            while True:
                request = await reader.readexactly(12)
                self.asked.append(request)
                answer = self.change(self.answer(request))
                if not answer:
                    break
                writer.write(answer)
        except asyncio.IncompleteReadError:
            pass
        writer.close()

    def answer(self, request: bytes) -> bytes:
        transaction, _, _, unit, function, address, count = struct.unpack(">HHHBBHH", request)
        if address + count > 16:
            pdu = bytes([function | 0x80, 2])
        elif function in (1, 2):
            bits = self.coils >> address & (1 << count) - 1
            data = bits.to_bytes((count + 7) // 8, "little")
            pdu = bytes([function, len(data)]) + data
        else:
            data = struct.pack(f">{count}H", *self.registers[address : address + count])
            pdu = bytes([function, len(data)]) + data
        return struct.pack(">HHHB", transaction, 0, len(pdu) + 1, unit) + pdu


@dataclass
class Polled:
    path: Path
    recorded: Recorded
    told: list[str]

    @property
    def samples(self) -> list[dict[str, float]]:
        return [json.loads(data) for topic, data in rows(self.path) if topic.endswith("/vr")]

    @property
    def events(self) -> list[str]:
        return [data for _, data in rows(self.path) if isinstance(data, str)]


async def polled(
    tmp_path: Path, controller: Controller, points: PollMap, meanwhile: Callable[[], Awaitable[None]]
) -> Polled:
    path, told = tmp_path / "t.mcap", list[str]()
    async with serving(controller.serve) as port:
        log = Log(TraceWriter(path), "press")
        work = asyncio.create_task(Poller(Address(HOST, port), points, log, told.append).work())
        await meanwhile()
        work.cancel()
        await asyncio.gather(work, return_exceptions=True)
        return Polled(path, log.end(), told)


def run(tmp_path: Path, controller: Controller, points: PollMap, seconds: float = 0.2) -> Polled:
    return asyncio.run(polled(tmp_path, controller, points, lambda: asyncio.sleep(seconds)))


def test_cells_become_samples(tmp_path: Path) -> None:
    controller = Controller(registers=[6, 2, *[0] * 14], coils=0b1000)

    async def changes() -> None:
        await asyncio.sleep(0.1)
        controller.registers[1] = 5
        await asyncio.sleep(0.1)

    points = PollMap((MODE, STATE, HOME), (), period=0.01)
    made = asyncio.run(polled(tmp_path, controller, points, changes))
    assert made.samples[0] == {"C_RunMD": 6, "CS_RunSTA": 2, "CF_Home": 1}
    assert made.samples[-1] == {"C_RunMD": 6, "CS_RunSTA": 5, "CF_Home": 1}
    assert made.recorded.pdus["modbus"] == 0
    [channel] = {message.channel for message in read_trace(made.path) if message.topic == "/press/vr"}
    assert channel.metadata["sampling"] == "polled"


def test_signals_are_recorded_as_they_are_read(tmp_path: Path) -> None:
    controller = Controller(coils=0b1010)
    made = run(tmp_path, controller, PollMap((), (Read("coil", 0, 4),), period=0.05))
    said = [(topic, data) for topic, data in rows(made.path) if isinstance(data, bytes)]
    assert said[0] == ("/press/modbus/c1/client", bytes.fromhex("000100000006010100000004"))
    assert said[1] == ("/press/modbus/c1/server", bytes.fromhex("000100000004010101") + b"\x0a")
    assert made.events == ["c1 open", "c1 close"]


def test_a_read_that_is_refused_is_told_once_and_the_others_go_on(tmp_path: Path) -> None:
    beyond = Point("C_Cmd", "holding", 40)
    made = run(tmp_path, Controller(), PollMap((MODE, beyond), (), period=0.02))
    assert made.samples[0] == {"C_RunMD": 0}
    [unread] = made.recorded.undecoded
    assert unread.reason == "holding 40 was refused, exception 2"
    assert unread.count == len(made.samples) > 1
    assert len([line for line in made.told if "refused" in line]) == 1


@pytest.mark.parametrize(
    ("change", "told"),
    [
        (lambda _: b"", "ended the connection"),
        (lambda answer: b"\xff" + answer[1:], "transaction"),
        (lambda answer: answer[:2] + b"\x01" + answer[3:], "no ADU"),
        (lambda answer: answer[:7] + b"\x04" + answer[8:], "function 4 answers"),
        (lambda answer: answer[:7] + b"\x84\x02", "no answer to holding 0"),
        (lambda answer: answer[:6] + b"\x09" + answer[7:], "unit 9 answers"),
        (lambda _: b"HTTP/1.0 400 Bad Request", "protocol 5450"),
        (lambda answer: answer[:8] + b"\x04" + answer[9:], "byte count 4"),
        (lambda answer: answer[:5] + b"\x63" + answer[6:], "no answer to holding 0"),
    ],
)
def test_after_a_wrong_answer_the_connection_is_made_anew(
    change: Callable[[bytes], bytes], told: str, tmp_path: Path
) -> None:
    controller = Controller()
    wrong = iter([change])

    def once(answer: bytes) -> bytes:
        return next(wrong, lambda right: right)(answer)

    controller.change = once
    made = run(tmp_path, controller, PollMap((MODE,), (), period=0.05, timeout=0.1), seconds=0.9)
    assert told in made.told[1]
    assert [told in each.reason for each in made.recorded.undecoded] == [True]
    assert made.events == ["c1 open", "c1 close"] * 2
    assert made.samples


def test_a_controller_that_cannot_be_reached_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    points = tmp_path / "map.toml"
    points.write_text("[vr]\nC_RunMD = {holding = 0}\n")
    output = tmp_path / "t.mcap"
    assert main(["record", "modbus", f"{HOST}:1", "--map", str(points), "-o", str(output)]) == 2
    assert capsys.readouterr().err.startswith(f"mmsverify: {HOST}:1: cannot be reached: ")
    assert not output.exists()


def test_a_cell_that_cannot_be_read_any_more_is_not_said_to_have_kept_its_value(tmp_path: Path) -> None:
    controller = Controller()
    number = Point("C_Cmd", "holding", 2, "float32")
    controller.registers[2:4] = struct.unpack(">HH", struct.pack(">f", 5.0))

    async def breaks() -> None:
        await asyncio.sleep(0.1)
        controller.registers[2] = 0x7FC0  # no number
        await asyncio.sleep(0.2)

    points = PollMap((MODE, number), (), period=0.02)
    made = asyncio.run(polled(tmp_path, controller, points, breaks))
    assert made.samples
    assert all(sample == {"C_RunMD": 0, "C_Cmd": 5} for sample in made.samples)
    assert [each.reason for each in made.recorded.undecoded] == ["C_Cmd holds no number"]
    assert len([line for line in made.told if "no number" in line]) == 1


@pytest.mark.parametrize("cut", range(1, 12))
def test_what_came_of_an_answer_is_recorded(cut: int, tmp_path: Path) -> None:
    controller = Controller()
    controller.change = lambda answer: answer[:cut]

    async def closes(reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        writer.write(controller.answer(await reader.readexactly(12))[:cut])
        writer.close()

    controller.serve = closes  # type: ignore[method-assign]
    points = PollMap((), (Read("holding", 0, 2),), period=0.05)
    made = run(tmp_path, controller, points)
    said = [data for topic, data in rows(made.path) if topic.endswith("/server")]
    assert said[0] == controller.answer(bytes.fromhex("000100000006010300000002"))[:cut]


@pytest.mark.parametrize("ticks", range(0, 60, 2))
def test_a_poller_ends_whenever_it_is_told_to(ticks: int, tmp_path: Path) -> None:
    async def told_at() -> None:
        for _ in range(ticks):
            await asyncio.sleep(0)

    points = PollMap((MODE,), (Read("coil", 0, 4),), period=0.001)
    made = asyncio.run(asyncio.wait_for(polled(tmp_path, Controller(), points, told_at), 3))
    assert made.recorded.broken == ""
