"""Optional interfaces of a scenario, each for one kind of client; the defaults are for a scenario without it.

A scenario derives from those that it offers; a client gets the one that it needs by `part(scenario, Judging)`.
Parameters, lines and results are the scenario's own.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Any, Generator, Sequence

from ..actions.car import Car
from ..actions.robot import Robot
from ..forecast import Forecast
from ..ports import LockFacts
from ..results.quantity import Quantity


class StartChecks:
    """Requirements and warnings before the robot moves."""

    def check_means(self, car: Car) -> None:
        """Raise an OperatorError, before the robot moves, if equipment is missing that only this scenario needs."""

    def cautions(self, parameters: Any, facts: LockFacts) -> Sequence[str]:
        """Return sentences, before the start, on limits of these parameters on a Car with these facts; none by
        default."""
        return ()


class Resuming:
    """Continuation of a line that was interrupted."""

    def can_go_on(self, line: Any, parameters: Any, robot: Robot, car: Car) -> bool:
        """Return True if measure can finish a line from the robot's current position, with the data in Robot.kept."""
        return False


class FurtherAttempts:
    """More attempts on lines that the limits do not decide."""

    def measure_further(self, line: Any, parameters: Any, robot: Robot, car: Car,
                        so_far: Any) -> Any:
        """Narrow the interval of a measured line by more attempts; None if more would not narrow it."""
        return None

    def share_of_most(self, parameters: Any, result: Any) -> float | None:
        """Return the attempts of a result relative to the maximum of measure_further; None if lines are not measured
        further, the default."""
        return None

    def looked(self, parameters: Any, results: Sequence[Any], number: int) -> Generator[None, None, Any]:
        """Return the result of a line whose looks have changed, with its intervals at the level of the last one. Each
        step does a part of the work, because the robot must not wait long."""
        yield from ()
        return next(result for result in results if result.number == number)


class Concluding:
    """Conclusions from all lines of a test."""

    def concluded(self, parameters: Any, results: Sequence[Any]) -> Sequence[Any]:
        """Return the results that changed because all lines are measured and share data; none by default. The same
        results give the same answer."""
        return ()

    def summary(self, results: Sequence[Any]) -> Sequence[tuple[str, str]]:
        """Return the common result of all lines, a name and a text each, for report and window; empty by default."""
        return ()


class Judging:
    """Limits that a test may have, and the meaning of its distances for judging and comparing them."""

    def judged_shares(self, parameters: Any) -> tuple[int, ...]:
        """Return shares of attempts, in percent, for whose distances the results have 95 % intervals; a limits file may
        contain them."""
        return ()

    def judged_quantities(self, parameters: Any) -> tuple[Quantity, ...]:
        """Return the quantities other than distances that a limits file may contain."""
        return ()

    def unreached(self, parameters: Any, result: Any, word: str) -> tuple[float | None, float | None]:
        """Return the bounds of a boundary that was not reached; None for an unknown end."""
        return None, parameters.minimum_distance_m

    def measurand(self, parameters: Any, result: Any, word: str) -> str:
        """Return the meaning of a measured distance if it is not the boundary itself, as an identifying text; only
        distances of one measurand are compared. Empty for a boundary, the default."""
        return ""


class Forecasting:
    """Expected duration and precision of a line."""

    def forecast(self, parameters: Any, facts: LockFacts, results: Sequence[Any]) -> Forecast | None:
        """Return expected duration and precision of each line, updated by the lines so far; None without a model."""
        return None

    def expected_line_s(self, parameters: Any) -> float:
        """Return the expected duration of one line, in s of robot time, without the path to its start."""
        near_m, far_m = parameters.distance_range_m
        return float((far_m - near_m) / parameters.maximum_speed_mps)
