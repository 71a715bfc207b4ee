"""One Status, one answer: the exchange of a run with the robot, through silences of the link."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace
from typing import Callable

from ..actions.observer import RunObserver
from ..actions.standstill import Standstill
from ..actions.trouble import Cancelled
from ..errors import LinkLost, RobotFailed, StoodStill
from ..ports import LinkStatistics, RobotLink
from ..requests import DesiredState
from ..robot_status import RobotStatus

# Wall time of one look for a Status, after which a stop leaves, and another one as long as no Status comes.
POLL_PERIOD_S = 0.05
# So many looks after which the desired state is sent again when no Status comes.
RESEND_POLLS = 4
# Wall time of silence after which nothing that moves is sent: the robot has stopped by itself, and shall not be moved
# by an order that nobody sees the effect of.
MAX_BLIND_S = 1.0
# Wall time of silence at which a test ends; an interruption of the Wi-Fi is shorter.
SILENCE_LIMIT_S = 30.0
# Wall time within which the first Status has to come.
FIRST_STATUS_LIMIT_S = 10.0
# Silence that is reported to a view.
_SILENCE_SHOWN_S = 1.0
# Time that stopping may take: of the robot, and of silence in which a cancelled run still waits for a Status.
STOP_LIMIT_S = 3.0


class Exchange:
    """Sends each answer and takes each Status of one run.

    Attributes:
        status: newest Status, None before the first. standstill: detects that the laptop slept.
    """

    def __init__(self, link: RobotLink, wanted: Callable[[], DesiredState], observer: RunObserver,
                 is_cancelled: Callable[[], bool]):
        """wanted: content of the next answer."""
        self.status: RobotStatus | None = None
        self.standstill = Standstill(SILENCE_LIMIT_S)
        self._link = link
        self._wanted = wanted
        self._observer = observer
        self._is_cancelled = is_cancelled
        self._was_in_control = False

    @property
    def statistics(self) -> LinkStatistics:
        """Counts of the link."""
        return self._link.statistics

    @property
    def is_answered(self) -> bool:
        """True when the robot had received the last answer before it sent the newest Status."""
        return self.status is not None and self._link.is_answered(self.status)

    def take(self, patience_s: float = SILENCE_LIMIT_S) -> RobotStatus:
        """Answer the newest Status and return the next one; LinkLost after patience_s of wall time without one."""
        self._check_standstill()
        if self.status is not None:
            self.answer()
        self.status = self._next_status(FIRST_STATUS_LIMIT_S if self.status is None else patience_s)
        return self.status

    def answer(self) -> None:
        """Send the wanted state as the answer to the newest Status, again if it was answered already."""
        self._link.send(self._wanted())

    def _next_status(self, patience_s: float) -> RobotStatus:
        silent_s = 0.0
        for poll in range(1, round(patience_s / POLL_PERIOD_S) + 1):
            status = self._link.next_status(POLL_PERIOD_S)
            # Before anything is sent again that moves.
            self._check_standstill()
            if status is not None:
                return status
            silent_s = poll * POLL_PERIOD_S
            cancelled = self._is_cancelled()
            if silent_s >= _SILENCE_SHOWN_S and poll % RESEND_POLLS == 0:
                self._observer.on_link_silent(silent_s)
            if cancelled and silent_s >= STOP_LIMIT_S:
                raise Cancelled("The test was interrupted.")
            if self.status is not None and (cancelled or poll % RESEND_POLLS == 0):
                self._send_blindly(cancelled or silent_s >= MAX_BLIND_S)
        error = self._link.statistics.last_error
        if self.status is None:
            raise LinkLost(f"The robot's ports are open, but no Status has come for {silent_s:.0f} s; check that both "
                           f"ports are the robot's. {error}".rstrip())
        raise LinkLost(f"The robot has been silent for {silent_s:.0f} s; check the Wi-Fi and that its software runs. "
                       f"{error}".rstrip())

    def _check_standstill(self) -> None:
        said = self.standstill.look()
        if said:
            raise StoodStill(f"{said} The line at hand is measured anew when the test goes on.")

    def _send_blindly(self, stop: bool) -> None:
        """Send the desired state again without knowing what the robot does; a stop waits for no Status."""
        self._link.send(replace(self._wanted(), stop=True) if stop else self._wanted())

    def check_control(self, status: RobotStatus) -> None:
        """Raise RobotFailed when another application has taken over the control."""
        if status.controlled_by_other and self._was_in_control:
            raise RobotFailed("Another application has taken over the control of the robot.")
        self._was_in_control = self._was_in_control or (status.session_id != 0 and not status.controlled_by_other)
