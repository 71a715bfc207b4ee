"""Key press by search: press where it tells most, until the interval of the distance is as narrow as wanted."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Sequence

from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...errors import RobotFailed
from ...estimation.press.likelihood import Press
from ...estimation.press.plan import SearchPlan
from ...estimation.press.radial_estimate import Reach, answers_nowhere, estimate
from ...estimation.press.radial_search import PRESSES_IN_DOUBT, RadialSearch
from ...geometry.radials import Radial
from ...geometry.ray import Ray
from ...requests import Direction
from ...results.line_result import LineStatus
from ..key_press_parameters import KeyPressParameters
from ..key_press_result import PRESS, KeyPressResult
from .button import PressMade, press_once
from .campaign import PressCampaign, presses_of, with_estimate
from .record import invalid_result, joined, result_of

# The robot stops within some millimetres; a shorter way would be a manoeuvre and no move.
_MIN_WAY_M = 0.05
# So many radials without any answer, one after the other, and the test waits for a person.
_MAX_SILENT_RADIALS = 3
# Of a radial that is measured further: presses each time, part of the interval so far that is wanted next, its least,
# and how many times the presses allowed it gets in all.
_FURTHER_PRESSES, _FURTHER_PART, _MIN_INTERVAL_M, _FURTHER_TIMES = 8, 0.5, 0.05, 3
_NO_ANSWER = Reach.NO_ANSWER.value
# One Status.
_SOON_S = 0.01


@dataclass
class _Radial:
    """A radial at hand."""

    line: Radial
    search: RadialSearch
    made: list[tuple[PressMade, Press]] = field(default_factory=list)

    def take(self, made: PressMade) -> None:
        press = Press(made.place.distance_m, made.worked)
        self.made.append((made, press))
        self.search.add(press)

    def counted(self) -> list[PressMade]:
        """Presses that the estimate is made of."""
        return [made for made, press in self.made if not self._is_unconfirmed(press)]

    def unconfirmed(self) -> list[PressMade]:
        """Presses that worked, and are not believed."""
        return [made for made, press in self.made if self._is_unconfirmed(press)]

    def _is_unconfirmed(self, press: Press) -> bool:
        return any(other is press for other in self.search.unconfirmed)


def measure_by_search(line: Radial, parameters: KeyPressParameters, robot: Robot) -> KeyPressResult:
    """One radial; RobotFailed when the key has answered nowhere on several of them."""
    return _measured(line, parameters, parameters.search_plan, robot)


def measure_further(line: Radial, parameters: KeyPressParameters, robot: Robot,
                    so_far: KeyPressResult) -> KeyPressResult | None:
    """More presses on a radial for a narrower interval; None when it has had as many as make sense."""
    presses = len(presses_of(so_far))
    if so_far.invalid_count or presses >= _FURTHER_TIMES * parameters.attempts_limit:
        return None
    plan = parameters.search_plan
    if so_far.d50_low_m is not None and so_far.d50_high_m is not None:
        narrower_m = _FURTHER_PART * (so_far.d50_high_m - so_far.d50_low_m) / 2.0
        plan = replace(plan, interval_m=max(_MIN_INTERVAL_M, min(narrower_m, plan.interval_m)))
    return _measured(line, parameters, replace(plan, attempts_limit=presses + _FURTHER_PRESSES), robot, so_far)


def _measured(line: Radial, parameters: KeyPressParameters, plan: SearchPlan, robot: Robot,
              so_far: KeyPressResult | None = None) -> KeyPressResult:
    campaign = PressCampaign(plan)
    radial = _Radial(line, campaign.search(line.number))
    robot.say(f"radial {line.number} ({line.clockwise_deg:g}\N{DEGREE SIGN}): go to the start")
    try:
        robot.go_to(line.ray, parameters.maximum_distance_m)
        _recall_on_the_way(campaign, _earlier(line, robot), robot)
        if so_far is not None:
            radial.search.recall(presses_of(so_far))
        robot.wait(parameters.response_timeout_s, or_when=lambda: not robot.trouble())
        _search(radial, plan, parameters, robot)
    except LineInvalid as error:
        return invalid_result(line, radial.counted(), str(error), error.evidence, radial.unconfirmed())
    if answers_nowhere(plan, radial.search.presses):
        return _silent(radial, parameters, robot)
    result = result_of(line, radial.counted(), radial.unconfirmed())
    return with_estimate(plan, result if so_far is None else joined(so_far, result), estimate(plan, radial.search))


def can_go_on(line: Radial, robot: Robot) -> bool:
    """True when presses of the radial are kept, and the key was not silent."""
    return not robot.trouble() and any(made.worked for made in _kept(robot))


def _earlier(line: Radial, robot: Robot) -> Sequence[KeyPressResult]:
    return [result for result in robot.results if isinstance(result, KeyPressResult) and result.radial != line.number]


def _recall_on_the_way(campaign: PressCampaign, results: Sequence[KeyPressResult], robot: Robot) -> None:
    """One earlier radial with each Status, so that no Status waits long for its answer."""
    earlier = campaign.recall(results)

    def take_one() -> None:
        next(earlier, None)

    robot.wait_until_reached(or_when=take_one)
    for _ in earlier:
        robot.wait(_SOON_S)


def _search(radial: _Radial, plan: SearchPlan, parameters: KeyPressParameters, robot: Robot) -> None:
    search, ray = radial.search, radial.line.ray
    with robot.watched(parameters) as watch:
        for made in _kept(robot):
            radial.take(made)
        search.place_m = robot.key_distance(ray, robot.now_s, 0.0).distance_m
        while not search.is_finished() and not answers_nowhere(plan, search.presses):
            place_m = search.next_place_m()
            robot.say(f"press at {place_m:.2f} m")
            _drive(ray, search.place_m, place_m, robot)
            robot.wait(parameters.settle_time_s)
            if robot.rest_s > parameters.key_rest_limit_s:
                _wake_key(ray, place_m, parameters, robot)
            radial.take(press_once(ray, watch, parameters, robot, _word(len(radial.made) + 1)))


def _drive(ray: Ray, from_m: float, to_m: float, robot: Robot) -> None:
    """Along the radial, facing the Car: forwards to it, backwards from it."""
    if abs(to_m - from_m) >= _MIN_WAY_M:
        robot.go_to(ray, to_m, Direction.FORWARD if to_m < from_m else Direction.BACKWARD)
        robot.wait_until_reached()


def _wake_key(ray: Ray, place_m: float, parameters: KeyPressParameters, robot: Robot) -> None:
    robot.say("move the key so that it does not sleep")
    plan = parameters.search_plan
    beside_m = place_m + (1.0 if place_m < plan.maximum_m else -1.0) * plan.half_wavelength_m
    _drive(ray, place_m, beside_m, robot)
    _drive(ray, beside_m, place_m, robot)
    robot.wait(parameters.settle_time_s)


def _word(number: int) -> str:
    return f"{PRESS} {number}"


def _kept(robot: Robot) -> list[PressMade]:
    """Presses of this radial from before an interruption; none unless all of them are of the present Car frame."""
    made: list[PressMade] = []
    while True:
        point = robot.kept_point(_word(len(made) + 1))
        if point is None:
            return made
        status, place = point
        made.append(PressMade(place, status is LineStatus.OK))


def _silent(radial: _Radial, parameters: KeyPressParameters, robot: Robot) -> KeyPressResult:
    """Whether the key sleeps or the Car's range ends nearer, nobody knows: it is asked for, and no range."""
    before = [result for result in _earlier(radial.line, robot) if result.radial < radial.line.number]
    silent = [result.reach for result in before[1 - _MAX_SILENT_RADIALS:]].count(_NO_ANSWER)
    if silent >= _MAX_SILENT_RADIALS - 1:
        raise RobotFailed(
            f"The key has answered nowhere on {_MAX_SILENT_RADIALS} radials one after the other; see whether it "
            "sleeps, whether its battery is empty and whether it is the Car's key, then continue the test, or begin "
            "one with a smaller minimum_distance_m.")
    reason = (f"No press worked, and none of {PRESSES_IN_DOUBT} at {parameters.minimum_distance_m:.2f} m either: the "
              "key sleeps, its battery is empty, or the Car's range ends nearer; then decrease minimum_distance_m.")
    return replace(invalid_result(
        radial.line, radial.counted(), reason, unconfirmed=radial.unconfirmed()), reach=_NO_ANSWER)
