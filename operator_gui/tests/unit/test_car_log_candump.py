"""What candump shows on a console: binary data, and times of each of its options."""
# SPDX-License-Identifier: Apache-2.0
import random

import pytest

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed


def log_of(folder, lines):
    path = folder / "bus.log"
    path.write_text("".join(f"{line}\n" for line in lines))
    return ReadLog(path)


def line(time_s, words, can_id=0x321, bus=0):
    return f" ({time_s:010.6f})  can{bus}  {can_id:03X}   [{len(words)}]  {' '.join(words)}"


@pytest.mark.parametrize("size", range(9))
def test_binary_data_of_a_console_is_read(tmp_path, size):
    datas = [bytes((first + at) % 256 for at in range(size)) for first in range(0, 256, 5)]
    read = log_of(tmp_path, [line(0.1 * at, [f"{byte:08b}" for byte in data]) for at, data in enumerate(datas)])
    assert [frame.data for frame in read] == datas and read.notice == ""


@pytest.mark.parametrize("word", ["0000010", "00000102", "010", "100", "0x010", "000000010", "1_0", "+1", "-1"])
def test_word_that_is_no_byte_is_refused_with_its_line(tmp_path, word):
    read = log_of(tmp_path, [line(1.0, ["01", "02"]), line(2.0, ["01", word])])
    assert [frame.data for frame in read] == [b"\1\2"]
    assert "line 2 has a byte of data that is no number" in read.notice


def test_binary_and_hexadecimal_words_in_one_line_are_refused(tmp_path):
    with pytest.raises(ConnectionFailed, match="line 1 has a byte of data that is no number"):
        log_of(tmp_path, [line(1.0, ["00000001", "10"])])


# Words of data of other kinds of line that are no byte.
OTHERS = {
    "asc": "base hex  timestamps absolute\n 0.1 1  321  Rx   d 2 01 02\n 0.2 1  321  Rx   d 2 01 {}\n",
    "fd.asc": "base hex  timestamps absolute\n 0.1 CANFD 1 Rx 321 1 0 2 2 01 02\n 0.2 CANFD 1 Rx 321 1 0 2 2 01 {}\n",
    "trc": ";$FILEVERSION=1.1\n 1) 1.0 Rx 0321 2 01 02\n 2) 2.0 Rx 0321 2 01 {}\n",
    "csv": "Time,ID,DLC,Data\n0.1,321,2,01 02\n0.2,321,2,01 {}\n",
    "busmaster": "***HEX***\n22:13:20:0000 Rx 1 0x321 s 2 01 02\n22:13:21:0000 Rx 1 0x321 s 2 01 {}\n"}


@pytest.mark.parametrize("kind", OTHERS)
@pytest.mark.parametrize("word", ["00000010", "010", "1_0", "+1"])
def test_word_of_another_kind_of_line_that_is_no_byte_is_refused_with_its_line(tmp_path, kind, word):
    path = tmp_path / "bus.txt"
    path.write_text(OTHERS[kind].format(word))
    read = ReadLog(path)
    assert [frame.data for frame in read] == [b"\1\2"]
    assert f"line 3 {'has a byte of data that is no number' if kind != 'csv' else 'has '}" in read.notice


def ticks(count, cycle_s, at_once, buses=1, jitter_s=0.0):
    """Times and buses of frames, of which some come at once."""
    values = random.Random(1)
    stamps = [(cycle_s * tick + (values.uniform(0.0, jitter_s) if tick else 0.0), index % buses)
              for tick in range(count) for index in range(at_once)]
    return [(round(time_s, 6), bus) for time_s, bus in stamps]


def swapped():
    """Of two interfaces, of which the second one's frames are shown a little late."""
    return [stamp for tick in range(100) for stamp in ((0.01 * tick + 0.0002 * bool(tick), 0), (0.01 * tick, 1))]


def falling_asleep():
    """A bus whose messages become rare, with the jitter of real ones."""
    values, time_s, stamps = random.Random(2), 0.0, []
    for step_s in [0.01] * 50 + [1.0] * 50:
        stamps.append((round(time_s, 6), 0))
        time_s += step_s * values.uniform(0.98, 1.02)
    return stamps


COURSES = {
    "single": ticks(200, 0.01, 1), "pairs": ticks(100, 0.01, 2), "five at once": ticks(40, 0.02, 5),
    "twenty at once": ticks(10, 0.02, 20), "two buses": ticks(100, 0.01, 2, buses=2),
    "two buses, four at once": ticks(50, 0.01, 4, buses=2), "jitter": ticks(200, 0.01, 1, jitter_s=0.002),
    "jitter of two buses": ticks(200, 0.01, 1, buses=2, jitter_s=0.002), "swapped": swapped(),
    "four": ticks(4, 0.1, 1), "four of two": ticks(2, 0.1, 2), "six of two": ticks(3, 0.1, 2),
    "late start": [(0.0, 0), *((5.0 + 0.01 * at, 0) for at in range(100))], "falling asleep": falling_asleep(),
    "more than the head": ticks(1500, 0.01, 2)}


@pytest.mark.parametrize("course", COURSES)
@pytest.mark.parametrize("option", ["z", "d", "a"])
def test_times_of_a_console_are_told_from_steps(tmp_path, course, option):
    stamps, lines, last_s = COURSES[course], [], 0.0
    for time_s, bus in stamps:
        shown_s = {"z": time_s, "d": time_s - last_s, "a": 1.7e9 + time_s}[option]
        lines.append(line(shown_s, ["01"], 0x100 + len(lines) % 1000, bus))
        last_s = time_s
    frames = list(log_of(tmp_path, lines))
    assert [frame.time_s - frames[0].time_s for frame in frames] == pytest.approx(
        [time_s for time_s, _ in stamps], abs=5e-5)
