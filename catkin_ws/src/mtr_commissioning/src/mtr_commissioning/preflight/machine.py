"""Disk, temperature, memory and Wi-Fi of the robot's computer, from files of Linux."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import re
import shutil
from dataclasses import dataclass
from typing import List, Optional, Sequence, Tuple

from mtr_dispatcher.disks.room import Usage, room_at
from mtr_motion_check.finding import Finding, bad, good

DISK, HEAT, MEMORY = "machine.disk", "machine.temperature", "machine.memory"
# Intel's and AMD's processors throttle at 95 to 105 C.
MAX_TEMPERATURE_C = 85.0
# A chosen reserve: the nodes of the robot need less, and without free memory the kernel kills the largest process.
MIN_MEMORY_BYTES = 3e8
GIGA = 1e9
# Command of roslaunch and roscore, after an interpreter and its options; the default port.
MASTER_PROGRAM, MASTER_OPTION, MASTER_WITHIN_WORDS, MASTER_PORT = "rosmaster", "--core", 3, 11311


@dataclass(frozen=True)
class Machine:
    """Reader of this computer's state.

    Attributes:
        root: parent of proc and sys.
        folders: their disks' free space is checked.
        usage: total, used and free bytes of a path's disk.
    """

    root: pathlib.Path
    folders: Sequence[pathlib.Path]
    usage: Usage = shutil.disk_usage

    def temperature_c(self) -> Optional[float]:
        """Return the temperature of the hottest zone; None without any."""
        found = []
        for path in self.root.glob("sys/class/thermal/thermal_zone*/temp"):
            # A zone may exist without its sensor.
            with contextlib.suppress(OSError, ValueError):
                found.append(1e-3 * float(path.read_text(encoding="ascii")))
        return max(found, default=None)

    def available_bytes(self) -> Optional[float]:
        """Return the memory available to programs; None if not reported."""
        found = re.search(r"^MemAvailable:\s+(\d+) kB", self._text("proc/meminfo"), re.MULTILINE)
        return 1024.0 * float(found[1]) if found else None

    def signal_dbm(self) -> Optional[Tuple[str, float]]:
        """Return interface and level of the strongest Wi-Fi connection; None without one."""
        rows = re.findall(r"^\s*(\w+):\s+\S+\s+\S+\s+(-\d+)\.?\s", self._text("proc/net/wireless"), re.MULTILINE)
        # -256 means no connection.
        levels = [(name, float(level)) for name, level in rows if float(level) > -200.0]
        return max(levels, key=lambda each: each[1]) if levels else None

    def ros_master_ports(self) -> List[int]:
        """Return the ports of all ROS masters on this computer."""
        found = set()
        for path in self.root.glob("proc/[0-9]*/cmdline"):
            # Processes may end during the search.
            with contextlib.suppress(OSError):
                found.update(master_ports_in(path.read_bytes().decode("utf-8", "replace").split("\0")))
        return sorted(found)

    def _text(self, name: str) -> str:
        try:
            return (self.root / name).read_text(encoding="utf-8")
        except OSError:
            return ""


def master_ports_in(command: List[str]) -> List[int]:
    """Return the port of a ROS master by its command line; empty for another program. An interpreter may precede it."""
    names = [pathlib.PurePath(word).name for word in command[:MASTER_WITHIN_WORDS]]
    if MASTER_PROGRAM not in names or MASTER_OPTION not in command:
        return []
    ports = [after for word, after in zip(command, command[1:]) if word in ("-p", "--port")]
    return [int(ports[-1])] if ports and ports[-1].isdigit() else [MASTER_PORT]


def machine_findings(machine: Machine) -> List[Finding]:
    """Check the machine without the Wi-Fi, which needs other programs."""
    return [disk_finding(machine), temperature_finding(machine), memory_finding(machine)]


def disk_finding(machine: Machine) -> Finding:
    """Check the free space for logs and bags on the disk with the least."""
    rooms = [room for room in (room_at(folder, machine.usage) for folder in machine.folders) if room]
    if not rooms:
        return bad(DISK, "disk", "This computer does not tell what is free on it: look at the disk (dmesg).")
    least = min(rooms, key=lambda room: room.free_bytes / room.reserve_bytes)
    value, limit = least.free_bytes / GIGA, least.reserve_bytes / GIGA
    text = f"{value:.1f} of {least.total_bytes / GIGA:.0f} GB are free on {least.folder}"
    if value >= limit:
        return good(DISK, "disk", f"{text}.", value, limit, unit="GB")
    return bad(DISK, "disk", f"{text}, at least {limit:.1f} GB are needed: delete old logs and bags (rosclean purge).",
               value, limit, unit="GB")


def temperature_finding(machine: Machine) -> Finding:
    """Check the processor's temperature."""
    hottest = machine.temperature_c()
    if hottest is None:
        return good(HEAT, "temperature", "This computer does not tell it.")
    if hottest <= MAX_TEMPERATURE_C:
        return good(HEAT, "temperature", f"{hottest:.0f} C.", hottest, MAX_TEMPERATURE_C, unit="C")
    return bad(HEAT, "temperature", f"{hottest:.0f} C, allowed is {MAX_TEMPERATURE_C:.0f} C: let it cool, and look at "
               "fan and air holes.", hottest, MAX_TEMPERATURE_C, unit="C")


def memory_finding(machine: Machine) -> Finding:
    """Check the available memory."""
    available = machine.available_bytes()
    if available is None:
        return good(MEMORY, "memory", "This computer does not tell it.")
    text, value = f"{available / GIGA:.2f} GB are available", available / GIGA
    if available >= MIN_MEMORY_BYTES:
        return good(MEMORY, "memory", f"{text}.", value, MIN_MEMORY_BYTES / GIGA, unit="GB")
    return bad(MEMORY, "memory", f"{text}, at least {MIN_MEMORY_BYTES / GIGA:.1f} GB are needed: end other programs.",
               value, MIN_MEMORY_BYTES / GIGA, unit="GB")
