"""What is wrong with the Car's bus or the adapter on it, in one sentence: lasting faults, errors, lost frames."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from .adapter import AdapterSettings
from .can_frame import CanFrame

# So many error frames without a frame are no accident.
_ENOUGH_ERRORS = 20
# Robot time for which an error frame, or a frame that was lost, makes the bus a suspect one.
_EFFECT_S = 1.0
_LOST = ("The CAN adapter has lost frames: they were not read in time; end other programs, or use an adapter with more "
         "room for them.")
_FD_ON_CLASSIC = ("The Car's bus carries CAN FD frames, and the adapter was opened for classic CAN; give the data bit "
                  "rate of the bus.")


class BusTrouble:
    """Fed by the reader and by every Status.

    Attributes:
        fault: what lasts, of the adapter itself; empty when there is nothing.
    """

    def __init__(self, settings: AdapterSettings):
        self.fault = ""
        self._settings = settings
        self._has_frames = self._has_fd = False
        self._error_frames = 0
        self._stamp_s = -math.inf
        self._errors, self._losses = _Suspicion(), _Suspicion()

    def frame(self, frame: CanFrame) -> None:
        """A data frame."""
        self._has_frames = True
        self._has_fd = self._has_fd or frame.is_fd

    def error_frame(self) -> None:
        """An error on the bus."""
        self._error_frames += 1
        self._errors.raised = True

    def frames_lost(self) -> None:
        """Frames that could not be read."""
        self._losses.raised = True

    def status(self, stamp_s: float) -> None:
        """A Status with this stamp of robot time has come."""
        self._stamp_s = stamp_s
        for suspicion in (self._errors, self._losses):
            suspicion.status(stamp_s)

    @property
    def problem(self) -> str:
        """One sentence, or empty."""
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
        """A sentence when there were error frames enough, and not one frame; empty else."""
        return self._without_frames() if self._error_frames >= _ENOUGH_ERRORS and not self._has_frames else ""

    def _without_frames(self) -> str:
        return (f"The CAN bus brings error frames ({self._error_frames}) and not one frame at "
                f"{self._settings.bitrate_bps} bit/s: the bit rate is another one, or the bus carries CAN FD.")


class _Suspicion:
    """Lasts for a while of robot time from the first Status after what raised it; before that at once."""

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
