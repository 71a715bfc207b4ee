"""Refusals of textual logs quote the first line that is not understood, and never a header that is."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

ASC = "date Tue Nov 14 10:13:20.000 pm 2023\nbase hex  timestamps absolute\n// version 9.0.0\n"
TABLE = "Time,ID,DLC,Data\n"
NUMBERED = "No,Time,ID,DLC,Data\n"
TRC = ";$FILEVERSION=1.1\n;\n"


def refusal(folder, name, text):
    path = folder / name
    path.write_text(text)
    with pytest.raises(ConnectionFailed) as raised:
        list(ReadLog(path))
    return str(raised.value)


@pytest.mark.parametrize("name", ["bus.csv", "bus.txt", "bus.data"])
@pytest.mark.parametrize(("row", "reason"), [
    ("10:13:20.5,321,1,01", "has the time 10:13:20.5, which is no number"),
    ("2023-14-11 10:13:20,321,1,01", "has the time 2023-14-11 10:13:20, which is no number"),
    ("14.11.2023 10:13,321,1,01", "has the time 14.11.2023 10:13, which is no number"),
    ("1.000.5,321,1,01", "has the time 1.000.5, which is no number"),
    (",321,1,01", "has the time , which is no number"),
    ("0.1,321x,1,01", "has the identifier 321x, which is no hexadecimal number"),
    ("0.1,321h,1,01", "has the identifier 321h, which is no hexadecimal number"),
    ("0.1,3_2,1,01", "has the identifier 3_2, which is no hexadecimal number"),
    ("0.1,DOORS,1,01", "has the identifier DOORS, which is no hexadecimal number")])
@pytest.mark.parametrize("head", [TABLE, NUMBERED], ids=["time first", "number first"])
def test_row_of_a_table_is_refused_with_its_line_and_reason(tmp_path, name, row, reason, head):
    rows = [f"{at},{row}" if head is NUMBERED else row for at in range(3)]
    sentence = refusal(tmp_path, name, head + "\n".join(rows) + "\n")
    assert f'holds no frame that is understood: line 2 {reason}: "{rows[0]}".' in sentence


def test_time_with_points_between_thousands_is_refused_with_its_line(tmp_path):
    sentence = refusal(tmp_path, "bus.csv", TABLE.replace(",", ";") + "1.000,5;321;1;01\n")
    assert 'line 2 has the time 1.000,5, which is no number: "1.000,5;321;1;01".' in sentence


@pytest.mark.parametrize(("name", "text", "line"), [
    ("bus.asc", ASC + " 0.1 CAN1  321  Rx   d 1 01\n" * 2, 'line 4 is not understood: "0.1 CAN1  321  Rx   d 1 01"'),
    ("bus.asc", ASC[:ASC.index("base")] + " 0.1 CAN1 321 Rx d 1 01\n", 'line 2 is not understood: "0.1 CAN1 321'),
    ("bus.txt", ASC + "\n 0.1 CAN1  321  Rx   d 1 01\n", 'line 5 is not understood: "0.1 CAN1  321  Rx   d 1 01"'),
    ("bus.asc", ASC + " 0:01 1 321 Rx d 1 01\n", 'line 4 is not understood: "0:01 1 321 Rx d 1 01"'),
    ("bus.trc", TRC + "one) 1.0 Rx 0321 1 01\n", 'line 3 is not understood: "one) 1.0 Rx 0321 1 01"'),
    ("bus.log", "***BUSMASTER Ver 3.2.2***\n***HEX***\nrubbish\n", 'line 3 is not understood: "rubbish"')])
def test_line_behind_an_understood_header_is_quoted(tmp_path, name, text, line):
    assert f"holds no frame that is understood: {line}" in refusal(tmp_path, name, text)


@pytest.mark.parametrize(("name", "text"), [("bus.asc", ASC), ("bus.csv", TABLE), ("bus.trc", TRC), ("bus.txt", TABLE),
                                            ("bus.asc", ASC + " 0.1 1 321 Rx r\n"), ("bus.csv", NUMBERED)])
def test_log_of_a_header_alone_holds_no_frame_and_blames_no_line(tmp_path, name, text):
    sentence = refusal(tmp_path, name, text)
    assert sentence.endswith("bus" + name[3:] + " holds no frame.")


@pytest.mark.parametrize("text", ["2023-11-14T22:13:{:05.2f}", "2023-11-14 22:13:{:06.3f}",
                                  "2023-11-14T22:13:{:09.6f}Z", "2023-11-14T22:13:{:08.5f}+01:00",
                                  "2023-11-14 22:13:{:012.9f} -0530"])
def test_dates_of_a_table_are_read(tmp_path, text):
    path = tmp_path / "bus.csv"
    times_s = [20.0, 20.25, 21.5, 59.75]
    path.write_text(TABLE + "".join(f"{text.format(time_s)},321,1,01\n" for time_s in times_s))
    read = ReadLog(path)
    frames = list(read)
    assert [frame.time_s - frames[0].time_s for frame in frames] == pytest.approx([0.0, 0.25, 1.5, 39.75], abs=1e-6)


def test_header_with_another_first_column_is_not_left_out(tmp_path):
    path = tmp_path / "bus.csv"
    path.write_text(f"{NUMBERED}1,0.0,321,1,01\n{NUMBERED}2,0.1,321,1,02\n")
    read = ReadLog(path)
    assert [frame.data for frame in read] == [b"\1", b"\2"] and read.notice == ""


@pytest.mark.parametrize("head", ["", "Time     ID        DLC       Data                    Comment\n"])
def test_canhacker_trace_without_decimals_is_no_trace_of_pcan(tmp_path, head):
    rows = [f"{10 * at}   321      2           01 02\n" for at in range(20)]
    number = head.count("\n") + 1
    assert f'line {number} is not understood: "0   321      2           01 02"' in refusal(
        tmp_path, "bus.trc", head + "".join(rows))
