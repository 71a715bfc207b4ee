"""Wall clock of the robot's processes that can be set while they run, without setting the machine's clock."""
# SPDX-License-Identifier: Apache-2.0
import mmap
import pathlib
import struct
import subprocess
from typing import Dict

from .parts import FaultError

SOURCE = pathlib.Path(__file__).with_name("set_clock.c")
OFFSET = struct.Struct("=q")
S = 1_000_000_000


class ClockFile:
    """Offset from the machine's clock for processes that were started with set_clock.so preloaded."""

    def __init__(self, path: str):
        """Raise FaultError if the file does not exist."""
        self._path = pathlib.Path(path)
        if not path or not self._path.is_file():
            raise FaultError("The clock cannot be set: the nodes were not started with set_clock.so preloaded; see "
                             "clock_file.")

    def set_by(self, step_s: float) -> None:
        """Advance the clock, or set it back if negative, for all processes at the same instant."""
        with self._path.open("r+b") as file, mmap.mmap(file.fileno(), OFFSET.size) as shared:
            shared[:] = OFFSET.pack(OFFSET.unpack(shared[:])[0] + round(step_s * S))


class SettableClock:
    """Library and file for setting the clock of new processes.

    Attributes:
        file: file with the offset.
        variables: environment variables of processes that use this clock.
    """

    def __init__(self, folder: pathlib.Path):
        """Compile the library into a folder, which is created.

        Raises:
            subprocess.CalledProcessError: the compilation failed; stderr has the reason.
        """
        folder.mkdir(parents=True, exist_ok=True)
        library, self.file = (folder.resolve() / name for name in ("set_clock.so", "offset_ns"))
        subprocess.run(["gcc", "-std=gnu11", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-pthread",
                        "-o", str(library), str(SOURCE)], check=True)
        self.file.write_bytes(OFFSET.pack(0))
        self._clock = ClockFile(str(self.file))
        # The dispatcher is started without the other nodes' preloaded libraries, see robot.launch.
        self.variables: Dict[str, str] = {"LD_PRELOAD": str(library), "MTR_DISPATCHER_PRELOAD": str(library),
                                          "MTR_CLOCK_OFFSET_FILE": str(self.file)}

    def set_by(self, step_s: float) -> None:
        """Advance the clock, or set it back if negative, for all processes at the same instant."""
        self._clock.set_by(step_s)
