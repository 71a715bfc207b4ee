"""Checks of the IMU of another robot's bag against its odometry."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Sequence, Tuple

import numpy as np

from mtr_core.arrays import FloatArray

from .errors import BagUnusable
from .turn_lag import Rates, rates_of, turn_lag

REMEDY = "or replay with --imu none"
# Range of the search for offsets; a gyro is accurate enough to find large ones, too.
MAX_LAG_S = 30.0
# Shortest gap that counts as a fault (a slow IMU has shorter ones), and largest share of gaps in the recording.
MIN_GAP_S, MAX_MISSING = 1.0, 0.05
# Lowest turn rate in rad/s. A frozen gyro deviates from the odometry by at least that, and by this share of the rate.
TURNS_RADPS, DIFFERS = 0.1, 0.3
REPEATS, MAX_FROZEN = 10, 0.1
# A gyro in degrees per second shows 57.3 times the turn rate.
MIN_DEGREES, MAX_DEGREES = 40.0, 80.0
MAX_BAD = 0.5


class ImuCheck:
    """Checks of stamps and values of one IMU."""

    def __init__(self, topic: str) -> None:
        self.topic, self._unstamped = topic, 0
        self._samples: List[Tuple[float, float]] = []
        # Number of preceding samples with identical values, for each sample.
        self._repeats: List[int] = []
        self._last: Tuple[float, ...] = ()

    def add(self, stamp_s: float, rate_radps: Sequence[float], force_mps2: Sequence[float]) -> bool:
        """Add a message in the robot's frame; return False if it has no stamp and must be skipped."""
        if stamp_s <= 0.0:
            self._unstamped += 1
            return False
        values = (*rate_radps, *force_mps2)
        self._repeats.append(self._repeats[-1] + 1 if values == self._last else 0)
        self._last = values
        self._samples.append((stamp_s, rate_radps[2]))
        return True

    @property
    def rates(self) -> Rates:
        """Turn rates so far."""
        return rates_of(self._samples)

    def faults(self, odometry: str, turns: Rates) -> List[str]:
        """Return sentences about missing parts; BagUnusable if the IMU is not usable.

        Args:
            odometry: topic of the odometry.
            turns: turn rates of the odometry.
        """
        total = self._unstamped + len(self._samples)
        if self._unstamped > MAX_BAD * total:
            raise BagUnusable(f"{self._unstamped} of {total} messages of {self.topic} have the stamp 0: correct the "
                              f"IMU's driver, {REMEDY}.")
        rates = self.rates
        if total and len(rates.times_s) <= (1.0 - MAX_BAD) * len({time_s for time_s, _ in self._samples}):
            raise BagUnusable(f"The turn rates of {self.topic} are not numbers: check the IMU and its driver, "
                              f"{REMEDY}.")
        if len(rates.times_s) < 2:
            return [f"The IMU on {self.topic} has {total} messages: check its driver, {REMEDY}."]
        self._check_stamps(odometry, turns, rates)
        self._check_values(turns)
        return self._missing(odometry, turns, rates)

    def _check_stamps(self, odometry: str, turns: Rates, rates: Rates) -> None:
        """Raise BagUnusable if the stamps belong to another clock."""
        lag = turn_lag(turns, rates, MAX_LAG_S)
        late_s = lag.lag_s if lag is not None and lag.is_certain else 0.0
        if rates.times_s[-1] < turns.times_s[0] or rates.times_s[0] > turns.times_s[-1]:
            late_s = float(rates.times_s[0] - turns.times_s[0])
        if late_s:
            side = "late" if late_s > 0.0 else "early"
            raise BagUnusable(f"The stamps of {self.topic} are {abs(late_s):.2f} s {side} compared with {odometry}: "
                              f"correct the IMU's clock, {REMEDY}.")

    def _check_values(self, turns: Rates) -> None:
        """Raise BagUnusable if the gyro is frozen while the robot turns, or measures in degrees."""
        times_s, gyro = np.array(self._samples).T
        wheels: FloatArray = np.interp(times_s, turns.times_s, turns.rates_radps, left=0.0, right=0.0)
        turning = np.abs(wheels) > TURNS_RADPS
        if not turning.any():
            return
        if np.ptp(gyro) > 0.0 and MIN_DEGREES < abs(float(np.median(gyro[turning] / wheels[turning]))) < MAX_DEGREES:
            raise BagUnusable(f"The turn rates of {self.topic} are in degrees per second: convert them to rad/s, "
                              f"{REMEDY}.")
        differs = np.abs(gyro - wheels) > np.maximum(TURNS_RADPS, DIFFERS * np.abs(wheels))
        frozen = (np.array(self._repeats) >= REPEATS) & differs
        if frozen[turning].mean() > MAX_FROZEN:
            raise BagUnusable(f"The IMU on {self.topic} repeats the same values while the robot turns: check the IMU "
                              f"and its driver, {REMEDY}.")

    def _missing(self, odometry: str, turns: Rates, rates: Rates) -> List[str]:
        """Return a sentence if the IMU has long gaps, starts late or ends early."""
        begin_s, end_s = float(turns.times_s[0]), float(turns.times_s[-1])
        edges = np.concatenate([[begin_s], np.clip(rates.times_s, begin_s, end_s), [end_s]])
        gaps_s = np.diff(edges)
        missing_s = float(gaps_s[gaps_s > MIN_GAP_S].sum())
        if missing_s <= MAX_MISSING * (end_s - begin_s):
            return []
        return [f"The IMU on {self.topic} is silent for {missing_s:.1f} s of the {end_s - begin_s:.1f} s of {odometry}"
                f": check its driver, {REMEDY}."]
