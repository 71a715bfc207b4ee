"""Program that writes the data frames of an MF4 log to its standard output, for Mf4Log.

Usage: mf4_frames.py LOG. It imports nothing of the application, and ends with FAILED when asammdf refuses the log.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import contextlib
import faulthandler
import os
import struct
import sys

import can

# Time stamp, identifier, whether it is extended, whether it is CAN FD, bus, and data after its length. A longer frame
# than CAN FD has is refused by the reader of logs.
RECORD = struct.Struct("<dI??iB255s")
FAILED = 3
# The package loads a log before its first frame; a log of 1 GB takes half a minute.
_PATIENCE_S, _FRAMES_PER_CHECK = 300.0, 10_000
# Of address space: the package needs 1 GB, and several copies of what it loads.
_MEMORY_BYTES, _MEMORY_PER_BYTE = 4 * 1024 ** 3, 16


def message(record: bytes) -> can.Message:
    """Return the frame of a record."""
    time_s, can_id, is_extended, is_fd, channel, length, data = RECORD.unpack(record)
    return can.Message(timestamp=time_s, arbitration_id=can_id, is_extended_id=is_extended, is_fd=is_fd,
                       channel=channel, data=data[:length])


def main(path: str) -> int:
    """Write all frames; the exit status is FAILED when the package raises, whatever it is."""
    _bound_memory(_MEMORY_BYTES + _MEMORY_PER_BYTE * os.path.getsize(path))
    try:
        for number, frame in enumerate(can.MF4Reader(path)):
            if number % _FRAMES_PER_CHECK == 0:
                faulthandler.dump_traceback_later(_PATIENCE_S, exit=True)
            if not (frame.is_error_frame or frame.is_remote_frame):
                channel = frame.channel if isinstance(frame.channel, int) else 0
                data = bytes(frame.data)
                sys.stdout.buffer.write(RECORD.pack(frame.timestamp, frame.arbitration_id, frame.is_extended_id,
                                                    frame.is_fd, channel, len(data), data))
    # It depends on the damage what the package raises.
    except Exception:
        return FAILED
    finally:
        sys.stdout.buffer.flush()
    return 0


def _bound_memory(limit_bytes: int) -> None:
    # Windows has no such limits.
    with contextlib.suppress(ImportError):
        import resource
        resource.setrlimit(resource.RLIMIT_AS, (limit_bytes, limit_bytes))


if __name__ == "__main__":
    faulthandler.dump_traceback_later(_PATIENCE_S, exit=True)
    sys.exit(main(sys.argv[1]))
