"""Requirements on the radials of a campaign, and the cost of their presses."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..interval import FloatArray
from .hypotheses import UHF_FADING, Hypotheses, hypotheses_for
from .lattice import NEAR, NEAREST, Lattice

# Number of d50 steps per required interval.
_STEPS_PER_INTERVAL = 4.0


@dataclass(frozen=True)
class RobotTimes:
    """Durations of robot and Car.

    Attributes:
        speed_mps: limit on the path.
        move_s: of each move, in addition to length by speed: acceleration, braking, the last centimetres. settle_s:
        standstill before a press.
        answer_s: from the request of a press to the reaction of the Car, if it works.
        timeout_s: from the request until the press counts as failed.
    """

    speed_mps: float = 1.0
    move_s: float = 1.2
    settle_s: float = 0.3
    answer_s: float = 0.4
    timeout_s: float = 1.1

    def way_s(self, way_m: float) -> float:
        """Return the duration of a move; 0 without one."""
        return way_m / self.speed_mps + self.move_s if way_m > 0.0 else 0.0

    def press_s(self, worked: bool) -> float:
        """Return the duration of a press with its standstill."""
        return self.settle_s + (self.answer_s if worked else self.timeout_s)

    def expected_s(self, ways_m: FloatArray, probability: FloatArray) -> FloatArray:
        """Return the expected duration of a move and the press at its end."""
        answer_s = probability * self.answer_s + (1.0 - probability) * self.timeout_s
        return (ways_m > 0.0) * (ways_m / self.speed_mps + self.move_s) + self.settle_s + answer_s


@dataclass(frozen=True)
class SearchPlan:
    """Requirements on each radial.

    Attributes:
        minimum_m, maximum_m: range of allowed presses.
        interval_m: half the width of the 95 % interval of d50 at which the radial ends.
        attempts_limit: presses after which it ends anyway.
        half_wavelength_m: distance of independent presses; 0.35 at 434 MHz, 0.17 at 868 MHz.
        checked_m: the ground reflection may cause a hole in the range up to this distance, so each part of the path up
            to it gets a press. 0 if holes are impossible.
        are_near: d50 of one radial is near d50 of the others.
        fading: prior probability that the field fades in space.
    """

    minimum_m: float
    maximum_m: float
    interval_m: float = 0.25
    attempts_limit: int = 24
    half_wavelength_m: float = 0.35
    times: RobotTimes = RobotTimes()
    checked_m: float = 0.0
    are_near: bool = True
    fading: float = UHF_FADING

    def hypotheses(self) -> Hypotheses:
        """Return a grid that is fine enough for the required interval."""
        return hypotheses_for(self.minimum_m, self.maximum_m, self.interval_m / _STEPS_PER_INTERVAL,
                              self.fading)

    @property
    def is_fine(self) -> bool:
        """True if the required interval is finer than the resolution of places half a wavelength apart at a sharp
        end."""
        return self.interval_m < self.half_wavelength_m / 2.0

    @property
    def lattice(self) -> Lattice:
        """Return the places with independent fading."""
        return Lattice(self.minimum_m, self.half_wavelength_m, NEAR if self.is_fine else NEAREST)

    def places_m(self) -> FloatArray:
        """Return the places of the lattice within the allowed range, from near to far."""
        return self.lattice.places_within_m(self.minimum_m, self.maximum_m)
