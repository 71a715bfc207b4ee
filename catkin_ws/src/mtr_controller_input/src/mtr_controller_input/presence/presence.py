"""Presence of the controller: its device exists, and it still reports regularly."""
# SPDX-License-Identifier: Apache-2.0
import os
import pathlib
from typing import Optional

from .heartbeat import Heartbeat
from .reports import ReportFile, open_reports

SEARCH_PERIOD_S = 1.0
# Time after which a controller without regular reports counts as unwatched, and the Operator is notified.
UNWATCHED_AFTER_S = 10.0


class Presence:
    """Updated at each tick of a node, by wall time, because a controller's reports have the rate of the real world."""

    def __init__(self, device: str, lost_after_s: float, root: pathlib.Path = pathlib.Path("/")):
        """device: of joystick or events, as a path below root; empty for a controller that is not checked."""
        self._device, self._lost_after_s, self._root = device, lost_after_s, root
        self._heartbeat = Heartbeat(lost_after_s)
        self._reports: Optional[ReportFile] = None
        self._searched_s = self._here_since_s = self._now_s = float("-inf")
        self._is_here = False

    @property
    def is_watched(self) -> bool:
        """True if the loss of an idle controller would be detected."""
        return self._heartbeat.is_watched

    @property
    def is_unwatched(self) -> bool:
        """True for a controller that has been present for a while, and whose loss would not be detected."""
        return self._is_here and not self.is_watched and self._now_s - self._here_since_s >= UNWATCHED_AFTER_S

    def update(self, now_s: float, is_idle: bool) -> bool:
        """Return True while the controller is present; is_idle: its state has not changed since the previous tick."""
        self._now_s = now_s
        if not self._device:
            return True
        if not os.path.exists(self._root / self._device.lstrip("/")):
            self._forget()
            return False
        if not self._is_here:
            self._is_here, self._here_since_s = True, now_s
        return not self._heartbeat.update(now_s, self._has_reported(now_s), is_idle)

    def close(self) -> None:
        """Close the report file."""
        if self._reports is not None:
            self._reports.close()
            self._reports = None

    def _has_reported(self, now_s: float) -> bool:
        if self._reports is None and now_s - self._searched_s >= SEARCH_PERIOD_S:
            self._searched_s = now_s
            self._reports = open_reports(self._device, self._root)
        try:
            return self._reports is not None and self._reports.has_reported()
        except OSError:
            # Without reports the heartbeat ends.
            self.close()
            return False

    def _forget(self) -> None:
        """Reset the state, because another controller may get the same name."""
        self.close()
        self._is_here, self._heartbeat = False, Heartbeat(self._lost_after_s)
        self._searched_s = float("-inf")
