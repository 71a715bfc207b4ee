"""The link to the Car through python-can's drivers: pseudo-terminal slcan adapters and the virtual bus."""
# SPDX-License-Identifier: Apache-2.0
import threading
import time

import can
import pytest
from serial_adapter import (
    LOCK_ID,
    UNLOCKED,
    Adapter,
    Course,
    adapter_fixture,
    link_fixture,
    wait_for,
)

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.domain.errors import OperatorError
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

__all__ = ["adapter_fixture", "link_fixture"]


def test_adapter_is_asked_for_time_stamps_before_it_is_opened(adapter, link):
    assert adapter.commands.index(b"S6") < adapter.commands.index(b"Z1") < adapter.commands.index(b"L")
    assert b"O" not in adapter.commands
    assert link.profile.name == "mtr_demo_car"


def test_adapter_takes_part_in_the_bus_only_when_it_is_told_to(adapter):
    link = CanCarLink("slcan", adapter.path, is_listening=False)
    link.connect()
    link.close()
    assert b"O" in adapter.commands and b"L" not in adapter.commands
    assert "normal mode" in link.record["CAN adapter"]


def test_lock_event_through_a_serial_adapter_is_timed_by_its_stamps(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    assert (link.problem, link.lock_state) == ("", LockState.LOCKED)
    changed_s = course.now_s
    event, = course.run(0.5, UNLOCKED)
    assert event.time_s == pytest.approx(changed_s, abs=0.01)
    assert event.lock_state is link.lock_state is LockState.UNLOCKED
    assert event.time_sigma_s < 0.015


def test_observe_waits_for_frames_that_precede_the_status(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    course.run(0.08)
    course.step += 1
    course.message.is_locked = UNLOCKED
    late = threading.Timer(0.05, adapter.send, (course.message.next(), course.now_s - 0.013))
    late.start()
    events = link.observe(RobotStatus(9999, 1, round(course.now_s, 6)))
    late.join()
    assert [event.lock_state for event in events] == [LockState.UNLOCKED]


def test_adapter_says_that_all_frames_are_here_to_a_robot_whose_time_stands(adapter, link):
    """No later frame tells it, and the machine may be busy: what is measured in lock-step does not depend on it."""
    course = Course(link, adapter.send)
    course.run(4.0)
    course.step += 25
    course.message.is_locked = UNLOCKED
    told = threading.Event()
    adapter.flags = b""
    late = threading.Timer(0.6, lambda: (adapter.send(course.message.next(), course.now_s - 0.3), told.set(),
                                         adapter.send_bytes(b"F00\r" * 100)))
    late.start()
    link.observe(RobotStatus(9998, 1, round(course.now_s, 6), waits_for_answer=True))
    # The frame is farther from the Status than frames are from each other, and nothing comes behind it.
    assert told.is_set() and link.frames_received == 201
    late.join()
    adapter.flags = b"F00\r"
    started = time.monotonic()
    for number in range(5):
        link.observe(RobotStatus(9999 + number, 1, round(course.now_s + 0.01, 6), waits_for_answer=True))
    assert time.monotonic() - started < 0.6


def test_observe_waits_no_longer_than_the_limit(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    started = time.monotonic()
    course.run(0.6, data=None)
    # Six Statuses without frames: the first waits a quarter of a second, the others do not, or the answers of a robot
    # that sends ten a second would be so late that it calls its Operator silent.
    assert time.monotonic() - started < 1.0
    assert "No CAN frame" in link.problem and link.lock_state is LockState.UNKNOWN
    started = time.monotonic()
    # Fifty Statuses, which would take a quarter of a second each.
    course.run(5.0, data=None)
    assert time.monotonic() - started < 5.0


def test_adapter_without_stamps_is_read_by_arrival():
    adapter = Adapter(stamps=False, answer=b"\a")
    # Arrivals on the wall clock in lock-step would be those of a robot whose clock races and stalls.
    link = CanCarLink("slcan", adapter.path, clock=lambda: course.now_s)
    course = Course(link, adapter.send)
    try:
        link.connect()
        course.run(4.0)
        assert link.problem == ""
        assert [event.lock_state for event in course.run(1.0, UNLOCKED)] == [LockState.UNLOCKED]
    finally:
        link.close()
        adapter.close()


def test_garbage_between_frames_is_survived(adapter, link):
    adapter.send_bytes(b"t32\r\xff\xfet3204zz\rt9\rQQQ\r\a" + bytes(range(1, 128)) * 6 + b"\r")
    course = Course(link, adapter.send)
    course.run(4.0)
    assert (link.problem, link.lock_state) == ("", LockState.LOCKED)


def test_bus_off_is_a_problem_while_it_lasts(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    adapter.flags = b"FA4\r"
    wait_for(lambda: "bus-off" in link.problem)
    assert link.lock_state is LockState.UNKNOWN
    adapter.flags = b"F00\r"
    wait_for(lambda: link.problem == "")


def test_pulled_adapter_is_a_problem(adapter, link):
    Course(link, adapter.send).run(4.0)
    adapter.pull()
    wait_for(lambda: "adapter" in link.problem)
    assert link.lock_state is LockState.UNKNOWN


def test_adapter_that_comes_back_is_used_again(adapter, link, tmp_path):
    name = tmp_path / "can"
    name.symlink_to(adapter.path)
    other = CanCarLink("slcan", str(name))
    link.close()
    other.connect()
    second = Adapter()
    try:
        adapter.pull()
        wait_for(lambda: "adapter" in other.problem)
        name.unlink()
        name.symlink_to(second.path)
        wait_for(lambda: b"L" in second.commands and "adapter" not in other.problem)
        course = Course(other, second.send)
        course.run(4.0, UNLOCKED)
        assert (other.problem, other.lock_state) == ("", LockState.UNLOCKED)
    finally:
        other.close()
        second.close()


def test_link_that_is_not_connected_says_so(adapter):
    link = CanCarLink("slcan", adapter.path)
    assert "not connected" in link.problem and link.lock_state is LockState.UNKNOWN
    with pytest.raises(OperatorError, match="not connected"):
        link.observe(RobotStatus(1, 1, 1.0))
    link.close()


def test_any_other_driver_of_python_can_works_too():
    link = CanCarLink("virtual", "mtr-test", clock=lambda: course.now_s)
    with can.Bus(interface="virtual", channel="mtr-test") as car:
        def send(data, _time_s):
            car.send(can.Message(arbitration_id=LOCK_ID, data=data, is_extended_id=False))

        course = Course(link, send)
        link.connect()
        try:
            course.run(4.0)
            assert link.problem == ""
            assert [event.lock_state for event in course.run(1.0, UNLOCKED)] == [LockState.UNLOCKED]
            link.error_frame()
            course.run(0.1)
            assert "error frames" in link.problem and link.lock_state is LockState.UNKNOWN
            course.run(1.1)
            assert link.problem == ""
        finally:
            link.close()
            link.close()


def test_overrun_of_the_adapter_is_told_and_is_over_after_a_second(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    adapter.flags = b"F08\r"
    wait_for(lambda: "lost frames" in link.problem)
    adapter.flags = b"F00\r"
    asked = adapter.commands.count(b"F")
    # An answer with the old flags may be on its way; it stands before this question, and before all frames to come.
    wait_for(lambda: adapter.commands.count(b"F") > asked)
    course.run(2.0)
    assert link.problem == "" and link.lock_state is LockState.LOCKED


def test_fd_frames_of_a_serial_adapter_are_read(adapter):
    link = CanCarLink("slcan", adapter.path, data_bitrate=2_000_000)
    link.connect()
    try:
        assert adapter.commands.index(b"S6") < adapter.commands.index(b"Y2") < adapter.commands.index(b"L")
        adapter.send_bytes(b"b1239%s0010\r" % (b"AB" * 12) + b"D000012344%s\r" % (b"01" * 4))
        wait_for(lambda: link.frames_received == 2)
        rows = {row.can_id: row.data for row in link.messages.messages}
        assert rows == {0x123: b"\xab" * 12, 0x1234: b"\x01" * 4}
    finally:
        link.close()
