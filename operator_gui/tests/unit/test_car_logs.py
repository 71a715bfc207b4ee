"""Logs of a Car's bus: written and read again in each format, damaged ones, and one that is played as the Car."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import signal

import can
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.car_link.log.bus_log import BusLog
from mtr_operator.car_link.log.kept_log import KeptLog
from mtr_operator.car_link.log.log_car import LogCarLink
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed, OutputError
from mtr_operator.domain.ports import BusMark
from mtr_operator.domain.robot_status import RobotStatus


@contextlib.contextmanager
def ended_in_time():
    """What takes more than a second of processor time is ended."""
    def end(*_):
        raise TimeoutError
    before = signal.signal(signal.SIGPROF, end)
    signal.setitimer(signal.ITIMER_PROF, 1.0)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        signal.signal(signal.SIGPROF, before)


@pytest.mark.parametrize("suffix", ["blf", "asc", "trc"])
def test_log_of_each_kind_is_read_as_it_was_written(tmp_path, suffix):
    path = tmp_path / f"bus.{suffix}"
    log, frames = BusLog(path), []
    for index in range(2000):
        frame = CanFrame(0x100 + index % 7, False, bytes([index % 256]) * (index % 9), 5.0 + 0.001 * index)
        log.frame(frame, frame.arrival_s)
        frames.append((frame.can_id, frame.data))
    log.close()
    read = list(ReadLog(path))
    assert [(frame.can_id, frame.data) for frame in read] == frames
    assert (log.frames, log.origin_s, log.problem) == (2000, 5.0, "")
    assert [frame.time_s - read[0].time_s for frame in read] == pytest.approx(
        [0.001 * index for index in range(2000)], abs=1e-4)


def test_fd_frames_are_kept_as_such(tmp_path):
    log = BusLog(tmp_path / "bus.blf")
    log.frame(CanFrame(0x1ABCDEF, True, bytes(range(48)), 1.0, is_fd=True), 1.0)
    log.error_frame()
    log.close()
    frame, = ReadLog(tmp_path / "bus.blf")
    assert (frame.can_id, frame.is_extended, frame.is_fd, frame.data) == (0x1ABCDEF, True, True, bytes(range(48)))


def test_mark_says_how_far_the_kept_log_had_come_and_is_none_without_a_log(tmp_path):
    kept, log, frame = KeptLog(), BusLog(tmp_path / "bus.blf"), CanFrame(0x100, False, b"", 5.0)
    kept.frame(frame, 4.0)
    kept.restart()
    kept.status(0, 6.0, 6.1, "adapter")
    assert kept.change(log) is None and (kept.frames, kept.mark, kept.problem) == (0, None, "")
    kept.frame(frame, 5.0)
    kept.restart()
    kept.frame(frame, 0.5)
    kept.status(1, 7.0, 7.2, "adapter")
    assert kept.mark == BusMark(1, 2, 7.0, 7.2, 5.0, "adapter", 1)
    assert kept.change(None) is log and (kept.frames, kept.mark) == (0, None)
    log.close()
    assert len(list(ReadLog(tmp_path / "bus.blf"))) == 2


def test_log_that_is_cut_off_is_read_up_to_there_and_says_so(tmp_path):
    whole = tmp_path / "whole.blf"
    log = BusLog(whole)
    for index in range(4000):
        log.frame(CanFrame(0x100, False, index.to_bytes(8, "big"), 0.001 * index), 0.001 * index)
    log.close()
    torn = tmp_path / "torn.blf"
    torn.write_bytes(whole.read_bytes()[:-2000])
    read = ReadLog(torn)
    frames = list(read)
    assert 0 < len(frames) < 4000
    assert "is cut off after" in read.notice or "is damaged after" in read.notice


@pytest.mark.parametrize("length", [0, 1, 15])
def test_object_of_a_blf_that_is_shorter_than_its_header_ends_the_log(tmp_path, length):
    path = tmp_path / "bus.blf"
    with can.BLFWriter(str(path), compression_level=0) as log:
        for index in range(3):
            log.on_message_received(can.Message(timestamp=1.7e9 + index, arbitration_id=0x100, data=bytes(8)))
    whole = path.read_bytes()
    # The container's own header is before those of its three objects.
    last = whole.rindex(b"LOBJ")
    path.write_bytes(whole[:last + 6] + b"\x07\x07" + length.to_bytes(4, "little") + whole[last + 12:])
    read = ReadLog(path)
    with ended_in_time():
        assert len(list(read)) == 2
    assert read.ending.endswith(f"(in the container at byte 144, an object states a length of {length} bytes); "
                                "those are used.")


@pytest.mark.parametrize(("times_s", "words"), [
    ((0.0, 0.5, 8.0), "has a gap of 7.5 s after 2 frames"), ((0.0, 20.0, 3.0), "jumps back by 17.0 s after 2 frames"),
    ((0.0, 0.9, 0.85, 1.8), "")])
def test_gaps_and_jumps_of_a_logs_time_are_told(tmp_path, times_s, words):
    path = tmp_path / "bus.log"
    path.write_text("".join(f"({100.0 + time_s:.6f}) can0 320#0000\n" for time_s in times_s))
    read = ReadLog(path)
    assert len(list(read)) == len(times_s)
    assert words in read.notice and bool(words) == bool(read.notice)


@pytest.mark.parametrize(("name", "content", "words"), [
    ("log.blf", b"not a log at all" * 20, "damaged or of another format"), ("log.txt", b"", "is no CAN log"),
    ("log.asc", b"date\n", "holds no frame"), ("log.blf", b"", "damaged or of another format")])
def test_file_that_is_no_log_is_named(tmp_path, name, content, words):
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(ConnectionFailed, match=words):
        list(ReadLog(path))


@pytest.mark.parametrize(("name", "bad"), [
    ("bus.log", "(1.2) can0 320#" + "AA" * 65), ("bus.log", "(nan) can0 320#00"),
    ("bus.csv", "1.2,0xFFFFFFFF,0,0,0,2,AAA=")])
def test_log_ends_before_a_frame_that_no_bus_has_carried(tmp_path, name, bad):
    good = {"bus.log": "(1.0) can0 320#0000", "bus.csv": "1.0,0x320,0,0,0,2,AAA="}[name]
    head = "timestamp,arbitration_id,extended,remote,error,dlc,data\n" if name == "bus.csv" else ""
    path = tmp_path / name
    path.write_text(f"{head}{good}\n{bad}\n{good}\n")
    read = ReadLog(path)
    assert [frame.data for frame in read] == [bytes(2)]
    assert "is damaged after 1 frames" in read.ending


def test_missing_log_is_named(tmp_path):
    with pytest.raises(ConnectionFailed, match="none.blf cannot be read"):
        ReadLog(tmp_path / "none.blf")


def test_log_ends_at_its_limit_and_the_test_does_not(tmp_path):
    log = BusLog(tmp_path / "bus.asc", limit_bytes=50_000)
    for index in range(4000):
        log.frame(CanFrame(0x100, False, bytes(8), 0.001 * index), 0.001 * index)
    log.close()
    assert "has reached 0 MiB, the limit" in log.problem
    assert (tmp_path / "bus.asc").stat().st_size < 200_000


def test_mf4_needs_a_package_that_is_named(tmp_path):
    with pytest.raises(OutputError, match="asammdf"):
        BusLog(tmp_path / "bus.mf4")


@pytest.mark.parametrize(("step_s", "words"), [
    (3.0, "has a gap of 3.0 s after 300"), (-2.98, "jumps back by 3.0 s after 300")])
def test_gap_or_jump_of_a_log_that_is_played_is_a_trouble_where_it_is(tmp_path, step_s, words):
    path, message = tmp_path / "bus.log", DemoLockMessage()
    times_s = [0.02 * index + (step_s if index >= 300 else 0.0) for index in range(900)]
    path.write_text("".join(f"({100.0 + time_s:.6f}) can0 320#{message.next().hex()}\n" for time_s in times_s))
    car = LogCarLink(path, "mtr_demo_car")
    car.connect()
    problems = []
    for index in range(1, 300):
        time_s = 50.0 + 0.1 * index
        car.observe(RobotStatus(index, 1, time_s, sent_s=time_s, steady_s=time_s))
        problems.append(car.problem)
    told = [index for index, problem in enumerate(problems) if words in problem]
    # From 6 s of the log on, as long as the gap is and for a second; nothing blames a plug that a log does not have.
    lasts = round(10.0 * max(step_s, 0.0)) + 10
    assert told and 55 <= told[0] <= 62 and abs(told[-1] - told[0] - lasts) <= 1
    assert told == list(range(told[0], told[-1] + 1))
    assert set(problems[30:told[0]]) == {""}
    assert problems[-1] == f"The CAN log {path} has come to its end."
    car.close()
