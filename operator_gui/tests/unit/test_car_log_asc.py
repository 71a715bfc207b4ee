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
