"""What Digital key records of one place."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from ... import limits
from ...distance_feed import REPORTED
from ...estimation.interval import SIGMAS_OF_LEVEL
from ...results.carried import HEADING_DOC, LATERAL_DOC
from ...results.document import Floats, OptionalFloat, Texts
from ...results.line_result import LineResult, LineStatus, MeasuredDistance, column, stored
from ...results.quantity import MeasuredQuantity
from .reading import Answer

PHONE, PHONE_ERROR = "phone", "phone_error"
# Of a place at 20 figures a second for most of a minute; more are thinned out.
MAX_FIGURES = 1000
_ANSWERS = tuple(answer.value for answer in Answer)
_ROUNDING_M = 1e-3


@dataclass(frozen=True)
class DigitalKeyResult(LineResult):
    """Errors are reported less the robot's distance: positive where the phone takes itself to be farther."""

    position: int = column("number of the position, clockwise from the Car's front, inwards on one radial and outwards "
                               "on the next")
    side: str = column("side or corner of the Car")
    nominal_m: float = column("where the place was to be: distance from the Car's outline along its radial", "m")
    key_height_m: float = column("height of the phone above ground", "m")
    status: LineStatus = column("ok or invalid")
    answer: str = column("what came of the place: distance; none: too few figures; stale: old ones; clock: the feed's "
                         "clock was set; constant: it did not change, changed too rarely, or is one figure at all "
                         "distances; empty: the robot did not stand there undisturbed", default="")
    samples: int = column("reported distances", default=0)
    reported_m: OptionalFloat = column("median of the reported distances, a repeated one counted once", "m",
                                       default=None)
    reported_spread_m: OptionalFloat = column("standard deviation of the reported distances, a repeated one counted "
                                              "once", "m", default=None)
    reported_sigma_m: OptionalFloat = column("1 sigma of the median", "m", default=None)
    age_s: OptionalFloat = column("greatest age of the newest reported distance while it was read", "s", 3, None)
    reference_m: OptionalFloat = column("robot's distance of the phone from the reference", "m", default=None)
    uncertainty_m: OptionalFloat = column("1 sigma of the robot's distance", "m", default=None)
    error_m: OptionalFloat = column("reported less the robot's distance", "m", default=None)
    error_low_m: OptionalFloat = column("lower end of the 95 % interval of the error", "m", default=None)
    error_high_m: OptionalFloat = column("upper end of the 95 % interval of the error", "m", default=None)
    robot_time_s: OptionalFloat = column("robot's clock in the middle of the reading", "s", 3, None)
    x_m: OptionalFloat = column("place of the phone, Car coordinate system", "m", default=None)
    y_m: OptionalFloat = column("place of the phone, Car coordinate system", "m", default=None)
    along_m: OptionalFloat = column("distance of the phone from the Car's outline along its radial", "m", default=None)
    lateral_offset_m: OptionalFloat = column(LATERAL_DOC, "m", default=None)
    heading_offset_deg: OptionalFloat = column(HEADING_DOC, "deg", 2, None)
    reason: str = stored("")
    figures_m: Floats = stored(())
    evidence: Texts = stored(())

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.position

    @property
    def place(self) -> str:
        """See LineResult."""
        return f"{self.side.replace('_', ' ')} {self.nominal_m:.2f} m"

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult: what the phone reported. Its budget is that of the error, for the robot's is in it."""
        if self.status is not LineStatus.OK or self.reported_m is None or self.reported_sigma_m is None:
            return (MeasuredDistance(PHONE, self.status, None, None),)
        reach_m = SIGMAS_OF_LEVEL * self.reported_sigma_m
        return (MeasuredDistance(PHONE, self.status, self.reported_m, self.uncertainty_m, self.reported_m - reach_m,
                                 self.reported_m + reach_m, key_m=self.along_m),)

    @property
    def quantities(self) -> tuple[MeasuredQuantity, ...]:
        """See LineResult: by the scatter of the figures; the robot's own errors are those of its distance."""
        if self.error_m is None or self.reported_sigma_m is None:
            return (MeasuredQuantity(PHONE_ERROR, None, None),)
        reach_m = SIGMAS_OF_LEVEL * self.reported_sigma_m
        return (MeasuredQuantity(PHONE_ERROR, self.error_m - reach_m, self.error_m + reach_m, self.error_m, PHONE,
                                 is_magnitude=True),)

    @property
    def is_unanswered(self) -> bool:
        """The robot stood there, and what came is no distance to be believed."""
        return self.answer not in (Answer.DISTANCE.value, Answer.NOT_MEASURED.value)

    @property
    def is_possible(self) -> bool:
        """See LineResult: the error is that of its distances, and a valid one has all."""
        figures_fit = (len(self.figures_m) <= min(self.samples, MAX_FIGURES)
                       and all(map(REPORTED.allows, self.figures_m)))
        if not figures_fit or self.answer not in _ANSWERS or self.samples < 0:
            return False
        if self.status is not LineStatus.OK:
            return self.status is LineStatus.INVALID and self.error_m is None
        values = (self.reported_m, self.reference_m, self.error_m, self.error_low_m, self.error_high_m)
        if self.answer != Answer.DISTANCE.value or any(value is None for value in values):
            return False
        reported_m, reference_m, error_m, low_m, high_m = (value or 0.0 for value in values)
        is_sigma = all(limits.DISTANCE_SIGMA.allows(sigma_m) for sigma_m in (self.uncertainty_m, self.reported_sigma_m))
        return (is_sigma and math.isclose(error_m, reported_m - reference_m, abs_tol=_ROUNDING_M)
                and low_m <= error_m <= high_m)
