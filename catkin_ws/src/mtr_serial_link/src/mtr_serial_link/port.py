"""Serial port as a file with exclusive access."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import errno
import fcntl
import os
import termios
from typing import Optional

import serial

from mtr_core.errors import RobotError


class PortError(RobotError):
    """The port cannot be used; the text has the reason and a remedy."""


class SerialPort:
    """An open port with non-blocking reads and writes.

    Attributes:
        fd: for poll().
    """

    def __init__(self, path: str, baud: int):
        self._path = path
        try:
            self._serial = serial.Serial(path, baud, timeout=0, write_timeout=0, exclusive=True)
        except (serial.SerialException, OSError, ValueError) as error:
            raise PortError(reason_of(path, error)) from error
        self.fd = self._serial.fileno()
        # The lock above excludes cooperating programs; TIOCEXCL excludes all others.
        with contextlib.suppress(OSError):
            fcntl.ioctl(self.fd, termios.TIOCEXCL)

    def read(self) -> bytes:
        """Return the bytes received so far; PortError if the device is gone."""
        try:
            data = os.read(self.fd, 4096)
        except BlockingIOError:
            return b""
        except OSError as error:
            raise PortError(f"The port {self._path} is gone: {error.strerror}; is the cable plugged in?") from error
        if not data:
            raise PortError(f"The port {self._path} is gone; is the cable plugged in?")
        return data

    def write(self, data: bytes) -> int:
        """Return the number of written bytes; PortError if the device is gone."""
        try:
            return os.write(self.fd, data)
        except BlockingIOError:
            return 0
        except OSError as error:
            raise PortError(f"The port {self._path} is gone: {error.strerror}; is the cable plugged in?") from error

    def close(self) -> None:
        """Close the port."""
        with contextlib.suppress(OSError):
            self._serial.close()


def reason_of(path: str, error: BaseException) -> str:
    """Return one sentence about the reason why a port could not be opened."""
    number: Optional[int] = getattr(error, "errno", None)
    if number is None and isinstance(error.__context__, OSError):
        number = error.__context__.errno
    if number in (errno.ENOENT, errno.ENODEV, errno.ENXIO):
        return f"The port {path} is missing; is the board plugged in? `ls /dev/serial/by-id` shows what is."
    if number in (errno.EBUSY, errno.EAGAIN):
        return f"The port {path} is busy: another program has it; end that first."
    if number in (errno.EACCES, errno.EPERM):
        return f"The port {path} may not be opened by this user; add it to the group dialout."
    return f"The port {path} did not open: {error}."
