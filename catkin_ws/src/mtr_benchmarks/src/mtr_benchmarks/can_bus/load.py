"""Loads a bus fully at the pace of the wire; one of the messages is a lock message whose changes are time-stamped.

`python -m mtr_benchmarks.can_bus.load FD SECONDS` acts as an slcan adapter in a separate process. FD is the file
descriptor of the pseudo-terminal's master. It prints one line of JSON that describes the sent frames.
"""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import select
import sys
import time
from dataclasses import asdict, dataclass, field
from typing import Callable, List

from mtr_operator.car_link.fake_message import DemoLockMessage

LOCK_ID = 0x320
BITRATE_BPS, DATA_BITRATE_BPS = 500_000, 2_000_000
_CYCLE_S = 0.02
# The lock message's change flag must have ended before the next change.
_CHANGE_CYCLES = 10
# Frame lengths by ISO 11898-1 with the interframe space of three bits; without stuff bits, so the load is higher than
# on a wire.
_CLASSIC_BITS, _FD_BITS, _FD_DATA_BITS = 47 + 64, 30, 36 + 8 * 64
# Frames are sent in bursts, because a sleep cannot be shorter.
_BURST_S = 0.001
_PASSIVE_ENTRY = 1
_BACKGROUND_ID, _BACKGROUND_IDS = 0x400, 100
_MS_PER_S, _STAMP_LIMIT_MS = 1000, 60_000
_ANSWERS = {b"F": b"F00\r", b"V": b"V1013\r", b"N": b"N0001\r"}


@dataclass(frozen=True)
class Sent:
    """Sent frames.

    Attributes:
        load: used share of the wire's time; less than 1 if this computer was too slow.
        changes_s: monotonic time before each frame that shows a change.
    """

    frames: int
    load: float
    processor_s: float
    changes_s: List[float] = field(default_factory=list)


def run(send: Callable[[int, bytes], None], is_fd: bool, seconds: float) -> Sent:
    """Send all frames of a time span, even if the process is delayed. send: called with a frame's identifier and
    data."""
    period_s = _FD_BITS / BITRATE_BPS + _FD_DATA_BITS / DATA_BITRATE_BPS if is_fd else _CLASSIC_BITS / BITRATE_BPS
    message, background = DemoLockMessage(), bytes(64 if is_fd else 8)
    message.source = _PASSIVE_ENTRY
    begin_s, processor_s = time.monotonic(), time.thread_time()
    frames, locks = 0, 0
    changes_s: List[float] = []
    while frames * period_s < seconds:
        now_s = min(time.monotonic() - begin_s, seconds)
        while frames * period_s < now_s:
            frames += 1
            if locks * _CYCLE_S > now_s:
                send(_BACKGROUND_ID + frames % _BACKGROUND_IDS, background)
                continue
            locks += 1
            if locks % _CHANGE_CYCLES == 0:
                message.is_locked = not message.is_locked
                changes_s.append(time.monotonic())
            send(LOCK_ID, message.next())
        time.sleep(_BURST_S)
    return Sent(frames, frames * period_s / (time.monotonic() - begin_s), time.thread_time() - processor_s, changes_s)


class Adapter:
    """slcan adapter at the master's end of a pseudo-terminal."""

    def __init__(self, terminal: int):
        self._terminal = terminal
        self._line = b""

    def send(self, can_id: int, data: bytes) -> None:
        """Send a received frame with its time stamp to the host; answer pending commands first."""
        self.answer(0.0)
        stamp_ms = round(time.monotonic() * _MS_PER_S) % _STAMP_LIMIT_MS
        os.write(self._terminal, f"t{can_id:03X}{len(data)}{data.hex().upper()}{stamp_ms:04X}\r".encode())

    def answer(self, patience_s: float) -> None:
        """Answer the host's commands."""
        if not select.select([self._terminal], [], [], patience_s)[0]:
            return
        *lines, self._line = (self._line + os.read(self._terminal, 4096)).split(b"\r")
        for line in lines:
            os.write(self._terminal, _ANSWERS.get(line[:1], b"\r"))


def main(terminal: int, seconds: float) -> None:
    """Answer commands until a line on the standard input starts the load, send it, and print the result."""
    adapter = Adapter(terminal)
    while sys.stdin not in select.select([terminal, sys.stdin], [], [])[0]:
        adapter.answer(0.0)
    print(json.dumps(asdict(run(adapter.send, False, seconds))), flush=True)
    # The host still reads data from the terminal's buffer; it then ends this process.
    while True:
        adapter.answer(1.0)


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
