"""Estimate of a test's duration and energy."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Sequence

from mtr_operator.domain.actions.car_size import Nearness, nearness_of, size_cautions
from mtr_operator.domain.forecast import Forecast
from mtr_operator.domain.geometry.pose import wrap_angle
from mtr_operator.domain.geometry.ray import Ray
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Forecasting, StartChecks
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.picture import Stretch
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters

# A middle-sized Car, before the robot has measured the real one.
USUAL_CAR = CarDimensions(4.5, 1.8, math.nan, math.nan)
# Before the bus is read: body ECUs send the lock state every 20 to 800 ms.
USUAL_FACTS = LockFacts(told_every_s=0.2)
# Measured in the simulation's demo: the round of the Car, the self-check, and the time per line for stops, turns on the
# spot and gentle accelerations. The estimates for its Autolock are 384 s (370 s measured), and for its Key press on a
# mapped Car 188 s (220 s measured), because the Car reacts nearer than in the middle.
MAPPING_S = 45.0
SELF_CHECK_S = 17.0
MANOEUVRES_S = 9.0
# Clearpath's data sheet of the Jackal: 2 h of heavy use.
HEAVY_USE_S = 2.0 * 3600.0
# Required charge at the end.
RESERVE_PERCENT = 15.0


@dataclass(frozen=True)
class Plan:
    """Plan of a test with some parameters around a Car.

    Attributes:
        stretches: paths of the key. preparation_s, lines_s: expected robot times.
        forecast: of each line, None without a model of it. cautions: limits of the parameters.
        nearness: reason why the robot must not approach as closely as the test requires; None without one.
    """

    stretches: tuple[Stretch, ...]
    preparation_s: float
    lines_s: tuple[float, ...]
    forecast: Forecast | None = None
    cautions: tuple[str, ...] = ()
    nearness: Nearness | None = None

    @property
    def duration_s(self) -> float:
        """Duration of the whole test."""
        return self.preparation_s + sum(self.lines_s)

    @property
    def battery_percent(self) -> float:
        """Charge consumed by the whole test."""
        return 100.0 * self.duration_s / HEAVY_USE_S

    def suffices(self, battery_percent: float) -> bool:
        """Return True if this charge is sufficient to the end, with a reserve."""
        return battery_percent - self.battery_percent >= RESERVE_PERCENT


def plan_of(scenario: AnyScenario, parameters: ScenarioParameters, car: CarDimensions, is_mapped: bool,
            facts: LockFacts = USUAL_FACTS) -> Plan:
    """Return the plan of a test; InvalidParameter if the parameters do not match a Car of this size. facts: of this
    Car."""
    lines = scenario.lines(parameters, car)
    near_m, far_m = parameters.distance_range_m
    rays = [line.ray for line in lines]
    forecasting = part(scenario, Forecasting)
    own_s = forecasting.expected_line_s(parameters)
    ways = _ways(rays, near_m, far_m)
    return Plan(
        tuple(Stretch(ray.point(near_m), ray.point(far_m), str(line.number)) for line, ray in zip(lines, rays)),
        (0.0 if is_mapped else MAPPING_S) + (SELF_CHECK_S if parameters.self_check else 0.0),
        tuple(own_s + MANOEUVRES_S + way_m / parameters.maximum_speed_mps for way_m in ways),
        forecasting.forecast(parameters, facts, ()),
        (*part(scenario, StartChecks).cautions(parameters, facts), *size_cautions(rays, car)),
        nearness_of(rays, near_m, car))


def _ways(rays: Sequence[Ray], near_m: float, far_m: float) -> list[float]:
    """Return the distances from a line to the start of the next one, in m: from its middle, on an arc around the
    Car."""
    middle_m = (near_m + far_m) / 2.0
    return [_way(before.point(middle_m), after.point(far_m)) for before, after in zip([*rays[:1], *rays], rays)]


def _way(start: tuple[float, float], goal: tuple[float, float]) -> float:
    turn = abs(wrap_angle(math.atan2(goal[1], goal[0]) - math.atan2(start[1], start[0])))
    inner, outer = sorted((math.hypot(*start), math.hypot(*goal)))
    return max(math.dist(start, goal), turn * inner + outer - inner)


class TimeLeft:
    """Time to the end, from the expected times of the lines and their accuracy so far.

    preparation_s: expected time for mapping and check before the next line.
    """

    def __init__(self, expected_s: Sequence[float], preparation_s: float = 0.0):
        self._expected_s = tuple(expected_s)
        self._preparation_s = preparation_s
        self._begun_with = self._done = 0
        self._begun_s = self._done_s = math.nan

    def begin(self, done: int, now_s: float) -> None:
        """Start or resume the test with this number of finished lines."""
        self._begun_with = self._done = done
        self._begun_s = self._done_s = now_s

    def advance(self, done: int, now_s: float) -> None:
        """Record a measured line."""
        self._done, self._done_s = done, now_s

    def left_s(self, now_s: float) -> float | None:
        """Return the time from now on; None if unknown."""
        if math.isnan(self._begun_s) or not self._expected_s:
            return None
        measured_s = sum(self._expected_s[self._begun_with:self._done])
        pace = (self._done_s - self._begun_s) / measured_s if measured_s else 1.0
        # A delay of the current action does not shorten the later ones.
        *now, later_s = ((self._preparation_s, sum(self._expected_s[self._done:])) if self._preparation_s else
                         (sum(self._expected_s[self._done:self._done + 1]), sum(self._expected_s[self._done + 1:])))
        return max(0.0, now[0] * pace - (now_s - self._done_s)) + later_s * pace
