"""CAN adapter of the simulated Car: a pseudo-terminal with the serial-line CAN protocol."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import enum
import hashlib
import os
import pathlib
import pty
import select
import termios
import threading
import tty
from typing import List, Tuple, Union

from mtr_core.errors import ConfigurationError

from .can_port import CanPort, SentFrame
from .slcan_protocol import SlcanAdapter

# Largest size of answers for a host that does not read them.
_MAX_UNSENT = 4096


class Fault(enum.Enum):
    """Fault of the bus or the adapter, requested by a test."""

    NONE = "none"
    SILENCE = "silence"  # no frames arrive; the adapter answers
    GARBAGE = "garbage"  # random bytes instead of each frame
    BUS_OFF = "bus_off"  # the controller has left the bus; the status reports it


class SlcanPort(CanPort):
    """Pseudo-terminal with a symbolic link as its permanent name.

    It never waits for the host: lines that do not fit into the terminal's buffer are dropped and counted. A thread
    answers the host's commands, like the processor of an adapter, also while simulated time stops.

    Attributes:
        dropped: number of frames that were lost because the host did not read.
        adapter: state of the protocol.
    """

    def __init__(self, link_path: Union[str, pathlib.Path]):
        self.dropped = 0
        self.adapter = SlcanAdapter()
        self._fault = Fault.NONE
        self._frames = 0
        self._unsent = b""
        self._lock = threading.Lock()
        self._master, self._slave = _open_terminal()
        # The slave is also kept open here; otherwise the master reports a hang-up between two hosts.
        self._device = os.ttyname(self._slave)
        self._link = pathlib.Path(link_path)
        try:
            _link_to(self._device, self._link)
        except ConfigurationError:
            self._close_files()
            raise
        self._wake_read, self._wake_write = os.pipe()
        self._thread = threading.Thread(target=self._serve, name="slcan", daemon=True)
        self._thread.start()

    @property
    def fault(self) -> Fault:
        """Current fault; assign to change it."""
        return self._fault

    @fault.setter
    def fault(self, fault: Fault) -> None:
        with self._lock:
            self._fault = fault
            self.adapter.bus_off = fault is Fault.BUS_OFF

    def poll(self) -> None:
        """Answer the commands that have arrived."""
        with self._lock, contextlib.suppress(BlockingIOError):
            if self._master < 0:
                return
            self._flush()
            was_open = self.adapter.is_open
            answers = self.adapter.receive(os.read(self._master, 4096))
            if was_open and not self.adapter.is_open:
                self._forget_frames()
            if len(self._unsent) < _MAX_UNSENT:
                self._unsent += answers
            self._flush()

    def send(self, can_id: int, data: bytes, time_ns: int) -> None:
        """Give a frame to the host if it has opened the channel."""
        with self._lock:
            if not self.adapter.is_open or self._fault in (Fault.SILENCE, Fault.BUS_OFF):
                return
            self._flush()
            if self._unsent:
                self.dropped += 1
                self.adapter.overrun = True
                return
            self._unsent = self.adapter.encode(can_id, data, time_ns)
            if self._fault is Fault.GARBAGE:
                self._unsent = hashlib.blake2b(b"%d" % time_ns, digest_size=len(self._unsent)).digest()
            self._flush()

    def taken(self) -> List[SentFrame]:
        """See CanPort."""
        with self._lock:
            taken = list(self.adapter.sent)
            self.adapter.sent.clear()
        return taken

    def close(self) -> None:
        """Remove the adapter; safe to call twice."""
        if self._master < 0:
            return
        os.write(self._wake_write, b"x")
        self._thread.join()
        os.close(self._wake_read)
        os.close(self._wake_write)
        with contextlib.suppress(OSError):
            if os.readlink(self._link) == self._device:
                os.unlink(self._link)
        self._close_files()

    def _serve(self) -> None:
        while True:
            readable, _, _ = select.select([self._master, self._wake_read], [], [])
            if self._wake_read in readable:
                return
            self.poll()

    def _flush(self) -> None:
        """Write as much as the terminal accepts; the rest of a cut line is written first next time."""
        if self._unsent:
            with contextlib.suppress(BlockingIOError):
                self._unsent = self._unsent[os.write(self._master, self._unsent) :]

    def _forget_frames(self) -> None:
        """Discard pending frames when the channel is closed, because the next host must not read them."""
        self._unsent = b""
        # Linux stores the master's output in two buffers, and each flush empties one of them.
        termios.tcflush(self._master, termios.TCOFLUSH)
        termios.tcflush(self._slave, termios.TCIFLUSH)

    def _close_files(self) -> None:
        with self._lock:
            self.adapter.is_open = False
            os.close(self._master)
            os.close(self._slave)
            self._master = self._slave = -1


def _open_terminal() -> Tuple[int, int]:
    """Return master and slave of a raw terminal."""
    master, slave = pty.openpty()
    tty.setraw(slave)
    os.set_blocking(master, False)
    return master, slave


def _link_to(device: str, link: pathlib.Path) -> None:
    """Create or replace the link atomically, so that a host finds the old or the new terminal."""
    if link.exists() and not link.is_symlink():
        raise ConfigurationError(f"The CAN adapter's link {link} is taken by a file that is no link; remove the file.")
    temporary = link.with_name(f".{link.name}.{os.getpid()}")
    try:
        link.parent.mkdir(parents=True, exist_ok=True)
        with contextlib.suppress(FileNotFoundError):
            temporary.unlink()
        temporary.symlink_to(device)
        os.replace(temporary, link)
    except OSError as error:
        raise ConfigurationError(f"The CAN adapter's link {link} cannot be made: {error.strerror}.") from error
