"""Forecast of the test on the command line, before the start and after each line."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import math
from typing import Iterator

from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.interfaces.part import part
from mtr_operator.domain.interfaces.scenario_parts import Forecasting
from mtr_operator.domain.ports import LockFacts
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.scenario import AnyScenario, ScenarioParameters
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.verdict.suitability import check_before_start
from mtr_operator.station.estimate import USUAL_CAR, USUAL_FACTS, Plan, TimeLeft, plan_of
from mtr_operator.storage.given_files import load_limits
from mtr_operator.storage.parameter_file import load_parameters
from mtr_operator.terminal import show

# Durations from here on are given in minutes.
_MINUTES_FROM_S = 90.0


def plan(options: argparse.Namespace) -> None:
    """Print the estimated duration and precision of a test, and the limits of its parameters; nothing is connected or
    written."""
    scenario = SCENARIOS[options.scenario]
    parameters = load_parameters(options.params, scenario.parameters_type)
    if options.limits is not None:
        check_before_start(load_limits(options.limits), scenario, parameters)
    planned = plan_of(scenario, parameters, USUAL_CAR, False, _facts_of(options.car_profile))
    for line in plan_lines(scenario, planned):
        show(line)


def plan_lines(scenario: AnyScenario, planned: Plan) -> Iterator[str]:
    """Yield lines, time, attempts and intervals, and a warning for each limit of the parameters."""
    count = len(planned.stretches)
    yield f"{count} lines ({scenario.line_word}), about {duration_text(planned.duration_s)} of robot time"
    if planned.forecast is not None:
        few, many = (count * attempts for attempts in planned.forecast.attempts)
        yield planned.forecast.text
        yield f"attempts in all: {few if few == many else f'{few} to {many}'}"
    for caution in planned.cautions:
        yield f"warning: {caution}"


class RunForecast:
    """Forecast of the rest of a test, from the model and the results so far."""

    def __init__(self, scenario: AnyScenario, parameters: ScenarioParameters, facts: LockFacts, progress: Progress):
        self._scenario = scenario
        self._parameters = parameters
        self._facts = facts
        self._progress = progress
        self._time_left = TimeLeft(())
        self._now_s = math.nan

    def before(self, status: RobotStatus) -> str:
        """Return the forecast before the robot moves."""
        car = self._progress.car or status.car or USUAL_CAR
        try:
            planned = plan_of(self._scenario, self._parameters, car, status.car is not None, self._facts)
        except InvalidParameter:  # The Car's size may be a guess; the runner reports the fault.
            return f"expected: {self._lines_text()}"
        measured = {str(number) for number in self._progress.measured()}
        lines_s = sum(line_s for stretch, line_s in zip(planned.stretches, planned.lines_s)
                      if stretch.label not in measured)
        return f"expected: about {duration_text(planned.preparation_s + lines_s)}; {self._lines_text()}"

    def on_status(self, status: RobotStatus) -> None:
        """Advance the robot time to a Status."""
        self._now_s = status.stamp_s

    def on_plan(self, done: int) -> None:
        """Start with the lines, of which some may be finished."""
        planned = plan_of(self._scenario, self._parameters, self._progress.measured_car, True, self._facts)
        self._time_left = TimeLeft(planned.lines_s)
        self._time_left.begin(done, self._now_s)

    def after_line(self, done: int) -> str:
        """Return the forecast after a line; empty at the end of the test."""
        self._time_left.advance(done, self._now_s)
        left_s = self._time_left.left_s(self._now_s)
        return f"expected: about {duration_text(left_s)} left; {self._lines_text()}" if left_s else ""

    def _lines_text(self) -> str:
        forecast = part(self._scenario, Forecasting).forecast(self._parameters, self._facts, self._progress.results)
        return "nobody knows how many attempts" if forecast is None else forecast.text


def duration_text(seconds: float) -> str:
    """Return a text such as "1 h 05 min", "9 min", "40 s"."""
    if seconds < _MINUTES_FROM_S:
        return f"{max(0, round(seconds))} s"
    hours, minutes = divmod(round(seconds / 60.0), 60)
    return f"{hours} h {minutes:02d} min" if hours else f"{minutes} min"


def _facts_of(car_profile: str | None) -> LockFacts:
    if car_profile is None:
        return USUAL_FACTS
    # This reads the database of a bus: unnecessary, and possibly not installed, if no Car is named.
    from mtr_operator.car_link.profile import load_profile
    return load_profile(car_profile).facts
