"""Tables of VR samples, as oscilloscopes and operator panels export them, to recordings."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import pytest

from mmsverify.cli import main
from mmsverify.formats.csv_layout import Asked
from mmsverify.formats.csv_samples import CsvSamples
from mmsverify.formats.mcap import read_trace

MS = 1_000_000
Said = list[tuple[int, dict[str, Any]]]


@pytest.fixture(autouse=True)
def at_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def imported(text: str | bytes, *options: str, name: str = "machine.csv") -> Said:
    """The samples of the trace that an import makes of one table: time in ns, cells."""
    Path(name).write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["import", name, "-o", "out.mcap", "-q", *options]) == 0
    return [(message.time, json.loads(message.data)) for message in read_trace("out.mcap")]


def refused(text: str | bytes, *options: str, capsys: pytest.CaptureFixture[str]) -> str:
    """The line that tells why an import fails; nothing may be left behind."""
    Path("machine.csv").write_bytes(text if isinstance(text, bytes) else text.encode())
    assert main(["import", "machine.csv", "-o", "out.mcap", *options]) == 2
    printed = capsys.readouterr()
    assert printed.out == ""
    assert printed.err.count("\n") == 1
    assert [path.name for path in Path().iterdir()] == ["machine.csv"]
    return printed.err.strip()


THREE: Said = [
    (0, {"C_RunMD": 1, "CS_RunSTA": 1}),
    (5 * MS, {"C_RunMD": 2, "CS_RunSTA": 1}),
    (10 * MS, {"C_RunMD": 2, "CS_RunSTA": 2}),
]


@pytest.mark.parametrize(
    "header",
    [
        "Time,VR(0),VR(1)",
        "time,VR0,VR1",
        "t,VR[0],VR[1]",
        "TIME,C_RunMD,CS_RunSTA",
        '"Time","VR(C_RunMD)","vr_1"',
    ],
)
def test_columns_named_after_a_cell_are_found(header: str) -> None:
    assert imported(f"{header}\n0,1.0,1.0\n5,2,1\n10,2,2\n", "--unit", "ms") == THREE


@pytest.mark.parametrize("delimiter", [",", ";", "\t"])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_delimiter_and_line_ends_are_found_out(delimiter: str, end: str) -> None:
    rows = ["Time,VR0,VR1", "0,1,1", "5,2,1", "10,2,2", ""]
    assert imported(end.join(rows).replace(",", delimiter), "--unit", "ms") == THREE


def test_a_semicolon_goes_with_decimal_commas() -> None:
    assert imported("Time;VR0;VR1\n0,0;1,0;1,0\n0,005;2,0;1,0\n1,0e-2;2,0;2,0\n") == THREE


def test_decimal_commas_in_quotes_go_with_a_comma() -> None:
    assert imported('Time,VR0,VR1\n"0,0","1,0",1\n"0,005","2,0",1\n"0,01",2,2\n') == THREE


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "gb18030"])
def test_encodings_are_found_out(encoding: str) -> None:
    text = "时间,运行模式,VR1\n0,1,1\n5,2,1\n10,2,2\n"
    assert imported(text.encode(encoding), "--map", "运行模式=C_RunMD", "--unit", "ms") == THREE


def test_a_late_character_decides_on_the_encoding() -> None:
    rows = "".join(f"{at},1,\n" for at in range(200_000))
    text = f"Time,VR0,Note\n{rows}200000,2,\u505c\u6b62\n"
    assert len(imported(text.encode("gb18030"))) == 200_001


def test_western_octets_are_read_too() -> None:
    assert imported("Time (\u00b5s),VR0,\u00b0C\n0,1,20\n5,2,20\n".encode("latin-1"), "--unit", "us") == [
        (0, {"C_RunMD": 1}),
        (5000, {"C_RunMD": 2}),
    ]


def test_the_lines_of_an_oscilloscope_before_the_header_are_passed_over() -> None:
    text = """Model,MDO3024
Sample Interval,4e-09
Channels,VR0 and VR1
Time,12:00
,
# exported by hand
TIME,VR(0),VR(1),CH3
-0.005,1,1,0.3
0.0,2,1,0.3
0.005,2,2,0.3
"""
    assert imported(text) == THREE


def test_a_line_of_units_below_the_header_tells_the_unit() -> None:
    assert imported("Time;VR0;VR1\n(ms);;\n0;1;1\n5;2;1\n10;2;2\n") == THREE


@pytest.mark.parametrize(
    "column", ["Time (ms)", "Time[ms]", "time_ms", "t/ms", "Timestamp ms", "\u65f6\u95f4(\u6beb\u79d2)"]
)
def test_a_header_tells_the_unit(column: str) -> None:
    assert imported(f"{column};VR0;VR1\n0;1;1\n5;2;1\n10;2;2\n") == THREE


@pytest.mark.parametrize(("unit", "scale"), [("ns", 1), ("us", 1_000), ("ms", MS), ("s", 1000 * MS)])
def test_the_option_tells_the_unit_whatever_the_header_says(unit: str, scale: int) -> None:
    said = imported("Time (ms),VR0\n0,1\n7,2\n", "--unit", unit)
    assert [time for time, _ in said] == [0, 7 * scale]


def test_a_line_of_units_shows_which_column_is_the_time() -> None:
    assert imported("Source,VR0,VR1\nSecond,Value,Value\n0.000,1,1\n0.005,2,1\n0.010,2,2\n") == THREE


def test_date_and_milliseconds_may_stand_beside_the_time_of_day() -> None:
    text = """Date,Time,Millisecond,VR0
2026/01/05,23:59:59,750,1
2026/01/06,00:00:00,5,2
"""
    times = [time for time, _ in imported(text)]
    assert times == [1_767_657_599_750 * MS, 1_767_657_600_005 * MS]


def test_a_time_with_its_date_or_in_numbers_needs_no_date_beside_it() -> None:
    assert imported("Date,Time,VR0\nx,1970-01-01 00:00:01,1\nx,2,1\n") == [
        (1000 * MS, {"C_RunMD": 1}),
        (2000 * MS, {"C_RunMD": 1}),
    ]


def test_a_table_without_header_is_read_by_numbers() -> None:
    assert (
        imported("1,0,1\n1,5,2\n2,10,2\n", "--time", "2", "--map", "3=C_RunMD,1=VR1", "--unit", "ms") == THREE
    )


def test_a_header_that_says_nothing_is_read_by_numbers() -> None:
    options = ("--time", "1", "--map", "2=C_RunMD,3=CS_RunSTA", "--unit", "ms")
    assert imported("a,b,c\n0,1,1\n5,2,1\n10,2,2\n", *options) == THREE


def test_columns_are_mapped_by_their_headers() -> None:
    text = "Clock;Mode, of the machine;x=y\n0;1;1\n5;2;1\n10;2;2\n"
    options = ("--time", "clock", "--map", "Mode, of the machine=C_RunMD,x=y=VR1", "--unit", "ms")
    assert imported(text, *options) == THREE


def test_a_mapping_comes_before_what_a_header_says() -> None:
    said = imported("Time,VR0,C_RunMD,VR5\n0,1,2,3\n", "--map", "VR0=C_RunMD", "--map", "3=CS_RunSTA")
    assert said == [(0, {"C_RunMD": 1, "CS_RunSTA": 2, "C_Cmd": 3})]


def test_an_empty_cell_is_left_out_of_its_sample() -> None:
    said = imported("Time,VR0,VR5,Note\n0,1,0,\n1,,1\n2, ,\n\n# a remark\n3,2,0,end\n")
    assert [cells for _, cells in said] == [
        {"C_RunMD": 1, "C_Cmd": 0},
        {"C_Cmd": 1},
        {},
        {"C_RunMD": 2, "C_Cmd": 0},
    ]


def test_times_below_zero_are_moved_together() -> None:
    said = imported("Time,VR0\n-0.25,1\n-0.05,1\n0.1,2\n")
    assert [time for time, _ in said] == [0, 200 * MS, 350 * MS]


def test_a_column_of_dates_and_times_is_a_time() -> None:
    said = imported(
        "TimeStamp,VR0\n2026-01-05 06:00:00.250,1\n2026-01-05 06:00:01,2\n", "--time", "TimeStamp"
    )
    assert [time for time, _ in said] == [1_767_592_800_250 * MS, 1_767_592_801_000 * MS]


@pytest.mark.parametrize(
    ("rows", "options", "line"),
    [
        (
            "0,1\n1,x\n",
            (),
            ":3: column 2 (VR0): 'x' is no number (write a number, or nothing where nothing was measured)",
        ),
        (
            "0,1\nx,1\n",
            (),
            ":3: column 1 (Time): 'x' is no time (mend or delete the line)",
        ),
        (
            "0,1\n,1\n",
            (),
            ":3: column 1 (Time): an empty cell is no time (mend or delete the line)",
        ),
        (
            "x,1\n1,1\n",
            (),
            ":2: column 1 (Time): 'x' is no time (mend or delete the line)",
        ),
        ("2,1\n1,2\n", (), ":3: column 1 (Time): the time goes backwards (sort the rows by time)"),
        ("0,1\n1e11,2\n", (), ":3: column 1 (Time): the time is out of range (mend --unit)"),
        (
            "0,0,6,0\n",
            (),
            ":2: 4 cells under 2 headers (decimal commas need another delimiter, such as a semicolon)",
        ),
        (
            '0,1\n1,"2\n',
            (),
            ":3: cannot be split into cells: unexpected end of data (mend its quotation marks)",
        ),
        ("", (), ": has no rows below its header (export the recording again)"),
        (
            "1/2/2026 6:00:00,1\n",
            (),
            ":2: column 1 (Time): '1/2/2026 6:00:00' is no time (write dates as 2026-01-31 or 31.01.2026)",
        ),
        ("0,1\n", ("--time", "Zeit"), ": has no column 'Zeit' (mend --time; its columns: Time, VR0)"),
        ("0,1\n", ("--map", "2=VR0,VR0=VR1"), ": column 2 is C_RunMD and CS_RunSTA (leave one out of --map)"),
        ("0,1\n", ("--map", "3=VR1"), ": has no column '3' (mend --map; its columns: Time, VR0)"),
        (
            "0,1\n",
            ("--map", "1=VR1"),
            ": column 1 is that of the time and of CS_RunSTA (mend --time or --map)",
        ),
    ],
)
def test_what_cannot_be_read_is_told_with_its_line_and_its_mend(
    rows: str, options: Sequence[str], line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert refused(f"Time,VR0\n{rows}", *options, capsys=capsys) == f"mmsverify: machine.csv{line}"


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", "is empty"),
        ("\n\n", "is empty"),
        ("hello\nworld\n", "has no rows of numbers and no header that names a VR cell"),
        (
            "0,1,2\n1,1,2\n",
            "no column is that of the time (say which with --time; its columns are 1 to 3, without",
        ),
        ("Time,CH1\n0,1\n", "no column names a VR cell (say which do with --map"),
        ("Time,VR0,C_RunMD\n0,1,1\n", "more than one column is C_RunMD (say which with --map 3=C_RunMD)"),
        ("a,VR0\n0,1\n", "no column is that of the time (say which with --time; its columns: a, VR0)"),
        (b"\x89PNG\r\n\x1a\n\x00\x00\x00\rIHDR" + bytes(range(256)) * 9, ""),
        ("Time,VR0\n0," + "1" * 2_000_000, "the line is too long for a table of samples"),
        ("Time,VR0\n0,1\n".encode("utf-16") + b"\x00", "the text is damaged near here"),
    ],
)
def test_what_is_no_table_of_samples_is_refused(
    text: str | bytes, line: str, capsys: pytest.CaptureFixture[str]
) -> None:
    told = refused(text, capsys=capsys)
    assert told.startswith("mmsverify: machine.csv:")
    assert line in told


@pytest.mark.parametrize(
    ("options", "line"),
    [
        (("--map", "VR0"), "--map: cannot read 'VR0' (write it like VR0=C_RunMD,VR1=CS_RunSTA)"),
        (
            ("--map", "2=C_Run"),
            "--map: 'C_Run' is no VR cell (write it like VR0=C_RunMD; the cells are C_RunMD,",
        ),
        (("--map", "2=VR0,3=C_RunMD"), "--map: two columns are C_RunMD (leave out one)"),
        (("--map", "2=VR0,2=C_Cmd"), "--map: column '2' is two cells (leave out one)"),
        (("--unit", "min"), "--unit: no unit 'min' here (one of ns, us, ms, s)"),
        (("--controller", "a/b"), "--controller: 'a/b' cannot name a channel (leave out the /)"),
        (("--sampling", "often"), "--sampling: no sampling 'often' here (scan: one row each scan; polled:"),
    ],
)
def test_a_bad_option_is_told(options: Sequence[str], line: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert refused("Time,VR0\n0,1\n", *options, capsys=capsys).startswith(f"mmsverify: {line}")


def test_a_file_that_is_not_there_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["import", "none.csv", "-o", "out.mcap"]) == 2
    assert capsys.readouterr().err == "mmsverify: none.csv: No such file or directory\n"


def channels(trace: str) -> set[tuple[str, str]]:
    """Topic and sampling of each channel."""
    return {(message.topic, message.metadata["sampling"]) for message in read_trace(trace)}


def test_the_controller_is_that_of_the_file_and_the_samples_are_polled() -> None:
    imported("Time,VR0\n0,1\n", name="press1.csv")
    assert channels("out.mcap") == {("/press1/vr", "polled")}


def test_controller_and_sampling_can_be_told() -> None:
    imported("Time,VR0\n0,1\n", "--controller", "press2", "--sampling", "scan")
    assert channels("out.mcap") == {("/press2/vr", "scan")}


def test_files_of_one_name_are_two_controllers() -> None:
    for folder in ("a", "b"):
        Path(folder).mkdir()
        Path(folder, "press.csv").write_text("Time,VR0\n0,1\n")
    assert main(["import", "a", "b", "-o", "out.mcap", "-q"]) == 0
    assert channels("out.mcap") == {("/press/vr", "polled"), ("/press-2/vr", "polled")}


def test_the_report_counts_the_samples_and_tells_what_was_not_read(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("good.csv").write_text("Time,VR0,Pressure\n0,1,7\n1,1,7\n2,2,8\n")
    Path("bad.csv").write_text("Time,VR0\n0,1\n1,x\n2,2\n")
    assert main(["import", "good.csv", "bad.csv", "-o", "out.mcap", "-q", "--format", "json"]) == 0
    fault = {"packet": 3, "layer": "csv", "reason": "column 2 (VR0): 'x' is no number"}
    assert json.loads(capsys.readouterr().out) == {
        "schema": "mmsverify.import/1",
        "inputs": [
            {"path": "good.csv", "frames": 3, "pdus": {"mms": 0, "modbus": 0, "vr": 3}, "undecoded": []},
            {"path": "bad.csv", "frames": 1, "pdus": {"mms": 0, "modbus": 0, "vr": 1}, "undecoded": [fault]},
        ],
    }


def test_the_report_in_words_tells_samples_and_lines(capsys: pytest.CaptureFixture[str]) -> None:
    Path("good.csv").write_text("Time,VR0,Pressure\n0,1,7\n1,1,7\n2,2,8\n")
    Path("bad.csv").write_text("Time,VR0\n0,1\n1,x\n2,2\n")
    main(["import", "good.csv", "bad.csv", "-o", "out.mcap", "-q"])
    assert capsys.readouterr().out.splitlines() == [
        "good.csv: 3 VR samples",
        "  column 2 (VR0) is C_RunMD",
        "  not read: column 3 (Pressure)",
        "  any number of scans may lie between two rows (--sampling scan, where every scan is one)",
        "bad.csv: 1 VR sample; 1 undecoded",
        "  line 3  csv  column 2 (VR0): 'x' is no number",
    ]


def test_a_row_that_was_cut_off_is_refused_with_its_line(capsys: pytest.CaptureFixture[str]) -> None:
    Path("cut.csv").write_text("Time;VR0;VR1\n0;1;1\n1;2\n")
    assert main(["import", "cut.csv", "-o", "out.mcap"]) == 2
    assert "cut.csv:3: 2 cells, and column 3 (VR1) is missing (it was cut off" in capsys.readouterr().err


def test_the_same_table_gives_the_same_octets() -> None:
    imported("Time,VR0\n0,1\n1,2\n")
    first = Path("out.mcap").read_bytes()
    imported("Time,VR0\n0,1\n1,2\n")
    assert Path("out.mcap").read_bytes() == first


def peak_of_reading(rows: int) -> int:
    """The most memory that reading a table of so many rows takes, in octets."""
    with open("long.csv", "w") as file:
        file.write("Time,VR0,VR1,VR5\n")
        file.writelines(f"{at / 1000},{at % 17}.0,{at % 15}.0,{at % 500}\n" for at in range(rows))
    tracemalloc.start()
    try:
        assert sum(1 for _ in CsvSamples("long.csv", Asked())) == rows
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_memory_does_not_grow_with_the_length_of_the_table() -> None:
    peak_of_reading(6_000)  # fills the caches
    held = 100  # octets, the least that a row takes which is kept
    assert peak_of_reading(36_000) - peak_of_reading(6_000) < 30_000 * held / 4
