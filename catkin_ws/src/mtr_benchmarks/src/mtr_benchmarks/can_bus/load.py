"""A bus at full load: frames at the pace of the wire, among them a lock message whose changes are noted when sent.

`python -m mtr_benchmarks.can_bus.load FD SECONDS` is an slcan adapter on the pseudo-terminal whose master is the file
descriptor FD, in a process of its own; one line of JSON tells what it has sent.
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
# As often as the lock message's flag of a change allows, with room.
_CHANGE_CYCLES = 10
# ISO 11898-1 with the gap of three bits; stuffed bits are left out, so that more frames come than on a wire.
_CLASSIC_BITS, _FD_BITS, _FD_DATA_BITS = 47 + 64, 30, 36 + 8 * 64
# Sent together, for a sleep is no shorter.
_BURST_S = 0.001
_PASSIVE_ENTRY = 1
_BACKGROUND_ID, _BACKGROUND_IDS = 0x400, 100
_MS_PER_S, _STAMP_LIMIT_MS = 1000, 60_000
_ANSWERS = {b"F": b"F00\r", b"V": b"V1013\r", b"N": b"N0001\r"}


@dataclass(frozen=True)
class Sent:
    """What was sent. changes_s: monotonic clock, before each frame that shows a change. load: part of the wire's time
    that was used; less than 1 when this computer did not suffice."""

    frames: int
    load: float
    processor_s: float
    changes_s: List[float] = field(default_factory=list)


def run(send: Callable[[int, bytes], None], is_fd: bool, seconds: float) -> Sent:
    """Send the frames of this time, even if the process is delayed; send: takes identifier and data of a frame."""
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
    """An slcan adapter at the master's end of a pseudo-terminal."""

    def __init__(self, terminal: int):
        self._terminal = terminal
        self._line = b""

    def send(self, can_id: int, data: bytes) -> None:
        """A frame of the bus, with its stamp; commands are answered in between."""
        self.answer(0.0)
        stamp_ms = round(time.monotonic() * _MS_PER_S) % _STAMP_LIMIT_MS
        os.write(self._terminal, f"t{can_id:03X}{len(data)}{data.hex().upper()}{stamp_ms:04X}\r".encode())

    def answer(self, patience_s: float) -> None:
        """What the host asks."""
        if not select.select([self._terminal], [], [], patience_s)[0]:
            return
        *lines, self._line = (self._line + os.read(self._terminal, 4096)).split(b"\r")
        for line in lines:
            os.write(self._terminal, _ANSWERS.get(line[:1], b"\r"))


def main(terminal: int, seconds: float) -> None:
    """Answer until a line on the standard input starts it, send, and tell what was sent."""
    adapter = Adapter(terminal)
    while sys.stdin not in select.select([terminal, sys.stdin], [], [])[0]:
        adapter.answer(0.0)
    print(json.dumps(asdict(run(adapter.send, False, seconds))), flush=True)
    # What lies in the terminal still has to be read by the other side, which then ends this process.
    while True:
        adapter.answer(1.0)


if __name__ == "__main__":
    main(int(sys.argv[1]), float(sys.argv[2]))
