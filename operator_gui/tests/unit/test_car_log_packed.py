"""Logs that are packed, by gzip or in blocks of MF4: bounded memory, and the true reason for what cannot be read."""
# SPDX-License-Identifier: Apache-2.0
import gzip
import struct
import tracemalloc
import zlib

import can
import pytest

from mtr_operator.car_link.log.mf4_log import MAX_BLOCK_BYTES
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

MIB = 1024 ** 2


def outcome(path):
    """Frames, and the sentence that says what is wrong."""
    try:
        read = ReadLog(path)
        return [(frame.can_id, frame.data) for frame in read], read.ending
    except ConnectionFailed as error:
        return [], str(error)


def zipped_block(packed, stated):
    return struct.pack("<4s4xQQ2sBxLQQ", b"##DZ", 48 + len(packed), 0, b"DT", 0, 0, stated, len(packed)) + packed


@pytest.mark.parametrize("stated", [0, 4096, 40 * MIB])
def test_block_of_an_mf4_that_inflates_to_more_than_it_may_is_refused_in_little_memory(tmp_path, stated):
    path = tmp_path / "bus.mf4"
    packed = zlib.compress(bytes(40 * MIB), 9)
    path.write_bytes(b"MDF     4.10    " + bytes(48) + zipped_block(zlib.compress(bytes(MIB)), MIB)
                     + zipped_block(packed, stated))
    place = path.read_bytes().rindex(b"##DZ")
    tracemalloc.start()
    frames, sentence = outcome(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert frames == [] and sentence == (f"The CAN log {path} cannot be read: the compressed block at byte {place} "
                                         "inflates to more than 16 MiB.")
    assert peak < 2 * MAX_BLOCK_BYTES + 8 * MIB


@pytest.mark.parametrize("block", [b"", b"##DZ", zipped_block(bytes(range(200)), 200), b"##DZ" + b"\xff" * 60,
                                   zipped_block(zlib.compress(bytes(4 * MIB)), 4 * MIB)],
                         ids=["none", "signature", "no data", "no header", "4 MiB"])
def test_sound_block_of_an_mf4_is_left_to_its_package(tmp_path, monkeypatch, block):
    path = tmp_path / "bus.mf4"
    path.write_bytes(b"MDF     4.10    " + bytes(48) + block)
    frame = can.Message(timestamp=1.0, arbitration_id=0x100, is_extended_id=False, data=b"1")
    monkeypatch.setattr(can, "MF4Reader", lambda _: [frame])
    assert outcome(path) == ([(0x100, b"1")], "")


@pytest.mark.parametrize(("begin", "kind"), [(b"LOGG", "blf"), (b"MDF     4.10", "mf4"), (b"SQLite format 3\0", "db")])
@pytest.mark.parametrize("name", ["bus.blf.gz", "bus.gz", "bus.log"])
def test_packed_log_that_is_no_text_is_to_be_unpacked(tmp_path, begin, kind, name):
    path = tmp_path / name
    path.write_bytes(gzip.compress(begin + bytes(500)))
    frames, sentence = outcome(path)
    assert frames == [] and sentence.endswith(
        f" cannot be read: it is a log of the kind {kind} that was packed with gzip; unpack it first.")


def test_packed_text_that_inflates_to_much_is_read_in_little_memory(tmp_path):
    path = tmp_path / "bus.log.gz"
    path.write_bytes(gzip.compress(b"(1.0) can0 321#00\n" + b" " * 20 * MIB + b"\n" + b"1" * 4 * MIB))
    tracemalloc.start()
    frames, _ = outcome(path)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert frames == [(0x321, b"\0")] and peak < 4 * MIB


@pytest.mark.parametrize("length", [12, 40, 1500, -30, -9, -4])
@pytest.mark.parametrize("is_cut_off", [True, False], ids=["cut off", "changed"])
def test_packed_text_that_is_cut_off_or_changed_says_so(tmp_path, length, is_cut_off):
    path = tmp_path / "bus.log.gz"
    lines = "".join(f"({number / 100}) can0 321#{number * 2654435761 % 2 ** 32:08X}\n" for number in range(300))
    whole = gzip.compress(lines.encode())
    place = length % len(whole)
    changed = whole[:place] + bytes([whole[place] ^ 0x55]) + whole[place + 1:]
    path.write_bytes(whole[:length] if is_cut_off else changed)
    frames, sentence = outcome(path)
    assert "its packed data is c" in sentence
    assert ("is damaged after " if frames else "cannot be read: ") in sentence
    if is_cut_off:
        good = [(0x321, (number * 2654435761 % 2 ** 32).to_bytes(4, "big")) for number in range(len(frames))]
        assert frames == good and len(frames) >= {1500: 80, -30: 250, -9: 300, -4: 300}.get(length, 0)
