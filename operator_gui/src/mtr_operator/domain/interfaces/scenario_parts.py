"""Further interfaces of a scenario, each for one kind of client; the defaults are those of a scenario without it.

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
        """Raise an OperatorError, before the robot moves, when something is missing that only this scenario needs."""

    def cautions(self, parameters: Any, facts: LockFacts) -> Sequence[str]:
        """Sentences, before the start, on what these parameters cannot give on a Car with these facts; none by
        default."""
        return ()


class Resuming:
    """Continuation of a line that was interrupted."""

    def can_go_on(self, line: Any, parameters: Any, robot: Robot, car: Car) -> bool:
        """True when measure can finish a line from where the robot stands, with what Robot.kept has of it."""
        return False


class FurtherAttempts:
    """More attempts on lines that the limits do not decide."""

    def measure_further(self, line: Any, parameters: Any, robot: Robot, car: Car,
                        so_far: Any) -> Any:
        """Make the interval of a measured line narrower by more attempts; None when more would not make it so."""
        return None

    def share_of_most(self, parameters: Any, result: Any) -> float | None:
        """Of the most attempts that measure_further allows a line, those that its result rests on; None where it is
        not measured further, the default."""
        return None

    def looked(self, parameters: Any, results: Sequence[Any], number: int) -> Generator[None, None, Any]:
        """The result of a line whose looks have changed, with its intervals at the level of the last one. A part of
        the work with each step, for the robot waits for no long one."""
        yield from ()
        return next(result for result in results if result.number == number)


class Concluding:
    """Conclusions from all lines of a test."""

    def concluded(self, parameters: Any, results: Sequence[Any]) -> Sequence[Any]:
        """Those results that read otherwise now that all lines are measured, for what lines have in common; none by
        default. The same results give the same answer."""
        return ()

    def summary(self, results: Sequence[Any]) -> Sequence[tuple[str, str]]:
        """What all lines together say, a name and a text each, for report and window; nothing by default."""
        return ()


class Judging:
    """Limits that a test may have, and the meaning of its distances for judging and comparing them."""

    def judged_shares(self, parameters: Any) -> tuple[int, ...]:
        """Shares of attempts, in percent, for whose distances the results have 95 % intervals; a limits file may ask
        for them."""
        return ()

    def judged_quantities(self, parameters: Any) -> tuple[Quantity, ...]:
        """What else a limits file may ask for, beside distances."""
        return ()

    def unreached(self, parameters: Any, result: Any, word: str) -> tuple[float | None, float | None]:
        """Between which distances a boundary of a line lies that was not reached; None for an end that nobody knows."""
        return None, parameters.minimum_distance_m

    def measurand(self, parameters: Any, result: Any, word: str) -> str:
        """What a measured distance of a line is where it is not the boundary itself, the same text for the same; only
        distances of one measurand are compared. Empty for a boundary, the default."""
        return ""


class Forecasting:
    """Expected duration and precision of a line."""

    def forecast(self, parameters: Any, facts: LockFacts, results: Sequence[Any]) -> Forecast | None:
        """What each line is likely to take and to tell, with what the lines so far say; None without a model of it."""
        return None

    def expected_line_s(self, parameters: Any) -> float:
        """How long measuring one line is likely to take, in s of robot time, without the way to its start."""
        near_m, far_m = parameters.distance_range_m
        return float((far_m - near_m) / parameters.maximum_speed_mps)
