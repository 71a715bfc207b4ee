"""Program that writes the data frames of an MF4 log to its standard output, for Mf4Log.

Usage: mf4_frames.py LOG. It imports nothing of the application, and exits with FAILED if asammdf rejects the log.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import faulthandler
import os
import struct
import sys

import can

# Time stamp, identifier, is_extended, is_fd, bus, and data after its length. The log reader rejects frames that are
# longer than CAN FD frames.
RECORD = struct.Struct("<dI??iB255s")
FAILED = 3
# Time limit for the package to return the next frames; it loads a log of 1 GB in half a minute.
_PATIENCE_S, _FRAMES_PER_CHECK = 300.0, 10_000
# Address space in addition to the loaded packages: the package makes several copies of a log.
_MEMORY_BYTES, _MEMORY_PER_BYTE = 2 * 1024 ** 3, 16


def message(record: bytes) -> can.Message:
    """Return the frame of a record."""
    time_s, can_id, is_extended, is_fd, channel, length, data = RECORD.unpack(record)
    return can.Message(timestamp=time_s, arbitration_id=can_id, is_extended_id=is_extended, is_fd=is_fd,
                       channel=channel, data=data[:length])


def main(path: str) -> int:
    """Write all frames; the exit status is FAILED if the package raises any exception."""
    _bound_memory(_MEMORY_BYTES + _MEMORY_PER_BYTE * os.path.getsize(path))
    records: list[bytes] = []
    # The limit does not include the time of writing: a log may be played at the speed of its bus.
    faulthandler.dump_traceback_later(_PATIENCE_S, exit=True)
    try:
        for frame in can.MF4Reader(path):
            if not (frame.is_error_frame or frame.is_remote_frame):
                records.append(_record(frame))
            if len(records) >= _FRAMES_PER_CHECK:
                _write(records)
                faulthandler.dump_traceback_later(_PATIENCE_S, exit=True)
    # The type of the exception depends on the damage.
    except Exception:
        return FAILED
    finally:
        _write(records)
    return 0


def _record(frame: can.Message) -> bytes:
    channel = frame.channel if isinstance(frame.channel, int) else 0
    return RECORD.pack(frame.timestamp, frame.arbitration_id, frame.is_extended_id, frame.is_fd, channel,
                       len(frame.data), bytes(frame.data))


def _write(records: list[bytes]) -> None:
    faulthandler.cancel_dump_traceback_later()
    sys.stdout.buffer.write(b"".join(records))
    sys.stdout.buffer.flush()
    records.clear()


def _bound_memory(more_bytes: int) -> None:
    # Only Linux reports the current size in this file; other systems read without a limit.
    with contextlib.suppress(ImportError, OSError):
        import resource
        with open("/proc/self/statm", encoding="ascii") as file:
            limit_bytes = int(file.read().split()[0]) * resource.getpagesize() + more_bytes
        resource.setrlimit(resource.RLIMIT_AS, (limit_bytes, limit_bytes))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
