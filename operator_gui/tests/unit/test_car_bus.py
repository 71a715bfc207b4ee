"""The link to the Car through python-can's drivers: pseudo-terminal slcan adapters and the virtual bus."""
# SPDX-License-Identifier: Apache-2.0
import os
import select
import threading
import time
import tty

import can
import pytest

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.fake_message import DemoLockMessage
from mtr_operator.domain.errors import ConnectionFailed, InvalidParameter, OperatorError
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import RobotStatus

LOCK_ID = 0x320
LOCKED, UNLOCKED = True, False
WAIT_S = 5.0


class Adapter:
    """slcan adapter on a pseudo-terminal: answers commands in a thread, sends what the test says."""

    def __init__(self, stamps=True, answer=b"\r"):
        self.master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.path = os.ttyname(self._slave)
        self.flags = b"F00\r"
        self.commands = []
        self._stamps, self._answer = stamps, answer
        self._wake = os.pipe()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()

    def _serve(self):
        while self._wake[0] not in select.select([self.master, self._wake[0]], [], [])[0]:
            for command in os.read(self.master, 1000).split(b"\r")[:-1]:
                self.commands.append(command)
                os.write(self.master, self.flags if command == b"F" else self._answer)

    def send(self, data, time_s, can_id=LOCK_ID):
        """Frame stamped with this time of the adapter's clock."""
        stamp = b"%04X" % (round(time_s * 1000) % 60_000) if self._stamps else b""
        self.send_bytes(b"t%03X%d%s%s\r" % (can_id, len(data), data.hex().upper().encode(), stamp))

    def send_bytes(self, data):
        """Anything."""
        os.write(self.master, data)

    def close(self):
        """Pull the plug; safe to call twice."""
        if self._thread is None:
            return
        os.write(self._wake[1], b"x")
        self._thread.join()
        self._thread = None
        for file in (self._slave, self.master, *self._wake):
            os.close(file)


@pytest.fixture(name="adapter")
def adapter_fixture():
    """Adapter with time stamps."""
    adapter = Adapter()
    yield adapter
    adapter.close()


@pytest.fixture(name="link")
def link_fixture(adapter):
    """Link connected to the adapter."""
    link = CanCarLink("slcan", adapter.path)
    link.connect()
    yield link
    link.close()


class Course:
    """Robot time in steps of 20 ms against a link, in lock-step with its reader: a Status each 100 ms."""

    def __init__(self, link, send, start_s=1.0):
        self.link, self.send = link, send
        self.start_s = start_s
        self.step = 0
        self.message = DemoLockMessage()

    @property
    def now_s(self):
        """Robot time."""
        return self.start_s + self.step * 0.02

    def run(self, seconds, data=LOCKED):
        """Events of this time."""
        events = []
        for _ in range(round(seconds * 50)):
            self.step += 1
            if data is not None:
                before = self.link.frames_received
                self.message.is_locked = data
                self.send(self.message.next(), self.now_s - 0.013)
                wait_for(lambda: self.link.frames_received > before)  # noqa: B023
            if self.step % 5 == 0:
                now_s = round(self.now_s, 6)
                events += self.link.observe(RobotStatus(self.step, 1, now_s, sent_s=now_s, steady_s=now_s))
        return events


def wait_for(condition):
    """Poll until true, for what another thread does."""
    deadline = time.monotonic() + WAIT_S
    while not condition():
        assert time.monotonic() < deadline
        threading.Event().wait(0.0005)


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


def test_observe_waits_no_longer_than_the_limit(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    started = time.monotonic()
    course.run(0.6, data=None)
    # Six Statuses without frames: each waits a quarter of a second until the bus counts as silent.
    assert time.monotonic() - started < 6 * 0.25 + 1.0
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
    adapter.close()
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
        adapter.close()
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


def test_missing_adapter_is_named():
    with pytest.raises(ConnectionFailed, match="/dev/no_such_adapter"):
        CanCarLink("slcan", "/dev/no_such_adapter").connect()


def test_device_that_does_not_answer_is_no_adapter():
    silent = Adapter(answer=b"")
    silent.flags = b""
    try:
        with pytest.raises(ConnectionFailed, match="does not answer"):
            CanCarLink("slcan", silent.path).connect()
    finally:
        silent.close()


def test_device_that_speaks_another_language_is_no_adapter():
    receiver = Adapter(answer=b"$GPGGA,1,2,3\r\n")
    try:
        with pytest.raises(ConnectionFailed, match="something else than the slcan protocol"):
            CanCarLink("slcan", receiver.path).connect()
    finally:
        receiver.close()


def test_file_that_is_no_terminal_is_refused(tmp_path):
    path = tmp_path / "file"
    path.write_text("")
    with pytest.raises(ConnectionFailed, match="no serial port"):
        CanCarLink("slcan", str(path)).connect()


def test_device_that_is_no_serial_port_is_told_without_numbers_of_the_system__B18():
    with pytest.raises(ConnectionFailed, match="^/dev/null is no serial port; give the CAN adapter's"):
        CanCarLink("slcan", "/dev/null").connect()


@pytest.mark.parametrize(("arguments", "words"), [
    (("telepathy", "0"), "'telepathy'; allowed are .*slcan"), (("slcan", ""), "channel is empty"),
    (("slcan", "/dev/x", 5), "bit rate is 5; allowed is 10000 to 1000000")])
def test_invalid_setting_is_named(arguments, words):
    with pytest.raises(InvalidParameter, match=words):
        CanCarLink(*arguments)


def test_rate_that_the_adapter_does_not_know_is_refused(adapter):
    with pytest.raises(ConnectionFailed, match="bitrate"):
        CanCarLink("slcan", adapter.path, 123_456).connect()


def test_database_is_checked_before_the_adapter_is_opened(adapter):
    with pytest.raises(ConnectionFailed, match="no car profile"):
        CanCarLink("slcan", adapter.path, profile="my_car").connect()
    assert adapter.commands == []


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


def test_adapter_of_another_program_is_left_alone(adapter, link):
    before = list(adapter.commands)
    with pytest.raises(ConnectionFailed, match="another program uses it"):
        CanCarLink("slcan", adapter.path).connect()
    assert adapter.commands[:len(before)] == before
    assert adapter.commands.count(b"Z1") == before.count(b"Z1")


HANDLE_TAKEN, HANDLE_RELEASED = b"t4B1101", b"t4B1100"


@pytest.fixture(name="handle_link")
def handle_link_fixture(adapter):
    """Link of a car whose profile declares an output."""
    link = CanCarLink("slcan", adapter.path, profile="mtr_honest_car", is_listening=False)
    link.connect()
    yield link
    link.close()


def test_output_is_switched_and_released_through_the_adapter(adapter, handle_link):
    handle = handle_link.handle
    assert not handle.is_taken()
    handle.request(1.5)
    wait_for(handle.is_taken)
    wait_for(lambda: HANDLE_TAKEN in adapter.commands)
    handle.release()
    wait_for(lambda: HANDLE_RELEASED in adapter.commands)
    handle.release()
    assert not handle.is_taken() and adapter.commands.count(HANDLE_TAKEN) == 1


def test_link_that_is_closed_lets_the_handle_go(adapter, handle_link):
    handle_link.handle.request(1.5)
    wait_for(handle_link.handle.is_taken)
    handle_link.close()
    wait_for(lambda: HANDLE_RELEASED in adapter.commands)


def test_request_that_an_adapter_could_not_send_is_not_sent_later(adapter, handle_link):
    adapter.close()
    wait_for(lambda: handle_link.problem)
    handle_link.handle.request(1.5)
    time.sleep(0.2)
    assert not handle_link.handle.is_taken()


def test_adapter_that_listens_switches_no_output_and_says_so(adapter):
    link = CanCarLink("slcan", adapter.path, profile="mtr_honest_car")
    link.connect()
    assert link.handle is None and "only listens: a person takes it" in link.notices[0]
    link.close()
    assert not any(command[:1] in (b"t", b"T", b"O") for command in adapter.commands)


def test_overrun_of_the_adapter_is_told_and_is_over_after_a_second(adapter, link):
    course = Course(link, adapter.send)
    course.run(4.0)
    adapter.flags = b"F08\r"
    wait_for(lambda: "lost frames" in link.problem)
    adapter.flags = b"F00\r"
    course.run(0.5)
    wait_for(lambda: adapter.commands[-1] == b"F")
    course.run(1.5)
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


def test_car_without_an_output_has_no_handle_and_nothing_is_sent(adapter, link):
    assert link.handle is None
    assert not any(command[:1] in (b"t", b"T") for command in adapter.commands)
