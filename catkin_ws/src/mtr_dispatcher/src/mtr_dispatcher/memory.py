"""Memory of this process: measurement, return of free memory, and the upper bound."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import ctypes
import os
import sys
import threading
import time

MIB = 1024 * 1024
STATM = "/proc/self/statm"
CHECK_PERIOD_S = 0.05
# Multiple of the limit at which a process ends that is too busy to react to the limit itself.
LAST_RESORT = 1.5
EXIT_STATUS = 3


def resident_mib() -> float:
    """Return the resident memory of this process (proc(5), statm, second field), MiB."""
    with open(STATM, encoding="ascii") as file:
        return int(file.read().split()[1]) * os.sysconf("SC_PAGE_SIZE") / MIB


def give_back() -> None:
    """Return free memory to the system; glibc retains it otherwise."""
    ctypes.CDLL(None).malloc_trim(0)


def end_beyond(limit_mib: float) -> None:
    """Watch the memory in a thread, and end this process at LAST_RESORT times the limit; it is then restarted.

    A flood of subscriptions keeps ZeroMQ busy within one call of the main thread.
    """
    threading.Thread(target=_watch, args=(LAST_RESORT * limit_mib,), name="memory", daemon=True).start()


def _watch(limit_mib: float) -> None:
    used_mib = 0.0
    while used_mib <= limit_mib:
        time.sleep(CHECK_PERIOD_S)
        # Strangers may use up all file descriptors; then the next check reads it again.
        with contextlib.suppress(OSError):
            used_mib = resident_mib()
    print(f"The dispatcher ends at {used_mib:.0f} MiB; allowed are {limit_mib:.0f}.", file=sys.stderr, flush=True)
    os._exit(EXIT_STATUS)
