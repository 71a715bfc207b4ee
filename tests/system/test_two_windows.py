"""Two windows on one robot in lock-step: a paused test keeps the robot while the other window is idle."""
# SPDX-License-Identifier: Apache-2.0
import itertools

import pytest

from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.station.connection import SIMULATED, CanChoice, Connection, LinkOpener, RobotChoice
from mtr_operator.station.links.idle_loop import CarRequest
from mtr_operator.station.links.worker import Worker
from mtr_operator.station.mailbox import Mailbox
from mtr_operator.station.test import new_test
from mtr_proto import robot_link_pb2
from mtr_simulation.stack import Stack, StackOptions

LIMIT_S = 30.0
# Some more than it takes to open a link again.
MANY = 40


class Window(LinkOpener):
    """A worker without a view. sessions: those that it has opened so far."""

    def __init__(self, stack):
        super().__init__()
        self.sessions, self.box = [], Mailbox()
        self.connection = Connection(
            RobotChoice("127.0.0.1", stack.status_port, stack.command_port, is_unencrypted=True), CanChoice(SIMULATED))
        self.worker = Worker(self.connection, self, self.box)
        self.worker.start()

    def robot(self, choice):
        """See LinkOpener."""
        link = super().robot(choice)
        self.sessions.append(link.session_id)
        return link


@pytest.fixture(scope="module")
def stack(out):
    """In lock-step, with the board of the simulation: nothing is pressed."""
    with Stack(StackOptions(out)) as running:
        yield running


@pytest.fixture
def windows(stack):
    opened = [Window(stack), Window(stack)]
    yield opened
    for window in opened:
        assert window.worker.close(LIMIT_S)


def test_paused_test_keeps_the_robot_beside_an_idle_window(windows, observer, out):
    first, second = windows
    scenario = SCENARIOS["key_press"]
    parameters = scenario.parameters_type.from_mapping({"angle_between_radials_deg": 90.0})

    def wait_for(condition):
        """As a view, which empties its mailbox, does."""
        def is_met(status):
            for window in windows:
                window.box.take()
            return condition(status)
        return observer.wait_for(is_met)

    first.worker.run_test(new_test(scenario, parameters, out / "progress", first.connection))
    wait_for(lambda status: status.mode == robot_link_pb2.MODE_MAPPING_CAR)
    first.worker.stop()
    count = itertools.count()
    seen = set()
    wait_for(lambda status: seen.add(status.session_id) or next(count) >= MANY)
    assert seen & set(first.sessions) and not seen & set(second.sessions)
    wait_for(lambda status: status.session_id == first.sessions[-1])
    assert first.worker.close(LIMIT_S)
    wait_for(lambda status: status.session_id == 0)
    second.worker.request_car(CarRequest.MAP)
    wait_for(lambda status: status.session_id == second.sessions[-1])
