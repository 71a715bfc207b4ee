"""An slcan adapter on a pseudo-terminal, and a link to the Car that reads it in lock-step."""
# SPDX-License-Identifier: Apache-2.0
import os
import select
import threading
import time
import tty

import pytest

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.fake_message import DemoLockMessage
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

    def pull(self):
        """The plug; safe to call twice. The terminal's number stays taken: a link that opens it again finds nothing,
        and not the terminal of another program that was given the number since."""
        if self._thread is None:
            return
        os.write(self._wake[1], b"x")
        self._thread.join()
        self._thread = None
        for file in (self.master, *self._wake):
            os.close(file)

    def close(self):
        """Pull the plug and leave nothing; safe to call twice."""
        self.pull()
        slave, self._slave = self._slave, None
        if slave is not None:
            os.close(slave)


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
