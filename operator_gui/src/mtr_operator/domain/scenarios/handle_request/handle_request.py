"""The Handle request scenario: from how far the Car unlocks when somebody takes its handle."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from typing import Generator, Sequence

from ...actions.car import Car
from ...actions.robot import Robot
from ...forecast import Forecast
from ...interfaces.scenario_parts import Concluding, Forecasting, FurtherAttempts, Judging, Resuming, StartChecks
from ...ports import LockFacts
from ...results.picture import Picture
from ...robot_status import CarDimensions
from ...scenario import Scenario
from ...supervision.announcements import HANDLES
from ..line_search import campaign, forecast, search
from ..line_search.forecast import SearchLimits, UsualWidths
from ..line_search.result import SHARES
from .axis_trial import AxisTrial, HandleAxis, axes_of
from .border_picture import picture_of
from .parameters import HandleRequestParameters
from .result import HANDLE_WORD, HandleRequestResult

# The Car's low-frequency field falls by the cube of the distance, 17 dB/m at 1.5 m: noise of 1, 2 and 5 dB.
_WIDTHS = UsualWidths(0.15, 0.3, 0.75)
_DECLARED = HandleRequestParameters.declarations()
_LIMITS = SearchLimits("requests on each axis", int(_DECLARED["attempts_limit"].high), _DECLARED["interval_m"].high)


class HandleRequest(Scenario[HandleRequestParameters, HandleAxis, HandleRequestResult],
                    StartChecks, Resuming, FurtherAttempts, Concluding, Judging, Forecasting):
    """Have the handle taken with the key at places on every axis, and find where the Car takes the key for outside."""

    name = "handle_request"
    title = "Handle request"
    line_word = "axis"
    parameters_type = HandleRequestParameters
    result_type = HandleRequestResult
    distance_words = (HANDLE_WORD,)
    announcement = HANDLES

    def lines(self, parameters: HandleRequestParameters, car: CarDimensions) -> list[HandleAxis]:
        """See axes_of."""
        return axes_of(parameters, car)

    def measure(self, line: HandleAxis, parameters: HandleRequestParameters, robot: Robot,
                car: Car) -> HandleRequestResult:
        """First at the nominal border, then where a request tells most, until the border's interval is reached."""
        return search.measure_by_search(AxisTrial(line, parameters, car), robot)

    def can_go_on(self, line: HandleAxis, parameters: HandleRequestParameters, robot: Robot, car: Car) -> bool:
        """An axis goes on with the requests that are kept."""
        return search.can_go_on(AxisTrial(line, parameters, car), robot)

    def measure_further(self, line: HandleAxis, parameters: HandleRequestParameters, robot: Robot, car: Car,
                        so_far: HandleRequestResult) -> HandleRequestResult | None:
        """The search goes on after its end."""
        return search.measure_further(AxisTrial(line, parameters, car), robot, so_far)

    def concluded(self, parameters: HandleRequestParameters,
                  results: Sequence[HandleRequestResult]) -> Sequence[HandleRequestResult]:
        """How softly the zone ends each axis learns from all others."""
        return campaign.concluded(parameters.search_plan, results)

    def share_of_most(self, parameters: HandleRequestParameters, result: HandleRequestResult) -> float | None:
        return search.share_of_most(parameters, result)

    def looked(self, parameters: HandleRequestParameters, results: Sequence[HandleRequestResult],
               number: int) -> Generator[None, None, HandleRequestResult]:
        return campaign.looked(parameters.search_plan, results, number)

    def cautions(self, parameters: HandleRequestParameters, facts: LockFacts) -> Sequence[str]:
        return tuple(forecast.cautions(parameters.search_plan, _WIDTHS, _LIMITS))

    def forecast(self, parameters: HandleRequestParameters, facts: LockFacts,
                 results: Sequence[HandleRequestResult]) -> Forecast | None:
        return forecast.search_forecast(parameters.search_plan, _WIDTHS, results)

    def judged_shares(self, parameters: HandleRequestParameters) -> tuple[int, ...]:
        return SHARES

    def unreached(self, parameters: HandleRequestParameters, result: HandleRequestResult,
                  word: str) -> tuple[float | None, float | None]:
        """The results say themselves to which side they are not bounded."""
        return None, None

    def picture(self, parameters: HandleRequestParameters, car: CarDimensions,
                results: Sequence[HandleRequestResult]) -> Picture:
        """See picture_of."""
        return picture_of(parameters, car, results)

    def expected_line_s(self, parameters: HandleRequestParameters) -> float:
        return sum(forecast.search_forecast(parameters.search_plan, _WIDTHS, ()).line_s) / 2.0


SCENARIO = HandleRequest()
