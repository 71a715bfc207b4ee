"""The window's robot and Car without hardware: a test that was stopped gives the distances of one that was not."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import dataclasses
from argparse import Namespace

import pytest
from post import LIMIT_S, Post

from mtr_operator.car_link.simulated_car import SimulatedCarLink
from mtr_operator.cli.links import robot_link
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions, PressReport, RobotStatus
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.robot_link.fake import FakeRobotLink
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice
from mtr_operator.station.events import LinksOpened, Outcome, RunEnded
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.test import new_test, open_test

CONNECTION = Connection(RobotChoice(SIMULATED), CanChoice(SIMULATED))
RADIALS = {"angle_between_radials_deg": 90.0}
SMALL = {"autolock": {"measurements_distance_m": 2.0}, "key_press": {**RADIALS, "method": "scan"},
         "handle_request": {"measurements_distance_m": 1.2}, "digital_key": {**RADIALS, "spacing_m": 2.0},
         "relay_resistance": {}}
# The scan of Key press goes in steps of 0.5 m; elsewhere poll and Status may each come some centimetres later.
TOLERANCES_M = {"key_press": 0.55}


class StoppingOpener(LinkOpener):
    """Calls `stop` at the Status that is so many after the test has so many lines, for each of `stops` once."""

    def __init__(self, stops=()):
        super().__init__(time_factor=0.0)
        self.stops, self.stop, self.test, self._left = list(stops), lambda: None, None, None

    def robot(self, choice):
        link = super().robot(choice)
        next_status = link.next_status

        def watched(timeout_s):
            self._count()
            return next_status(timeout_s)
        link.next_status = watched
        return link

    def _count(self):
        # Between the runs nobody holds the test's files.
        is_running = self.test is not None and self.test._store is not None
        if not (self.stops and is_running) or len(self.test.progress.results) < self.stops[0][0]:
            return
        self._left = self.stops[0][1] if self._left is None else self._left - 1
        if self._left <= 0:
            self.stops.pop(0)
            self._left = None
            self.stop()


def measured(tmp_path, name, stops=(), is_restarted=False):
    """Results of a test that is stopped and resumed so often. is_restarted: by another start of the application."""
    scenario = SCENARIOS[name]
    kind = scenario.parameters_type
    parameters = kind.from_mapping({**kind.proposed(), **SMALL[name]})
    test = new_test(scenario, parameters, tmp_path / f"{name} {len(stops)}", CONNECTION)
    post, opener, worker, outcomes = Post(), StoppingOpener(stops), None, []
    while not outcomes or outcomes[-1] is Outcome.STOPPED:
        if worker is None:
            worker = Worker(CONNECTION, opener, post.box)
            worker.start()
            post.wait_for(LinksOpened)
        opener.stop, opener.test = worker.stop, test
        worker.run_test(test)
        outcomes.append(post.wait_for(RunEnded).outcome)
        if outcomes[-1] is Outcome.STOPPED:
            test = open_test(test.path)
            if is_restarted:
                assert worker.close(LIMIT_S)
                opener, worker = StoppingOpener(opener.stops), None
    assert worker.close(LIMIT_S)
    assert outcomes == [Outcome.STOPPED] * len(stops) + [Outcome.COMPLETE]
    return test.progress.results


def distances_of(results):
    return [(result.number, each.word, each.status, each.distance_m) for result in results for each in result.distances]


@pytest.mark.parametrize("is_restarted", [False, True])
@pytest.mark.parametrize("name", SMALL)
def test_stop_and_resume_give_the_distances_of_a_test_without_a_stop(tmp_path, name, is_restarted):
    wanted = distances_of(measured(tmp_path / "whole", name))
    # At the end of a line, in the middle of the next pass or press, twice in one line, and early in the last one.
    found = distances_of(measured(tmp_path / "stopped", name, [(1, 0), (1, 37), (2, 5), (2, 61), (2, 120)],
                                  is_restarted))
    assert [each[:3] for each in found] == [each[:3] for each in wanted]
    assert any(status is LineStatus.OK for _, _, status, _ in wanted) or name == "relay_resistance"
    known = [(before_m, after_m) for (*_, before_m), (*_, after_m) in zip(wanted, found)
             if before_m is not None and after_m is not None]
    assert len(known) >= len(wanted) / 2 or name == "relay_resistance"
    for before_m, after_m in known:
        assert after_m == pytest.approx(before_m, abs=TOLERANCES_M.get(name, 0.25))


def test_simulated_robot_continues_from_link_to_link_with_a_session_of_its_own_each():
    opener = LinkOpener(time_factor=0.0)
    seen = []
    for _ in range(3):
        link = opener.robot(CONNECTION.robot)
        link.connect()
        for _ in range(20):
            link.next_status(1.0)
            link.send(DesiredState())
        seen.append(link.next_status(1.0))
        link.close()
    assert len({status.robot_session_id for status in seen}) == 1
    assert len({status.session_id for status in seen}) == 3
    assert [status.stamp_s for status in seen] == sorted(status.stamp_s for status in seen)


def starts():
    """Makers of a virtual robot that begins with a clock of its own."""
    options = Namespace(simulated_robot=True, seed=1, continued="progress.json")
    return {"window": lambda: LinkOpener(0.0).robot(CONNECTION.robot)._robot,
            "command line that continues": lambda: robot_link(options)._robot,
            "server": lambda: RobotSubstitute(None, seed=1)._robot}


@pytest.mark.parametrize("start", starts().values(), ids=starts())
def test_each_start_of_a_virtual_robot_has_an_id_of_its_own(start):
    assert len({start().status().robot_session_id for _ in range(20)}) == 20


def test_each_start_is_the_same_robot_but_for_its_id():
    options = Namespace(simulated_robot=True, seed=3, continued=None)
    begun, again = (robot_link(options)._robot.status() for _ in range(2))
    options.continued = "progress.json"
    later = robot_link(options)._robot.status()
    assert begun == again == FakeRobotLink(3)._robot.status()
    same = dataclasses.replace(later, robot_session_id=begun.robot_session_id, area=begun.area)
    assert same == begun != later
    # The origin of the test area belongs to the session.
    assert dataclasses.replace(later.area, origin_id=begun.area.origin_id) == begun.area


CAR = CarDimensions(4.5, 1.8, 0.01, 0.01)


def status(number, x, **changes):
    return RobotStatus(number, 1, 0.1 * number, x=x, y=0.0, heading=0.0, pose_valid=True, car=CAR, **changes)


def events(car, first=1, **changes):
    places = [4.0 - 0.03 * step for step in range(110)]
    return [event.lock_state for number, gap in enumerate(places + places[::-1], first)
            for event in car.observe(status(number, 2.25 + gap, **changes))]


@pytest.fixture
def car():
    link = SimulatedCarLink(1)
    link.connect()
    return link


def test_car_reacts_also_when_the_clock_goes_back_under_the_same_id(car):
    expected = [LockState.UNLOCKED, LockState.LOCKED]
    assert events(car, first=9000) == events(car) == events(car) == expected


def test_passive_entry_is_back_with_the_next_run_of_the_robot_after_a_press(car):
    car.observe(status(5000, 4.0, session_id=1))
    car.observe(status(5001, 4.0, session_id=1, presses=(PressReport(1, 500.0, 500.1),)))
    car.observe(status(5002, 4.0, session_id=1, presses=(PressReport(2, 500.15, 500.2),)))
    assert events(car, first=5003, session_id=1) == []
    assert events(car, session_id=1) == [LockState.UNLOCKED, LockState.LOCKED]


def test_request_of_a_test_that_was_stopped_is_none_of_the_next_one(car):
    car.observe(status(1, 2.75, session_id=1, presses=(PressReport(1, 0.05, 0.1),)))
    before = car.lock_state
    car.handle.request(0.5)
    assert car.observe(status(2, 2.75, session_id=2)) == [] and car.lock_state is before
