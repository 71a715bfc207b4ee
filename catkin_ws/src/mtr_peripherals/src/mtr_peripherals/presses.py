"""Executes each press once and stores the reports."""
# SPDX-License-Identifier: Apache-2.0
import struct
import zlib
from collections import deque
from dataclasses import dataclass
from typing import Deque, Dict, Optional, Tuple

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import Press, PressReport

from . import problems
from .calibration import Calibration, RequestRefused
from .firmware import FirmwareReport, PressState, ServoPress

KEPT_REPORTS = 8
# Time after its first order in which the firmware may start a press.
BEGIN_WITHIN_NS = 2_000_000_000
# Time for servo travel, transport and repetition; a press that is not complete after its hold time and this has failed.
PRESS_MARGIN_NS = 3_000_000_000
MILLISECOND_NS = 1_000_000
MAX_FIRMWARE_ID = 2 ** 32 - 1
# The dispatcher refuses as many former sessions.
REMEMBERED_SESSIONS = 1000


def firmware_id_of(press: Press) -> int:
    """Return the id of a press for the firmware, which a restarted node computes again.

    Presses within a session count up, so their ids differ; presses of another session start at another number.
    """
    return (zlib.crc32(struct.pack("<Q", press.session_id)) + press.id) % MAX_FIRMWARE_ID + 1


@dataclass
class _Running:
    press: Press
    firmware: ServoPress
    deadline_ns: int
    seen: bool = False


class Presses:
    """One press at a time.

    Attributes:
        results: the latest ones, newest last.
    """

    def __init__(self, calibration: Calibration):
        self._calibration = calibration
        self.results: Deque[PressReport] = deque(maxlen=KEPT_REPORTS)
        self._running: Optional[_Running] = None
        # Newest press id by session.
        self._newest: Dict[int, int] = {}

    @property
    def pressed_buttons(self) -> Tuple[int, ...]:
        """Buttons currently held down."""
        return self._running.press.buttons if self._running and self._running.seen else ()

    def take_up(self, press: Press, report: Optional[FirmwareReport], now_ns: int) -> None:
        """Process the first press after the start of this node, which may be an old one.

        If the firmware knows the press, its report is followed. Otherwise it is not ordered again, because its result
        is unknown.
        """
        if self._newest or report is None:
            return
        self._remember(press)
        if not press.id:
            return
        if report.press_id == firmware_id_of(press):
            self._begin(press, now_ns)
        else:
            self._finish(press, now_ns, now_ns, problems.PRESS_UNKNOWN())

    def step(self, press: Press, report: Optional[FirmwareReport], now_ns: int,
             stop: Problem = NO_PROBLEM) -> Optional[ServoPress]:
        """Process the requested press and the firmware's newest report; return the order for the firmware.

        stop: why no press may start.
        """
        if report is None:
            return None
        if self._running:
            self._follow(self._running, report, now_ns, stop)
        if self._running is None and press.id > self._newest.get(press.session_id, 0):
            self._remember(press)
            if stop:
                self._finish(press, now_ns, now_ns, problems.PRESS_STOPPED(cause=stop))
            else:
                self._begin(press, now_ns)
        return self._running.firmware if self._running and not self._running.seen else None

    def _remember(self, press: Press) -> None:
        self._newest.pop(press.session_id, None)
        self._newest[press.session_id] = press.id
        if len(self._newest) > REMEMBERED_SESSIONS:
            del self._newest[next(iter(self._newest))]

    def _begin(self, press: Press, now_ns: int) -> None:
        try:
            firmware = ServoPress(firmware_id_of(press), self._calibration.servos(press.buttons),
                                  self._calibration.strength(press.strength),
                                  self._calibration.hold_ms(press.duration_s), now_ns + BEGIN_WITHIN_NS)
        except RequestRefused as refused:
            self._finish(press, now_ns, now_ns, refused.problem)
            return
        self._running = _Running(press, firmware, now_ns + firmware.hold_ms * MILLISECOND_NS + PRESS_MARGIN_NS)

    def _follow(self, running: _Running, report: FirmwareReport, now_ns: int, stop: Problem) -> None:
        if report.press_id == running.firmware.id:
            running.seen = True
            if report.press_state is PressState.DONE:
                self._finish(running.press, report.press_start_ns, report.press_end_ns)
            elif report.press_state is PressState.REFUSED:
                self._finish(running.press, now_ns, now_ns, problems.PRESS_REFUSED())
            elif report.press_state is PressState.CUT_SHORT:
                self._finish(running.press, now_ns, now_ns, problems.PRESS_CUT_SHORT())
        elif running.seen:
            self._finish(running.press, now_ns, now_ns, problems.PRESS_RESTARTED())
        elif stop:
            # The order may be in transit and may arrive before the stop.
            self._finish(running.press, now_ns, now_ns, problems.PRESS_CUT_SHORT())
        if self._running and now_ns > running.deadline_ns:
            self._finish(running.press, now_ns, now_ns, problems.PRESS_LATE())

    def _finish(self, press: Press, start_ns: int, end_ns: int,
                error: Problem = NO_PROBLEM) -> None:
        self.results.append(PressReport(press.id, press.session_id, start_ns, end_ns, error))
        self._running = None
