"""Two windows on one robot: a paused test keeps it, an idle window watches and leaves it to the next order."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import itertools
import time

import pytest
from post import LIMIT_S, Post

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_operator.robot_link.server import ConnectionServer
from mtr_operator.robot_link.substitute import RobotSubstitute
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice
from mtr_operator.station.events import LineMeasured, LinksOpened, Outcome, RunEnded
from mtr_operator.station.links.idle_loop import CarRequest
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.test import new_test, open_test

TIME_FACTOR = 50.0
# Statuses after the event that is judged: the links are opened again within some of them.
MANY = 60


class Opener(LinkOpener):
    """Links of this test's robot, and a substitute of the Car."""

    def robot(self, choice):
        link = ZmqRobotLink(choice.host, choice.subscriber_port, choice.publisher_port)
        self.sessions = [*getattr(self, "sessions", []), link.session_id]
        return link


class Window:
    """A worker with its mailbox."""

    def __init__(self, server):
        self.post, self.opener = Post(), Opener()
        self.connection = Connection(RobotChoice("127.0.0.1", server.subscriber_port, server.publisher_port),
                                     CanChoice(SIMULATED))
        self.worker = Worker(self.connection, self.opener, self.post.box)
        self._snapshots = []
        put = self.post.box.put_robot
        self.post.box.put_robot = lambda snapshot: (self._snapshots.append(snapshot), put(snapshot))
        self.worker.start()
        self.post.wait_for(LinksOpened)

    def statuses(self):
        """Each Status from now on as soon as it is shown."""
        for number in itertools.count(len(self._snapshots)):
            while len(self._snapshots) <= number:
                # As a view does; a window that takes nothing counts as hung.
                self.post.take()
            yield self._snapshots[number].status

    def status_where(self, condition):
        """The first Status from now on that fulfils the condition."""
        deadline = time.monotonic() + LIMIT_S
        for status in self.statuses():
            if condition(status):
                return status
            assert time.monotonic() < deadline, f"the last one was {status}"
        raise AssertionError

    def is_in_control(self):
        """A Status says so."""
        return self.status_where(lambda status: status.session_id == self.opener.sessions[-1])


@pytest.fixture
def server():
    with ConnectionServer() as opened:
        robot = RobotSubstitute(opened, time_factor=TIME_FACTOR)
        robot.start()
        yield opened
        robot.stop()


@pytest.fixture
def windows(server):
    made = [Window(server), Window(server)]
    yield made
    for window in made:
        assert window.worker.close(LIMIT_S)


@pytest.fixture
def paused(windows, tmp_path):
    """The first window's test, stopped after its first line."""
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type.from_mapping({"angle_between_radials_deg": 90.0})
    first = windows[0]
    test = new_test(scenario, parameters, tmp_path / "progress", first.connection)
    first.worker.run_test(test)
    first.post.wait_for(LineMeasured)
    first.worker.stop()
    assert first.post.wait_for(RunEnded).outcome is Outcome.STOPPED
    kept = first.is_in_control()
    # On a busy machine the other window still shows the Statuses between the run's session and this one.
    windows[1].status_where(lambda status: status.id >= kept.id)
    return test


def test_paused_test_keeps_the_robot_and_goes_on_beside_an_idle_window(windows, paused):
    first, second = windows
    own = first.opener.sessions[-1]
    for status in itertools.islice(first.statuses(), MANY):
        assert status.session_id == own and not status.controlled_by_other
    assert next(second.statuses()).controlled_by_other
    first.worker.run_test(open_test(paused.path))
    assert first.post.wait_for(RunEnded).outcome is Outcome.COMPLETE
    # A finished one leaves it to whoever orders something.
    assert second.status_where(lambda status: not status.controlled_by_other).session_id == 0


def test_idle_windows_claim_nothing_and_the_one_that_orders_something_has_the_robot(windows):
    first, second = windows
    for window in windows:
        assert {status.session_id for status in itertools.islice(window.statuses(), MANY)} == {0}
    second.worker.request_car(CarRequest.MAP)
    second.is_in_control()
    assert first.status_where(lambda status: status.controlled_by_other)


def test_window_whose_test_was_laid_aside_leaves_the_robot(windows, paused):
    first, second = windows
    first.worker.lay_aside()
    assert second.status_where(lambda status: not status.controlled_by_other).session_id == 0
    second.worker.request_car(CarRequest.CHECK)
    second.is_in_control()


def test_window_that_is_closed_with_a_paused_test_leaves_the_robot(windows, paused):
    first, second = windows
    assert first.worker.close(LIMIT_S)
    assert second.status_where(lambda status: not status.controlled_by_other).session_id == 0


def test_robot_of_a_window_that_was_killed_is_the_next_ones(windows, paused, monkeypatch):
    first, second = windows
    # Nothing is said any more, not even goodbye.
    monkeypatch.setattr(ZmqRobotLink, "_publish", silent_for(first, ZmqRobotLink._publish))
    assert second.status_where(lambda status: not status.controlled_by_other).session_id != 0
    second.worker.request_car(CarRequest.MAP)
    second.is_in_control()


def silent_for(window, publish):
    """Lets links of other windows publish."""
    def publish_of_others(link, *arguments, **words):
        if link.session_id not in window.opener.sessions:
            publish(link, *arguments, **words)
    return publish_of_others
