"""What is wanted of the radials of a campaign, and what their presses cost."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..interval import FloatArray
from .hypotheses import UHF_FADING, Hypotheses, hypotheses_for
from .lattice import NEAR, NEAREST, Lattice

# Parts of the interval wanted into which d50 is divided.
_STEPS_PER_INTERVAL = 4.0


@dataclass(frozen=True)
class RobotTimes:
    """Times of robot and Car.

    Attributes:
        speed_mps: limit on the way.
        move_s: of each way beside its length by the speed: speeding up, slowing down, the last centimetres.
        settle_s: standstill before a press.
        answer_s: from the request of a press to the answer of the Car, when it works.
        timeout_s: the same until the press counts as failed.
    """

    speed_mps: float = 1.0
    move_s: float = 1.2
    settle_s: float = 0.3
    answer_s: float = 0.4
    timeout_s: float = 1.1

    def way_s(self, way_m: float) -> float:
        """Of a way; none takes no time."""
        return way_m / self.speed_mps + self.move_s if way_m > 0.0 else 0.0

    def press_s(self, worked: bool) -> float:
        """Of a press with its standstill."""
        return self.settle_s + (self.answer_s if worked else self.timeout_s)

    def expected_s(self, ways_m: FloatArray, probability: FloatArray) -> FloatArray:
        """Of a way and the press at its end."""
        answer_s = probability * self.answer_s + (1.0 - probability) * self.timeout_s
        return (ways_m > 0.0) * (ways_m / self.speed_mps + self.move_s) + self.settle_s + answer_s


@dataclass(frozen=True)
class SearchPlan:
    """What is wanted of each radial.

    Attributes:
        minimum_m, maximum_m: where presses are allowed.
        interval_m: half the width of the 95 % interval of d50 at which the radial ends.
        attempts_limit: presses after which it ends anyway.
        half_wavelength_m: presses so far apart are independent; 0.35 at 434 MHz, 0.17 at 868 MHz.
        checked_m: nearer than this the ground may have torn a hole into the range: each part of the way up to it gets a
            press. 0 where that cannot be.
        are_near: where half of the presses work on one radial is near that of the others.
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
        """The grid that is fine enough for the interval wanted."""
        return hypotheses_for(self.minimum_m, self.maximum_m, self.interval_m / _STEPS_PER_INTERVAL,
                              self.fading)

    @property
    def is_fine(self) -> bool:
        """True when the interval wanted is below what places half a wavelength apart tell of a sharp end."""
        return self.interval_m < self.half_wavelength_m / 2.0

    @property
    def lattice(self) -> Lattice:
        """Where the fading of one place says nothing of that of the next."""
        return Lattice(self.minimum_m, self.half_wavelength_m, NEAR if self.is_fine else NEAREST)

    def places_m(self) -> FloatArray:
        """The places of the lattice where presses are allowed, from near to far."""
        return self.lattice.places_within_m(self.minimum_m, self.maximum_m)
