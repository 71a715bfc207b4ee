"""Memory of this process, and giving back what is free."""
# SPDX-License-Identifier: Apache-2.0
import ctypes
import os

MIB = 1024 * 1024
STATM = "/proc/self/statm"


def resident_mib() -> float:
    """Memory of this process that lies in RAM (proc(5), statm, second field), MiB."""
    with open(STATM, encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / MIB


def give_back() -> None:
    """Return free memory to the system; glibc keeps it otherwise."""
    ctypes.CDLL(None).malloc_trim(0)
