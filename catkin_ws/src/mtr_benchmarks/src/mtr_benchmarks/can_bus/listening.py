"""Measures the application's link on a fully loaded bus: lost frames, processor time, latency of a change."""
# SPDX-License-Identifier: Apache-2.0
import json
import os
import pathlib
import subprocess
import sys
import threading
import time
import tty
from dataclasses import dataclass
from typing import Any, Callable, List

import can
import numpy as np

from mtr_operator.car_link.bus import CanCarLink
from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.robot_status import RobotStatus

from .load import BITRATE_BPS, DATA_BITRATE_BPS, LOCK_ID, Sent, run

_STATUS_S = 0.1
# Waiting time after the last frame was sent; frames that have not been read by then count as lost.
_PATIENCE_S = 10.0
_STATE_BITS = 0x03


@dataclass(frozen=True)
class Listened:
    """Result of one bus.

    Attributes:
        sent_frames: frames sent on the bus.
        latencies_s: of each change, from before its frame is sent until the link has evaluated it.
        cores: processor time of the link divided by wall time.
    """

    name: str
    sent_frames: int
    heard: int
    logged: int
    load: float
    cores: float
    latencies_s: List[float]

    @property
    def lost(self) -> int:
        """Number of frames that the link has not received or the log does not contain."""
        return self.sent_frames - min(self.heard, self.logged)

    def latency_ms(self, percent: float) -> float:
        """Return a percentile of the latencies; NaN without a change."""
        return 1000.0 * float(np.percentile(self.latencies_s, percent)) if self.latencies_s else float("nan")


class _TimedLink(CanCarLink):
    """Records when it has evaluated a frame with a changed state."""

    def __init__(self, *arguments: Any, **options: Any):
        super().__init__(*arguments, **options)
        self.heard_s: List[float] = []
        self._state = -1

    def frame(self, frame: CanFrame) -> None:
        super().frame(frame)
        if frame.can_id == LOCK_ID:
            state = frame.data[0] & _STATE_BITS
            if state != self._state >= 0:
                self.heard_s.append(time.monotonic())
            self._state = state


def on_virtual_bus(folder: pathlib.Path, seconds: float, is_fd: bool) -> Listened:
    """Measure with python-can's virtual bus; the sender is a thread of this process."""
    name = "CAN FD 2 Mbit/s, virtual bus" if is_fd else "classic 500 kbit/s, virtual bus"
    link = _TimedLink("virtual", name, BITRATE_BPS, data_bitrate=DATA_BITRATE_BPS if is_fd else None)
    with can.Bus(interface="virtual", channel=name) as bus:

        def send(can_id: int, data: bytes) -> None:
            bus.send(can.Message(arbitration_id=can_id, is_extended_id=False, data=data, is_fd=is_fd, check=False))
        return _listened(name, link, folder, lambda: run(send, is_fd, seconds), is_inside=True)


def on_terminal(folder: pathlib.Path, seconds: float) -> Listened:
    """Measure with the driver for serial adapters; the sender is a separate process."""
    master, slave = os.openpty()
    tty.setraw(slave)
    command = [sys.executable, "-m", "mtr_benchmarks.can_bus.load", str(master), str(seconds)]
    link = _TimedLink("slcan", os.ttyname(slave), BITRATE_BPS)
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
                          pass_fds=[master]) as process:
        try:
            return _listened("classic 500 kbit/s, slcan on a pseudo-terminal", link, folder,
                             lambda: _sent_by(process),
                             is_inside=False)
        finally:
            process.kill()
            os.close(master)
            os.close(slave)


def _sent_by(process: "subprocess.Popen[str]") -> Sent:
    """Start the sender after the link has opened its adapter, and wait for its result."""
    if process.stdin is None or process.stdout is None:
        raise OSError("The sender has no pipes.")
    process.stdin.write("\n")
    process.stdin.flush()
    return Sent(**json.loads(process.stdout.readline()))


def _listened(name: str, link: _TimedLink, folder: pathlib.Path, send: Callable[[], Sent], is_inside: bool) -> Listened:
    """Receive while the bus is loaded. is_inside: a thread of this process sends; its processor time is not the
    link's."""
    log = folder / f"{name.partition(',')[0].replace(' ', '_').replace('/', '')}_{int(is_inside)}.blf"
    link.log_to(log)
    link.connect()
    found: List[Sent] = []
    sender = threading.Thread(target=lambda: found.append(send()), daemon=True)
    begin_s, processor_s = time.monotonic(), time.process_time()
    sender.start()
    _statuses_while(link, sender.is_alive)
    wall_s, processor_s = time.monotonic() - begin_s, time.process_time() - processor_s
    sent, = found
    give_up_s = time.monotonic() + _PATIENCE_S
    while link.frames_received < sent.frames and time.monotonic() < give_up_s:
        time.sleep(0.01)
    link.close()
    own_s = processor_s - (sent.processor_s if is_inside else 0.0)
    return Listened(name, sent.frames, link.frames_received, sum(1 for _ in ReadLog(log)), sent.load, own_s / wall_s,
                    [heard_s - sent_s for sent_s, heard_s in zip(sent.changes_s, link.heard_s)])


def _statuses_while(link: CanCarLink, goes_on: Callable[[], bool]) -> None:
    """Feed the robot's Statuses to the link, as in a test."""
    number = 0
    while goes_on():
        number += 1
        now_s = time.monotonic()
        link.observe(RobotStatus(number, 1, now_s, sent_s=now_s, steady_s=now_s))
        time.sleep(_STATUS_S)
