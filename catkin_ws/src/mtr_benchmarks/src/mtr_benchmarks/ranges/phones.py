"""Phones that measure every 0.2 to 10 s, with feeds that repeat the newest figure ten times per second."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
from typing import Dict, Iterator, List, NamedTuple, Optional

from mtr_operator.domain.distance_feed import Reported
from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.scenarios.digital_key.parameters import DigitalKeyParameters
from mtr_operator.domain.scenarios.digital_key.reading import Answer, read

PERIODS_S = (0.2, 0.5, 1.0, 2.0, 4.0, 6.0, 8.0, 10.0)
# Default of the scenario, and its longest time.
WINDOWS_S = (5.0, 55.0)
# Correlation of neighbouring measurements: none, or caused by a filter over some of them.
CORRELATIONS = (0.0, 0.3)
# A signal of the bus and plain lines have neither age nor clock; other lines have the age of their figure.
FEEDS = ("bus", "aged")
ERROR_M = 0.15
REPEATED_S, STEP_DIGITS = 0.1, 2
# Time for which the phone measures before the robot stops.
_BEFORE_S = 12.0


class Phone(NamedTuple):
    """One kind of phone. period_s: time between measurements. correlation: of their errors. has_age: the feed reports
    the age."""

    period_s: float
    correlation: float = 0.0
    has_age: bool = False


class Coverage(NamedTuple):
    """Number of places, of valid places with a distance, and of places whose 95 % interval contains the true
    distance."""

    places: int
    valid: int
    holds: int

    @property
    def share(self) -> Optional[float]:
        """Share of the valid places; None if there is none."""
        return self.holds / self.valid if self.valid else None


def figures(phone: Phone, true_m: float, window_s: float, chance: random.Random) -> Iterator[Reported]:
    """Yield the figures of a feed until the end of the window, which begins at 0 s."""
    measured_s = -_BEFORE_S - phone.period_s * chance.random()
    error, figure_m = chance.gauss(0.0, 1.0), math.nan
    time_s = -1.0 + REPEATED_S * chance.random()
    while time_s <= window_s:
        while measured_s + phone.period_s <= time_s:
            measured_s += phone.period_s
            fresh = math.sqrt(1.0 - phone.correlation ** 2) * chance.gauss(0.0, 1.0)
            error = phone.correlation * error + fresh
            figure_m = round(true_m + ERROR_M * error, STEP_DIGITS)
        yield Reported(time_s, figure_m, age_s=time_s - measured_s if phone.has_age else 0.0)
        time_s += REPEATED_S


def coverage(phone: Phone, window_s: float, places: int, seed: int) -> Coverage:
    """Read `places` random places with the application's code."""
    # The age limit is at most the window, so that old figures are detected only by their changes.
    parameters = DigitalKeyParameters(reading_time_s=window_s, maximum_age_s=min(window_s, 30.0))
    chance, valid, holds = random.Random(f"{seed} {phone} {window_s}"), 0, 0
    for _ in range(places):
        true_m = chance.uniform(0.5, 4.5)
        reading = read(list(figures(phone, true_m, window_s, chance)), (0.0, window_s), parameters)
        if reading.answer is Answer.DISTANCE and reading.median is not None:
            valid += 1
            holds += abs(reading.median.value_m - true_m) <= SIGMAS_OF_LEVEL * reading.median.sigma_m
    return Coverage(places, valid, holds)


def measure_phones(places: int, seed: int) -> Dict[str, Coverage]:
    """Return the coverage of all kinds of phones and feeds by their names."""
    kinds: List[Phone] = [Phone(period_s, correlation, feed == "aged")
                          for feed in FEEDS for correlation in CORRELATIONS for period_s in PERIODS_S]
    return {f"{'aged' if phone.has_age else 'bus'}/r {phone.correlation:g}/{phone.period_s:g} s/read {window_s:g} s":
            coverage(phone, window_s, places, seed) for phone in kinds for window_s in WINDOWS_S}
