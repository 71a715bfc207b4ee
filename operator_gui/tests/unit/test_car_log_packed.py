"""Logs that are packed, by gzip or in blocks of MF4: bounded memory, and the true reason for what cannot be read."""
# SPDX-License-Identifier: Apache-2.0
import gc
import gzip
import struct
import tracemalloc
import zlib
from unittest import mock

import can
import pytest

from mtr_operator.car_link.log import mf4_frames, mf4_log
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


@pytest.fixture
def mf4_reader(tmp_path, monkeypatch):
    """Function that replaces the program that reads an MF4 by one that writes two frames and then runs the code."""
    (tmp_path / "packages").mkdir()
    (tmp_path / "packages" / "asammdf.py").touch()
    monkeypatch.syspath_prepend(tmp_path / "packages")

    def replace(code):
        records = [mf4_frames.RECORD.pack(number, 0x100 + number, False, False, 0, 1, b"1") for number in (1, 2)]
        program = tmp_path / "reader.py"
        program.write_text("import os, signal, sys\n"
                           f"sys.stdout.buffer.write({b''.join(records)!r})\nsys.stdout.flush()\n{code}\n")
        monkeypatch.setattr(mf4_log, "READER", program)
    return replace


def mf4(folder, block=b""):
    path = folder / "bus.mf4"
    path.write_bytes(b"MDF     4.10    " + bytes(48) + block)
    return path


BOTH = [(0x101, b"1"), (0x102, b"1")]


@pytest.mark.parametrize("block", [b"", b"##DZ", zipped_block(bytes(range(200)), 200), b"##DZ" + b"\xff" * 60,
                                   zipped_block(zlib.compress(bytes(4 * MIB)), 4 * MIB)],
                         ids=["none", "signature", "no data", "no header", "4 MiB"])
def test_sound_block_of_an_mf4_is_left_to_its_package(tmp_path, mf4_reader, block):
    mf4_reader("")
    assert outcome(mf4(tmp_path, block)) == (BOTH, "")


@pytest.mark.parametrize(("code", "reason"), [
    ("os.kill(os.getpid(), signal.SIGSEGV)", "asammdf crashes"), ("os.abort()", "asammdf crashes"),
    (f"sys.exit({mf4_frames.FAILED})", "asammdf reports damage"),
    (f"sys.stdout.buffer.write(b'half a record'); sys.exit({mf4_frames.FAILED})", "asammdf reports damage")])
def test_mf4_with_which_its_package_crashes_is_used_up_to_there(tmp_path, mf4_reader, code, reason):
    mf4_reader(code)
    path = mf4(tmp_path)
    assert outcome(path) == (BOTH, f"The CAN log {path} is damaged after 2 frames ({reason}); those are used.")


def test_process_that_reads_an_mf4_ends_with_its_reader(tmp_path, mf4_reader, monkeypatch):
    mf4_reader("signal.pause()")
    started = []
    start = mf4_log.subprocess.Popen
    monkeypatch.setattr(mf4_log.subprocess, "Popen",
                        lambda *words, **options: started.append(start(*words, **options)) or started[-1])
    frames = iter(ReadLog(mf4(tmp_path)))
    assert next(frames).can_id == 0x101 and started[0].poll() is None
    frames.close()
    gc.collect()
    assert started[0].wait() < 0


def test_mf4_without_its_package_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(mf4_log.importlib.util, "find_spec", lambda _: None)
    path = mf4(tmp_path)
    assert outcome(path) == ([], f"The CAN log {path} needs the Python package asammdf, which is not installed.")


@pytest.mark.parametrize("is_fd", [False, True])
@pytest.mark.parametrize("length", [0, 8, 64, 65])
def test_record_of_an_mf4_keeps_the_frame(is_fd, length):
    data = bytes(range(length))
    read = mf4_frames.message(mf4_frames.RECORD.pack(1.5, 0x18FEF100, True, is_fd, 3, length, data))
    assert (read.timestamp, read.arbitration_id, read.is_extended_id, read.is_fd, read.channel, bytes(read.data)) == (
        1.5, 0x18FEF100, True, is_fd, 3, data)


def test_time_limit_of_an_mf4_does_not_include_who_reads_slowly(tmp_path, monkeypatch):
    order, stdout = [], mock.Mock()
    stdout.buffer.write.side_effect = lambda data: order.append(len(data) // mf4_frames.RECORD.size)
    watch = mock.Mock(dump_traceback_later=lambda *_, **__: order.append("begin"),
                      cancel_dump_traceback_later=lambda: order.append("end"))
    frames = [can.Message(timestamp=number, arbitration_id=1, data=b"1") for number in range(5)]
    monkeypatch.setattr(can, "MF4Reader", lambda _: iter(frames))
    for name, value in (("_bound_memory", lambda _: None), ("faulthandler", watch), ("_FRAMES_PER_CHECK", 2)):
        monkeypatch.setattr(mf4_frames, name, value)
    monkeypatch.setattr("sys.stdout", stdout)
    assert mf4_frames.main(str(mf4(tmp_path))) == 0
    assert order == ["begin", "end", 2, "begin", "end", 2, "begin", "end", 1]


class Reader:
    """In place of python-can's: frames, and then the error of a damaged log."""

    def __init__(self, _):
        self.frames = [can.Message(timestamp=1.0, arbitration_id=1, channel=1, data=b"ab"),
                       can.Message(timestamp=2.0, is_error_frame=True),
                       can.Message(timestamp=3.0, arbitration_id=2, is_remote_frame=True),
                       can.Message(timestamp=4.0, arbitration_id=3, channel="can0", data=b"")]

    def __iter__(self):
        yield from self.frames
        raise IndexError


def test_program_writes_data_frames_alone_and_reports_damage(tmp_path, monkeypatch, capsysbinary):
    monkeypatch.setattr(can, "MF4Reader", Reader)
    monkeypatch.setattr(mf4_frames, "_bound_memory", lambda _: None)
    monkeypatch.setattr(mf4_frames, "faulthandler", mock.Mock())
    assert mf4_frames.main(str(mf4(tmp_path))) == mf4_frames.FAILED
    written = capsysbinary.readouterr().out
    read = [mf4_frames.message(written[at:at + mf4_frames.RECORD.size])
            for at in range(0, len(written), mf4_frames.RECORD.size)]
    assert [(each.arbitration_id, each.channel, bytes(each.data)) for each in read] == [(1, 1, b"ab"), (3, 0, b"")]


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
