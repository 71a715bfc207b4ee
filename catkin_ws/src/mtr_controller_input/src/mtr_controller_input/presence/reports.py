"""The file from which reports of a controller can be read, found in the system's folders /sys and /dev."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import os
import pathlib
from typing import Iterator, Optional

# linux/input-event-codes.h: bit of INPUT_PROP_ACCELEROMETER in the properties of an input device.
ACCELEROMETER = 1 << 0x06
READ_BYTES, MAX_READS = 4096, 64


class ReportFile:
    """A device file that is read only to know whether something has arrived."""

    def __init__(self, path: pathlib.Path):
        self._descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)

    def has_reported(self) -> bool:
        """True when something has arrived since the previous call; OSError when the device is gone."""
        found = False
        for _ in range(MAX_READS):
            try:
                data = os.read(self._descriptor, READ_BYTES)
            except BlockingIOError:
                break
            if not data:
                break
            found = True
        return found

    def close(self) -> None:
        """Release the file."""
        os.close(self._descriptor)


def open_reports(device: str, root: pathlib.Path = pathlib.Path("/")) -> Optional[ReportFile]:
    """Reports of the controller whose joystick or event device this is; None when it has none that can be read.

    Motion sensors are preferred, which the kernel shows as an input device of their own; raw reports need permission.
    """
    for path in _candidates(device, root):
        with contextlib.suppress(OSError):
            return ReportFile(path)
    return None


def _candidates(device: str, root: pathlib.Path) -> Iterator[pathlib.Path]:
    name = pathlib.Path(os.path.realpath(_below(root, device))).name
    node = pathlib.Path(os.path.realpath(root / "sys/class/input" / name))
    # <controller>/input/input7/js0, of Bluetooth and USB alike.
    controller, own = node.parents[2], node.parent
    for each in sorted(controller.glob("input/input*")):
        if each != own and _has_accelerometer(each):
            yield from (root / "dev/input" / event.name for event in sorted(each.glob("event*")))
    yield from (root / "dev" / raw.name for raw in sorted(controller.glob("hidraw/hidraw*")))


def _has_accelerometer(device: pathlib.Path) -> bool:
    try:
        # The lowest word is the last one.
        return bool(int((device / "properties").read_text(encoding="ascii").split()[-1], 16) & ACCELEROMETER)
    except (OSError, ValueError, IndexError):
        return False


def _below(root: pathlib.Path, path: str) -> pathlib.Path:
    return root / path.lstrip("/")
