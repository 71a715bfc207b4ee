"""The Car's locks over time with the key's distance beside them."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.event_observer import EventObserver
from mtr_operator.domain.eventlog.event_log import EventLog
from mtr_operator.domain.ports import CarEvent, LockState
from mtr_operator.domain.robot_status import CarDimensions, RobotStatus
from mtr_operator.station.bus.time_line import SPAN_S, TimeLine
from mtr_operator.station.links.idle_loop import IdleLoop
from mtr_operator.station.links.reporter import Reporter
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink
from mtr_operator.station.mailbox import Mailbox

CAR = CarDimensions(4.0, 2.0, 0.01, 0.01)
LOCKED, UNLOCKED = LockState.LOCKED, LockState.UNLOCKED


def status(stamp_s, x=3.0, session=1, **changes):
    """A robot that faces the Car's front, its key 0.25 m ahead."""
    told = {"x": x, "y": 0.0, "heading": math.pi, "key_x": 0.25, "pose_valid": True, "car": CAR, **changes}
    return RobotStatus(1, session, stamp_s, **told)


def test_key_has_its_distance_from_the_outline():
    line = TimeLine()
    line.learn(status(1.0), [], LOCKED)
    [moment] = line.recent()[0]
    assert (moment.lock_state, moment.gap_m) == (LOCKED, pytest.approx(0.75))


@pytest.mark.parametrize("changes", [{"pose_valid": False}, {"car": None}])
def test_key_that_nobody_sees_has_no_distance(changes):
    line = TimeLine()
    line.learn(status(1.0, **changes), [], LOCKED)
    assert line.recent()[0][0].gap_m is None


def test_event_has_the_distance_of_its_own_instant():
    line = TimeLine()
    line.learn(status(1.0, x=5.25), [], LOCKED)
    line.learn(status(1.1, x=5.15), [CarEvent(1.03, 0.005, UNLOCKED, "passive_entry")], UNLOCKED)
    [event] = line.recent()[1]
    assert event.gap_m == pytest.approx(2.97)
    assert (event.time_s, event.source) == (1.03, "passive_entry")


@pytest.mark.parametrize("event", [CarEvent(0.5, 0.005, UNLOCKED), CarEvent(1.05, math.inf, UNLOCKED),
                                   CarEvent(1.3, 0.005, UNLOCKED)])
def test_event_whose_instant_nobody_saw_has_none(event):
    line = TimeLine()
    line.learn(status(1.0), [], LOCKED)
    line.learn(status(1.1), [event], UNLOCKED)
    assert line.recent()[1] == () or line.recent()[1][0].gap_m is None


def test_a_minute_is_kept_and_no_more():
    line = TimeLine()
    for index in range(2000):
        line.learn(status(0.1 * index), [CarEvent(0.1 * index, 0.005, UNLOCKED)], UNLOCKED)
    moments, events = line.recent()
    assert moments[-1].stamp_s - moments[0].stamp_s == pytest.approx(SPAN_S, abs=0.11)
    assert len(moments) < 602
    assert len(events) <= 64


@pytest.mark.parametrize("after", [status(0.5), status(2.0, session=2)])
def test_another_clock_begins_anew(after):
    line = TimeLine()
    line.learn(status(1.0), [CarEvent(1.0, 0.005, UNLOCKED)], UNLOCKED)
    line.learn(after, [], LOCKED)
    assert [moment.stamp_s for moment in line.recent()[0]] == [after.stamp_s]
    assert line.recent()[1] == ()


def test_session_without_a_test_fills_the_time_line(robot_link, car_link):
    line = TimeLine()
    idle = IdleLoop(WatchedRobotLink(robot_link, StopOrder()), car_link, time_line=line)
    for _ in range(3):
        idle.step()
    assert [moment.lock_state for moment in line.recent()[0]] == 3 * [car_link.lock_state]


def test_running_test_fills_the_time_line_with_each_status(robot_link, car_link):
    line, statuses = TimeLine(), []
    reporter = Reporter(Mailbox(), WatchedRobotLink(robot_link, StopOrder()), car_link, None, lambda: None,
                        time_line=line)
    observer = EventObserver(reporter, EventLog(), "axis")
    loop = ControlLoop(robot_link, car_link, observer)
    for _ in range(3):
        statuses.append(loop.step())
    assert [moment.stamp_s for moment in line.recent()[0]] == [status.stamp_s for status in statuses]
    assert {moment.lock_state for moment in line.recent()[0]} == {car_link.lock_state}
