"""Decides if the hardware stop of the base counts as engaged. Pure."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, NamedTuple, Optional

from mtr_core.liveness import is_fresh

PRESENT_FIELD, STOPPED_FIELD = "driver_external_stop_present", "driver_external_stop_stopped"
# Reasons, for the log.
NEVER_RECEIVED = "the base has not reported its hardware stop yet"
SILENT = "the base no longer reports its hardware stop"
ABSENT = "the base reports that no hardware stop is connected"
PRESSED = "the hardware stop of the base is engaged"
UNREADABLE = "the status of the base does not contain its hardware stop"


class StopReport(NamedTuple):
    """Content of one status of the base."""

    is_present: bool
    is_stopped: bool


def stop_report(status: Any) -> Optional[StopReport]:
    """The report of a jackal_msgs/Status; None for a message without these fields."""
    present, stopped = (getattr(status, name, None) for name in (PRESENT_FIELD, STOPPED_FIELD))
    return StopReport(present, stopped) if isinstance(present, bool) and isinstance(stopped, bool) else None


class BaseStop:
    """Evaluation of the newest report; every unknown state counts as engaged."""

    def __init__(self, silent_after_s: float):
        self._silent_after_s = silent_after_s
        self._received_s = math.nan
        self._newest: Optional[StopReport] = None

    def receive(self, report: Optional[StopReport], now_s: float) -> None:
        """Process a status of the base; None for one that cannot be read."""
        self._newest, self._received_s = report, now_s

    def reason(self, now_s: float) -> str:
        """Return why the stop counts as engaged; empty if it is released."""
        if math.isnan(self._received_s):
            return NEVER_RECEIVED
        if not is_fresh(now_s - self._received_s, self._silent_after_s):
            return SILENT
        if self._newest is None:
            return UNREADABLE
        if self._newest.is_stopped:
            return PRESSED
        return "" if self._newest.is_present else ABSENT
