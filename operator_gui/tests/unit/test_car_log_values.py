"""Values in logs that cannot be: each is refused with its line, and no sentence repeats hundreds of digits."""
# SPDX-License-Identifier: Apache-2.0
import base64

import can
import pytest

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

HEAD = "timestamp,arbitration_id,extended,remote,error,dlc,data\n"
GVRET = "Time Stamp,ID,Extended,Dir,Bus,LEN,D1,D2,D3,D4,D5,D6,D7,D8\n"
TRC = ";$FILEVERSION=2.1\n;$COLUMNS=N,O,T,B,I,d,R,L,D\n"
# Header, and a line with a time; BUSMASTER has hours.
KINDS = {
    "candump.log": ("", "({}) can0 321#0100"), "console.log": ("", " ({})  can0  321   [2]  01 00"),
    "vector.asc": ("base hex  timestamps absolute\n", "   {}.0 1  321             Rx   d 2 01 00"),
    "steps.asc": ("base hex  timestamps relative\n", "   {}.0 1  321             Rx   d 2 01 00"),
    "fd.asc": ("base hex  timestamps absolute\n", "   {}.0 CANFD   1 Rx   321   1 0 2  2 01 00"),
    "pcan.trc": (TRC, "      1  {}.0 DT 1 0321 Rx -  2    01 00"),
    "hacker.trc": ("Time     ID        DLC       Data   Comment\n", "{}.0   321      2           01 00"),
    "gvret.csv": (GVRET, "{}000000,00000321,false,Rx,0,2,01,00,"), "can.csv": (HEAD, "{}.0,0x321,0,0,0,2,AQA="),
    "semicolons.csv": ("Time (s);ID;Ext;Bus;DLC;Data\n", "{};321;0;0;2;0100"),
    "master.log": ("***BUSMASTER Ver 3.2.2***\n***HEX***\n", "{}:00:00:0000 Rx 1 0x321 s 2 01 00"),
    "ovms.crtd": ("1.0 CXX OVMS CRTD\n", "{}.0 1R11 321 01 00"), "colon.txt": ("", "{}.0   0x321: 01 00"),
}


def lines_of(name, times):
    head, line = KINDS[name]
    return head + "".join(f"{line.format(time)}\n" for time in times)


def outcome(path):
    """Number of frames, and all sentences."""
    try:
        read = ReadLog(path)
        return len(list(read)), read.notice
    except ConnectionFailed as error:
        return 0, str(error)


@pytest.mark.parametrize("name", KINDS)
@pytest.mark.parametrize("absurd", ["9" * 301, "1" + "0" * 400, "9" * 15], ids=["1e301", "inf", "1e15"])
def test_time_that_no_clock_shows_ends_the_log_with_its_line(tmp_path, name, absurd):
    path = tmp_path / name
    path.write_text(lines_of(name, [1, 2, absurd, 3]))
    number = KINDS[name][0].count("\n") + 3
    read = ReadLog(path)
    assert len(list(read)) == 2 and f"is damaged after 2 frames (line {number} has the time " in read.ending
    assert "which no clock shows" in read.ending and len(read.ending) < 250 + len(str(path))


@pytest.mark.parametrize("name", KINDS)
def test_log_with_absurd_times_alone_is_refused_with_its_first_line(tmp_path, name):
    path = tmp_path / name
    path.write_text(lines_of(name, ["9" * 301] * 4))
    count, sentence = outcome(path)
    assert count == 0 and f"line {KINDS[name][0].count(chr(10)) + 1} has the time " in sentence
    assert len(sentence) < 300 + len(str(path))


@pytest.mark.parametrize("time_s", [0, 1.7e9, 4.0e9])
def test_times_of_clocks_are_accepted(tmp_path, time_s):
    for name in KINDS:
        path = tmp_path / name
        path.write_text(lines_of(name, [int(time_s) // 3600 + index for index in range(3)]))
        count, sentences = outcome(path)
        assert count == 3 and "damaged" not in sentences


@pytest.mark.parametrize("text", ["9" * 301, "-" + "9" * 301, "inf", "nan", "1e300"])
def test_times_of_candump_in_any_notation_are_refused(tmp_path, text):
    path = tmp_path / "bus.log"
    path.write_text(lines_of("candump.log", [1, text]))
    count, sentences = outcome(path)
    assert count == 1 and "(line 2 has the time " in sentences


def test_blf_with_an_absurd_time_ends_there(tmp_path):
    path = tmp_path / "bus.blf"
    with can.BLFWriter(str(path), compression_level=0) as log:
        for index in range(3):
            log.on_message_received(can.Message(timestamp=1.7e9 + index, arbitration_id=0x100, data=bytes(8)))
    whole = path.read_bytes()
    last = whole.rindex(b"LOBJ")
    # Units of 10 microseconds, and the largest number of them.
    path.write_bytes(whole[:last + 16] + b"\1\0\0\0" + whole[last + 20:last + 24] + b"\xff" * 8 + whole[last + 32:])
    count, sentences = outcome(path)
    assert count == 2 and "(the next frame has the time 1.84e+14 s, which no clock shows)" in sentences


@pytest.mark.parametrize("size", range(1, 9))
def test_hexadecimal_data_in_a_table_of_base64_is_refused_with_its_line(tmp_path, size):
    path, good, bad = tmp_path / "bus.csv", bytes(range(size)), bytes(range(1, size + 1))
    rows = [base64.b64encode(good).decode(), bad.hex(), base64.b64encode(good).decode()]
    path.write_text(HEAD + "".join(f"{at}.0,0x321,0,0,0,{size},{data}\n" for at, data in enumerate(rows)))
    read = ReadLog(path)
    assert [frame.data for frame in read] == [good, good]
    assert "has 1 line that is not understood and left out; line 3 has " in read.notice
    path.write_text(HEAD + f"1.0,0x321,0,0,0,{size},{bad.hex()}\n" * 3)
    count, sentence = outcome(path)
    assert count == 0 and "line 2 has " in sentence and "base64" in sentence


@pytest.mark.parametrize(("length", "data"), [(8, "AAA="), (0, "AAA="), (1, "AAA="), (3, "AAA="), (64, "AAA=")])
def test_length_that_contradicts_the_data_is_refused(tmp_path, length, data):
    path = tmp_path / "bus.csv"
    path.write_text(f"{HEAD}1.0,0x321,0,0,0,{length},{data}\n")
    count, sentence = outcome(path)
    assert count == 0 and f"line 2 has 2 bytes of data as base64, and says {length}" in sentence


def test_sentence_of_a_line_has_no_control_characters(tmp_path):
    path = tmp_path / "bus.log"
    path.write_text("(1.0) can0 321#0100\n(2.0) can0 321#\x1b[2J\0\n")
    count, sentences = outcome(path)
    assert count == 1 and "line 2 " in sentences and sentences.isprintable()
