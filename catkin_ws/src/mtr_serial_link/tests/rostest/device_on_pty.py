"""Scripted device at the other end of a pseudo-terminal, with the behaviour of real firmware and unplugging."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
import select
import threading
import time
import tty

from mtr_serial_link.fake_device import FakeSerialDevice

# Real firmware reports 25 times per second after the request for its topics.
REPORT_PERIOD_S = 0.04


class DeviceOnPty:
    """Reports and answers in its own thread while it is plugged in.

    Attributes:
        device: source of the answers.
        path: of the port; a link that appears and disappears.
        report: own message that is sent in each period.
        frozen: True to receive without answering.
    """

    def __init__(self, device: FakeSerialDevice, path: pathlib.Path, report: bytes):
        self.device, self.path, self.report = device, path, report
        self.frozen = False
        self._changed = threading.Condition()
        self._thread = None
        self._unplugged = threading.Event()
        self._master = self._slave = None

    def plug(self) -> None:
        """Create the port."""
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self._unplugged.clear()
        self._thread = threading.Thread(target=self._serve, daemon=True)
        self._thread.start()
        self.path.symlink_to(os.ttyname(self._slave))

    def unplug(self) -> None:
        """Remove the port, if it exists."""
        if not self._thread:
            return
        self.path.unlink()
        self._unplugged.set()
        self._thread.join()
        self._thread = None
        os.close(self._slave)
        os.close(self._master)

    def received(self, limit_s: float) -> list:
        """Return payloads of messages on its own topics; waits for the first one."""
        with self._changed:
            self._changed.wait_for(lambda: self.device.received, limit_s)
            return [frame.payload for frame in self.device.received]

    def _serve(self) -> None:
        asked_before, due_s = self.device.asked, time.monotonic()
        while not self._unplugged.is_set():
            if select.select([self._master], [], [], max(0.0, due_s - time.monotonic()))[0]:
                self._answer(os.read(self._master, 4096))
            elif time.monotonic() >= due_s:
                due_s += REPORT_PERIOD_S
                if self.device.asked > asked_before and not self.frozen:
                    os.write(self._master, self.report)

    def _answer(self, data: bytes) -> None:
        if self.frozen:
            return
        with self._changed:
            os.write(self._master, self.device.receive(data))
            self._changed.notify_all()
