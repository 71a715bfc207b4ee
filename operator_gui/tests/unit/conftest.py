"""The links of a kinematic robot and its Car, and whole tests with them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import replace

import pytest
from kinematic_world import KEY_X_M, FakeExtender, FakeHandle, World

from mtr_operator.domain.assistance import OPERATOR
from mtr_operator.domain.interfaces.car_bus import BusMonitor, CarEquipment
from mtr_operator.domain.ports import CarLink, LinkStatistics, LockState, RobotLink
from mtr_operator.domain.robot_status import PreflightReport, RobotStatus


class FakeRobot(RobotLink):
    """Each next_status lets 0.1 s pass; `answers` are the pairs of Status id and desired state sent after it."""

    def __init__(self, world):
        self.world, self.statistics, self.answers, self.status_id = world, LinkStatistics(), [], 0
        self.closed = False

    def connect(self):
        pass

    def next_status(self, timeout_s):
        world = self.world
        world.step()
        self.status_id += 1
        return world.spoil(RobotStatus(
            id=self.status_id, robot_session_id=7, stamp_s=world.time_s, sent_s=world.time_s,
            steady_s=world.time_s, x=world.x, y=world.y, heading=world.heading,
            speed_mps=world.speed_mps, pose_valid=True, position_sigma_m=0.03, heading_sigma_rad=0.01, key_x=KEY_X_M,
            key_height_m=world.height_m, mode=world.mode, car=world.car, car_frame=world.frame,
            preflight=PreflightReport(), battery_percent=80, simulated=True,
            car_check=world.check and replace(world.check, id=world.checked_id), waypoint_result=world.result,
            waypoint_id=world.waypoint.id if world.waypoint else 0, waypoint_message=world.message,
            presses=tuple(press for press in world.presses if press.end_s <= world.time_s)))

    def send(self, desired):
        self.answers.append((self.status_id, desired))
        self.world.take(desired)

    def close(self):
        self.closed = True


class FakeCar(CarLink, BusMonitor, CarEquipment):
    """Bus of the world's Car."""

    def __init__(self, world):
        self.world, self._stamp_s = world, 0.0

    def connect(self):
        pass

    def observe(self, status):
        self._stamp_s = status.stamp_s
        due = [event for event in self.world.events if event.time_s <= status.stamp_s]
        self.world.events = [event for event in self.world.events if event not in due]
        return due

    @property
    def facts(self):
        return self.world.facts

    @property
    def handle(self):
        return self.world.output

    @property
    def signals(self):
        return self.world.signals(self._stamp_s)

    @property
    def extender(self):
        return self.world.extender

    @property
    def distance_feed(self):
        return self.world.phone

    @property
    def lock_state(self):
        if self.problem:
            return LockState.UNKNOWN
        return LockState.LOCKED if self.world.locked else LockState.UNLOCKED

    @property
    def problem(self):
        return self.world.car_problem(self._stamp_s)

    def close(self):
        pass


@pytest.fixture
def world():
    """World without faults."""
    return World()


@pytest.fixture
def robot_link(world):
    """Link to the world's robot."""
    return FakeRobot(world)


@pytest.fixture
def car_link(world):
    """Link to the world's Car."""
    return FakeCar(world)


@pytest.fixture
def output(world):
    """An output that takes the Car's handle at once."""
    world.output = FakeHandle(world)
    return world.output


@pytest.fixture
def person(world):
    """Somebody who takes it half a second after being asked."""
    return FakeHandle(world, OPERATOR, 0.5)


@pytest.fixture
def extender(world):
    """An output that switches an extender of 5 m at once."""
    world.extender = FakeExtender(world, 5.0)
    return world.extender


@pytest.fixture
def spoil(world):
    """spoil(condition, **changes) changes each Status that fulfils the condition."""
    def arrange(condition, **changes):
        world.spoil = lambda status: replace(status, **changes) if condition(status) else status
    return arrange


@pytest.fixture
def run_scenario(robot_link, car_link):
    """run_scenario(scenario, parameters, ...) runs a whole test; the saved copies of its results are in `saved`."""
    from mtr_operator.domain.actions.control_loop import ControlLoop
    from mtr_operator.domain.exchange.run_context import Assistance
    from mtr_operator.domain.results.progress import Progress
    from mtr_operator.domain.runner import Runner

    def run(scenario, parameters, progress=None, is_cancelled=lambda: False, *, observer=None, person=None, again=(),
            skipping=None):
        run.progress = progress or Progress(scenario.name, parameters.to_mapping())
        run.saved = []
        loop = ControlLoop(robot_link, car_link, observer, is_cancelled, assistance=Assistance(person))
        loop.skipping = skipping or loop.skipping
        Runner(scenario, parameters, loop, run.progress,
               lambda state: run.saved.append(list(state.results)), again=again).run()
        return run.progress.results
    return run
