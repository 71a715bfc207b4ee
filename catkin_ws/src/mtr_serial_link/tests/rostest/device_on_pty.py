"""A scripted device at the other end of a pseudo-terminal that can be unplugged."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
import threading
import tty

from mtr_serial_link.fake_device import FakeDevice


class DeviceOnPty:
    """Answers in a thread of its own while it is plugged in.

    Attributes:
        device: what answers.
        path: of the port; a link that comes and goes.
        frozen: it hears and says nothing.
    """

    def __init__(self, device: FakeDevice, path: pathlib.Path):
        self.device, self.path = device, path
        self.frozen = False
        self._thread = None
        self._master = self._slave = None

    def plug(self) -> None:
        """The port appears."""
        self._master, self._slave = os.openpty()
        tty.setraw(self._slave)
        self.path.symlink_to(os.ttyname(self._slave))
        self._thread = threading.Thread(target=self._serve, args=(self._master,), daemon=True)
        self._thread.start()

    def unplug(self) -> None:
        """The port vanishes."""
        self.path.unlink()
        os.close(self._slave)
        master, self._master = self._master, None
        os.close(master)
        self._thread = None

    def say(self, data: bytes) -> None:
        """Bytes for the host."""
        os.write(self._master, data)

    def _serve(self, master: int) -> None:
        with contextlib.suppress(OSError):
            while True:
                data = os.read(master, 4096)
                if not self.frozen:
                    os.write(master, self.device.receive(data))
