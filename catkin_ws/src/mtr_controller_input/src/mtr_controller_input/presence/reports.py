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
    """A device file that is read only to detect arriving reports."""

    def __init__(self, path: pathlib.Path):
        self._descriptor = os.open(path, os.O_RDONLY | os.O_NONBLOCK)

    def has_reported(self) -> bool:
        """Return True if a report has arrived since the previous call; OSError if the device is gone."""
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
        """Close the file."""
        os.close(self._descriptor)


def open_reports(device: str, root: pathlib.Path = pathlib.Path("/")) -> Optional[ReportFile]:
    """Open the reports of the controller with this joystick or event device; None if none is readable.

    Motion sensors are preferred, which the kernel presents as a separate input device; raw reports need permission.
    """
    for path in _candidates(device, root):
        with contextlib.suppress(OSError):
            return ReportFile(path)
    return None


def _candidates(device: str, root: pathlib.Path) -> Iterator[pathlib.Path]:
    name = pathlib.Path(os.path.realpath(_below(root, device))).name
    node = pathlib.Path(os.path.realpath(root / "sys/class/input" / name))
    # Path <controller>/input/input7/js0, both for Bluetooth and USB.
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
