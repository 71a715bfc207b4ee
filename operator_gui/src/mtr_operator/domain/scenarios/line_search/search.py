"""A line by search: an attempt where it tells most, until the interval of the distance is as narrow as wanted."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any, Generic, Sequence

from ...actions.robot import Robot
from ...actions.trouble import LineInvalid
from ...estimation.press.likelihood import Press
from ...estimation.press.plan import SearchPlan
from ...estimation.press.radial_estimate import Reach, answers_nowhere, estimate
from ...estimation.press.radial_search import RadialSearch
from ...results.line_result import LineStatus
from .attempt import AttemptMade, AttemptsMade
from .campaign import DIGITS, LineCampaign, Searched, plan_of, with_estimate
from .moves import drive, wake_key
from .result import SearchedResult
from .silence import ask_when_lasting
from .trial import SearchParameters, Trial

# Of a line that is measured further: attempts each time, part of the interval so far that is wanted next, its least,
# and how many times the attempts allowed it gets in all.
_FURTHER_ATTEMPTS, _FURTHER_PART, _MIN_INTERVAL_M, _FURTHER_TIMES = 8, 0.5, 0.05, 3
_NO_ANSWER = Reach.NO_ANSWER.value
# One Status.
_SOON_S = 0.01


@dataclass
class _Line(Generic[Searched]):
    """A line at hand; first_m: places that are left to be tried before the search."""

    trial: Trial[Searched]
    plan: SearchPlan
    search: RadialSearch
    first_m: tuple[float, ...]
    made: list[tuple[AttemptMade, Press]] = field(default_factory=list)

    def take(self, made: AttemptMade) -> None:
        press = Press(made.place.distance_m, made.worked)
        self.made.append((made, press))
        self.search.add(press)

    def attempts(self) -> AttemptsMade:
        return AttemptsMade([made for made, _ in self.made],
                            [made for made, press in self.made if any(press is other
                                                                      for other in self.search.unconfirmed)])

    def next_place_m(self) -> float | None:
        """None when the line has come to its end."""
        if len(self.made) < len(self.first_m):
            return self.first_m[len(self.made)]
        if self.search.is_finished() or answers_nowhere(self.plan, self.search.presses):
            return None
        return self.search.next_place_m()


def measure_by_search(trial: Trial[Searched], robot: Robot) -> Searched:
    """One line; RobotFailed when the key has answered nowhere on several of them."""
    return _measured(trial, trial.parameters.search_plan, robot)


def measure_further(trial: Trial[Searched], robot: Robot, so_far: Searched) -> Searched | None:
    """More attempts on a line for a narrower interval; None when it has had as many as make sense."""
    count, most = len(so_far.attempts_made), _FURTHER_TIMES * trial.parameters.attempts_limit
    if so_far.invalid_count or count >= most:
        return None
    plan = further_plan(trial.parameters.search_plan, so_far)
    return _measured(trial, replace(plan, attempts_limit=min(count + _FURTHER_ATTEMPTS, most)), robot, so_far)


def further_plan(plan: SearchPlan, so_far: SearchedResult) -> SearchPlan:
    """What is wanted of a line that is measured further: half of its interval, and no more than before."""
    plan = plan_of(plan, so_far)
    if so_far.d50_low_m is None or so_far.d50_high_m is None:
        return plan
    narrower_m = round(_FURTHER_PART * (so_far.d50_high_m - so_far.d50_low_m) / 2.0, DIGITS)
    return replace(plan, interval_m=max(min(_MIN_INTERVAL_M, plan.interval_m), min(narrower_m, plan.interval_m)))


def share_of_most(parameters: SearchParameters, result: SearchedResult) -> float | None:
    """See FurtherAttempts.share_of_most."""
    if result.invalid_count or not result.was_searched:
        return None
    return len(result.attempts_made) / (_FURTHER_TIMES * parameters.attempts_limit)


def can_go_on(trial: Trial[Searched], robot: Robot) -> bool:
    """True when attempts of the line are kept, and the key was not silent."""
    return not robot.trouble() and any(made.worked for made in _kept(trial, robot))


def _measured(trial: Trial[Searched], plan: SearchPlan, robot: Robot, so_far: Searched | None = None) -> Searched:
    campaign = LineCampaign(trial.parameters.search_plan)
    line = _Line(trial, plan, campaign.search(trial.number, plan), trial.first_places_m if so_far is None else ())
    robot.say(trial.start)
    try:
        trial.begin(robot)
        robot.go_to(trial.ray, trial.parameters.maximum_distance_m)
        _recall_on_the_way(campaign, _earlier(trial, robot), robot)
        if so_far is not None:
            line.search.recall(so_far.attempts_made)
        robot.wait(trial.parameters.response_timeout_s, or_when=lambda: not robot.trouble())
        _search(line, robot)
    except LineInvalid as error:
        return trial.invalid(line.attempts(), str(error), error.evidence)
    if answers_nowhere(plan, line.search.presses):
        return _silent(line, robot)
    result = trial.result(line.attempts())
    if so_far is not None:
        # The derived classes are dataclasses.
        result = replace(trial.joined(so_far, result), **_of_further(so_far, plan))  # type: ignore[type-var]
    return with_estimate(plan, result, estimate(plan, line.search))


def _of_further(so_far: SearchedResult, plan: SearchPlan) -> dict[str, Any]:
    """Columns that a line keeps, or gets, when it is measured further."""
    return {"wanted_interval_m": plan.interval_m, "look_shares": so_far.look_shares, "look_spent": so_far.look_spent}


def _earlier(trial: Trial[Searched], robot: Robot) -> Sequence[Searched]:
    """Results of the scenario's other lines; all results of a test are of one scenario."""
    results: Sequence[Searched] = robot.results  # type: ignore[assignment]
    return [result for result in results if result.number != trial.number]


def _recall_on_the_way(campaign: LineCampaign, results: Sequence[Searched], robot: Robot) -> None:
    """One earlier line with each Status, so that no Status waits long for its answer."""
    earlier = campaign.recall(results)

    def take_one() -> None:
        next(earlier, None)

    robot.wait_until_reached(or_when=take_one)
    for _ in earlier:
        robot.wait(_SOON_S)


def _search(line: _Line[Searched], robot: Robot) -> None:
    trial, search, parameters = line.trial, line.search, line.trial.parameters
    with robot.watched(trial.tolerances) as watch:
        for made in _kept(trial, robot):
            line.take(made)
        search.place_m = robot.key_distance(trial.ray, robot.now_s, 0.0).distance_m
        place_m = line.next_place_m()
        while place_m is not None:
            robot.say(trial.action_at(place_m))
            drive(trial.ray, search.place_m, place_m, robot)
            robot.wait(parameters.settle_time_s)
            if robot.rest_s > parameters.key_rest_limit_s:
                wake_key(trial.ray, place_m, parameters, robot)
            line.take(trial.attempt(watch, robot, _word(trial, len(line.made) + 1)))
            place_m = line.next_place_m()


def _word(trial: Trial[Searched], number: int) -> str:
    return f"{trial.word} {number}"


def _kept(trial: Trial[Searched], robot: Robot) -> list[AttemptMade]:
    """Attempts of this line from before an interruption; none unless all of them are of the present Car frame."""
    made: list[AttemptMade] = []
    while True:
        point = robot.kept_point(_word(trial, len(made) + 1))
        if point is None:
            return made
        status, place = point
        made.append(AttemptMade(place, status is LineStatus.OK))


def _silent(line: _Line[Searched], robot: Robot) -> Searched:
    """Whether the key sleeps or the Car's range ends nearer, nobody knows: it is asked for, and no range."""
    trial = line.trial
    ask_when_lasting(trial.number, _earlier(trial, robot), lambda result: result.reach == _NO_ANSWER,
                     trial.lasting_silence)
    result: Searched = replace(trial.invalid(line.attempts(), trial.silence), reach=_NO_ANSWER)  # type: ignore[type-var]
    return result
