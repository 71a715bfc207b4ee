"""The least strength of a press to which the Car answers, found by pressing."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import PressReport, RobotStatus
from mtr_operator.station.calibration.press_search import ANSWER_LIMIT_S, IN_A_ROW, PressEnd, PressSearch

LOCKED, UNLOCKED, UNKNOWN = LockState.LOCKED, LockState.UNLOCKED, LockState.UNKNOWN


class Bench:
    """A robot that presses, and a Car that answers from a strength on."""

    def __init__(self, answers_from=math.inf):
        self.answers_from = answers_from
        self.locks, self.now_s, self.reports, self.requests = LOCKED, 10.0, (), []
        self.reports_presses, self.error = True, ""
        self.search = PressSearch(0.3)

    def run(self, limit_s=200.0):
        """Ten Statuses a second until the search ends; how it did."""
        while self.search.end is None and self.now_s < limit_s:
            self.now_s += 0.1
            request = self.search.learn(RobotStatus(1, 1, self.now_s, presses=self.reports), self.locks)
            if request is not None:
                self.requests.append(request)
                self._press(request)
        return self.search.end

    def _press(self, request):
        if self.reports_presses:
            report = PressReport(len(self.requests), self.now_s + 0.1, self.now_s + 0.4, self.error)
            self.reports = (*self.reports, report)
        if request.strength >= self.answers_from - 1e-9 and request.buttons == ((2,) if self.locks is LOCKED else (1,)):
            self.locks = UNLOCKED if self.locks is LOCKED else LOCKED


def test_least_strength_with_four_answers_in_a_row_is_found():
    bench = Bench(0.55)
    assert bench.run() is PressEnd.FOUND
    assert bench.search.strength == 0.6
    strengths = [request.strength for request in bench.requests]
    assert strengths == [0.2, 0.3, 0.4, 0.5] + IN_A_ROW * [0.6]
    assert [request.buttons for request in bench.requests][-IN_A_ROW:] == [(2,), (1,), (2,), (1,)]
    assert {request.key_height_m for request in bench.requests} == {None}


def test_strength_that_works_by_chance_only_is_left_behind():
    bench = Bench(0.2)
    bench._press = lambda request, press=bench._press: (
        setattr(bench, "answers_from", 0.4 if len(bench.requests) == 3 else 0.2), press(request))
    assert bench.run() is PressEnd.FOUND
    assert [request.strength for request in bench.requests] == [0.2, 0.2, 0.2] + IN_A_ROW * [0.3]


def test_silent_car_ends_the_search_at_full_strength():
    bench = Bench()
    assert bench.run() is PressEnd.NO_ANSWER
    assert bench.requests[-1].strength == 1.0
    assert len(bench.requests) == 9
    assert bench.now_s > 9 * ANSWER_LIMIT_S


def test_change_of_the_locks_without_a_press_is_no_answer():
    bench = Bench()
    bench.reports_presses = False
    bench._press = lambda request: setattr(bench, "locks", UNLOCKED)
    assert bench.run() is PressEnd.NOT_PRESSED


def test_press_that_the_robot_refuses_ends_the_search():
    bench = Bench()
    bench.error = "The servo does not answer."
    assert bench.run() is PressEnd.REFUSED
    assert bench.search.error == "The servo does not answer."


def test_locks_that_nobody_knows_end_the_search_without_a_press():
    bench = Bench()
    bench.locks = UNKNOWN
    assert bench.run() is PressEnd.LOCKS_UNKNOWN
    assert bench.requests == []


@pytest.mark.parametrize("answers_from", [0.2, math.inf])
def test_stop_ends_the_search_and_keeps_what_was_found(answers_from):
    bench = Bench(answers_from)
    bench.run(limit_s=10.2)
    bench.search.stop()
    assert bench.search.end is PressEnd.STOPPED
    assert bench.search.learn(RobotStatus(1, 1, 99.0), LOCKED) is None
    done = Bench(0.2)
    done.run()
    done.search.stop()
    assert done.search.end is PressEnd.FOUND
