"""Faults of the Car's bus or of its adapter as one sentence: lasting faults, error frames, lost frames."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from .adapter import AdapterSettings
from .can_frame import CanFrame

# So many error frames without a data frame are not a coincidence.
_ENOUGH_ERRORS = 20
# Robot time for which an error frame or a lost frame makes the bus suspect.
_EFFECT_S = 1.0
_LOST = ("The CAN adapter has lost frames: they were not read in time; end other programs, or use an adapter with more "
         "room for them.")
_FD_ON_CLASSIC = ("The Car's bus carries CAN FD frames, and the adapter was opened for classic CAN; give the data bit "
                  "rate of the bus.")


class BusTrouble:
    """State of the bus, updated by the reader and by each Status.

    Attributes:
        fault: lasting fault of the adapter itself; empty without one.
    """

    def __init__(self, settings: AdapterSettings):
        self.fault = ""
        self._settings = settings
        self._has_frames = self._has_fd = False
        self._error_frames = 0
        self._stamp_s = -math.inf
        self._errors, self._losses = _Suspicion(), _Suspicion()

    def frame(self, frame: CanFrame) -> None:
        """Record a data frame."""
        self._has_frames = True
        self._has_fd = self._has_fd or frame.is_fd

    def error_frame(self) -> None:
        """Record an error frame."""
        self._error_frames += 1
        self._errors.raised = True

    def frames_lost(self) -> None:
        """Record that frames could not be read."""
        self._losses.raised = True

    def status(self, stamp_s: float) -> None:
        """Advance to the robot time stamp of a Status."""
        self._stamp_s = stamp_s
        for suspicion in (self._errors, self._losses):
            suspicion.status(stamp_s)

    @property
    def problem(self) -> str:
        """Current fault as one sentence, or empty."""
        if self.fault:
            return self.fault
        if self._losses.holds(self._stamp_s):
            return _LOST
        if self._errors.holds(self._stamp_s):
            return self._error_sentence()
        is_classic = self._settings.data_bitrate_bps is None
        return _FD_ON_CLASSIC if self._has_fd and is_classic else ""

    def _error_sentence(self) -> str:
        if self._has_frames:
            return f"The CAN bus has errors ({self._error_frames} error frames); check bit rate, plug and termination."
        return self._without_frames()

    @property
    def no_frame(self) -> str:
        """Sentence if there were enough error frames and no data frame; else empty."""
        return self._without_frames() if self._error_frames >= _ENOUGH_ERRORS and not self._has_frames else ""

    def _without_frames(self) -> str:
        return (f"The CAN bus brings error frames ({self._error_frames}) and not one frame at "
                f"{self._settings.bitrate_bps} bit/s: the bit rate is another one, or the bus carries CAN FD.")


class _Suspicion:
    """Flag that lasts for a fixed robot time from the first Status after it was raised, and until that Status."""

    def __init__(self) -> None:
        self.raised = False
        self._until_s = -math.inf

    def status(self, stamp_s: float) -> None:
        if self.raised:
            self.raised, self._until_s = False, stamp_s + _EFFECT_S
        elif self._until_s > stamp_s + _EFFECT_S:
            # The robot's clock was set back.
            self._until_s = -math.inf

    def holds(self, stamp_s: float) -> bool:
        return self.raised or stamp_s < self._until_s
