"""Lines of ASC logs that look alike: CAN FD frames of few bytes, and identifiers that could be names."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.log.bus_log import BusLog
from mtr_operator.car_link.log.read_log import ReadLog

FD_LENGTHS = (*range(9), 12, 16, 20, 24, 32, 48, 64)
HEAD = "date Tue Nov 14 10:13:20.000 pm 2023\nbase {}  timestamps absolute\ninternal events logged\n"


def log_of(folder, lines, base="hex"):
    path = folder / "bus.asc"
    path.write_text(HEAD.format(base) + "".join(f"{line}\n" for line in lines))
    return path


def data_of(length):
    """With every value as the first byte."""
    return [bytes([first, *range(1, length)]) for first in range(256)] if length else [b""]


@pytest.mark.parametrize("length", FD_LENGTHS)
def test_fd_frames_of_each_length_and_first_byte_are_read_as_they_were_written(tmp_path, length):
    path, written = tmp_path / "bus.asc", data_of(length)
    log = BusLog(path, is_fd=True)
    for index, data in enumerate(written):
        log.frame(CanFrame(0x321, False, data, 0.001 * index, is_fd=True), 0.001 * index)
    log.close()
    read = ReadLog(path)
    frames = list(read)
    assert [(frame.can_id, frame.is_fd, frame.data) for frame in frames] == [(0x321, True, data) for data in written]
    assert read.notice == ""


@pytest.mark.parametrize("name", ["", "DOORS", "_0", "b1"])
@pytest.mark.parametrize("end", ["", "102203  133   303000 a0028d2e 46500250 4b140250 20011736 2001040d",
                                 "0    0     1000        0        0        0        0        0"])
@pytest.mark.parametrize("bits", ["0 0", "1 0", "0 1"])
def test_fd_frames_are_read_with_and_without_name_and_duration(tmp_path, name, end, bits):
    written = [(code, data) for code, length in enumerate(FD_LENGTHS) for data in data_of(length)[::5]]
    path = log_of(tmp_path, [
        f"   {0.001 * index:.6f} CANFD   1 Rx        321  {name:>32} {bits} {code:x} {len(data):2d} "
        f"{' '.join(f'{byte:02x}' for byte in data)}   {end}" for index, (code, data) in enumerate(written)])
    read = ReadLog(path)
    assert [frame.data for frame in read] == [data for _, data in written] and read.notice == ""


# Names that are hexadecimal numbers as well, and one that Python takes for one.
NAMES = {"FD": (0x321, False), "BC": (0x322, False), "DD": (0x18DA10F1, True), "FACE": (0x324, False),
         "A_B": (0x325, False), "12": (0x326, False), "ADx": (0x327, False), "DOORS": (0x328, False)}
KINDS = {"classic": "{:.6f} 1  {:<15} Rx   d 2 01 02", "fd": "{:.6f} CANFD   1 Rx   {}    1 0 2  2 01 02",
         "named fd": "{:.6f} CANFD   1 Rx   {}  DOORS  1 0 2  2 01 02"}


def identifiers(folder, kind, words, base="hex", end=""):
    """Of frames whose identifiers are these words; the sentence is that of the log."""
    lines = [KINDS[kind].format(0.1 * at, word) + end for at, word in enumerate(words)]
    read = ReadLog(log_of(folder, lines, base), NAMES)
    return [(frame.can_id, frame.is_extended) for frame in read], read.notice


@pytest.mark.parametrize("kind", KINDS)
def test_hexadecimal_identifier_is_no_name(tmp_path, kind):
    words = ["FD", "bc", "BC", "DD", "DDx", "12", "12x", "ADx", "321"]
    assert identifiers(tmp_path, kind, words) == ([
        (0xFD, False), (0xBC, False), (0xBC, False), (0xDD, False), (0xDD, True), (0x12, False), (0x12, True),
        (0xAD, True), (0x321, False)], "")


@pytest.mark.parametrize("kind", KINDS)
def test_name_that_is_no_identifier_is_a_name(tmp_path, kind):
    assert identifiers(tmp_path, kind, ["FACE", "A_B", "DOORS"]) == ([NAMES["FACE"], NAMES["A_B"], NAMES["DOORS"]], "")
    assert identifiers(tmp_path, kind, ["FACE", "FD", "12", "BC"], "dec") == (
        [NAMES["FACE"], NAMES["FD"], (12, False), NAMES["BC"]], "")


@pytest.mark.parametrize("kind", KINDS)
def test_log_with_names_in_place_of_identifiers_has_them_everywhere(tmp_path, kind):
    words = ["BC", "DOORS", "FD", "DD", "123"]
    assert identifiers(tmp_path, kind, words) == ([*map(NAMES.get, words[:-1]), (0x123, False)], "")


@pytest.mark.parametrize(("word", "written", "found"), [
    ("BC", "188", (0xBC, False)), ("BC", "802", (0x322, False)), ("DD", "416944369x", (0x18DA10F1, True)),
    ("ABC", "5", (5, False)), ("OTHER", "5x", (5, True)), ("123", "291", (0x123, False))])
def test_identifier_behind_the_data_tells_names_from_numbers(tmp_path, word, written, found):
    end = f"  Length = 244000 BitCount = 125 ID = {written}"
    assert identifiers(tmp_path, "classic", [word], end=end) == ([found], "")
