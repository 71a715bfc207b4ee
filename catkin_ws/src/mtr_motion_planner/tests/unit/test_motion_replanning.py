"""A moving robot follows its old plan until the new one is due; the newest goal wins; a late plan stops the robot."""
# SPDX-License-Identifier: Apache-2.0
import math
import pickle
from concurrent.futures import Executor, Future

import pytest
from motion_simulation import FOOTPRINT, PARAMETERS, PERIOD_S, SimulatedRobot

from mtr_core.se2 import Pose2
from mtr_core.states import Result
from mtr_motion_planner.planner import MotionPlanner
from mtr_motion_planner.replanning import LEAD_S

START = Pose2(4.0, 2.6, math.radians(-147.0))


class Later(Executor):
    """Does its work when the test requests it, with pickled copies, like another process."""

    def __init__(self):
        self.jobs = []

    def submit(self, work, *arguments, **named):
        """Store the job."""
        self.jobs.append((Future(), *pickle.loads(pickle.dumps((work, arguments, named)))))
        return self.jobs[-1][0]

    def work(self, which=-1):
        """Execute one job."""
        done, work, arguments, named = self.jobs[which]
        if not done.cancelled():
            done.set_result(pickle.loads(pickle.dumps(work(*arguments, **named))))

    def fail(self, error):
        """End the newest job with an error."""
        if not self.jobs[-1][0].done():
            self.jobs[-1][0].set_exception(pickle.loads(pickle.dumps(error)))


@pytest.fixture(name="later")
def later_fixture():
    return Later()


@pytest.fixture(name="robot")
def robot_fixture(later):
    robot = SimulatedRobot(START)
    robot.planner = MotionPlanner(PARAMETERS, FOOTPRINT, later)
    robot.go(1, -4.0, 2.5, 0.0)
    robot.tick()
    later.work()
    robot.run_for(4.0)
    return robot


def test_robot_stands_until_its_first_plan_is_made_and_says_that_it_is_under_way(later):
    robot = SimulatedRobot(START)
    robot.planner = MotionPlanner(PARAMETERS, FOOTPRINT, later)
    robot.go(1, -4.0, 2.5, 0.0)
    robot.run_for(2.0)
    assert all(output.result == Result.PENDING and output.linear_mps == 0.0 for output in robot.outputs)
    later.work()
    assert robot.run().result == Result.REACHED


def test_moving_robot_goes_on_without_braking_while_the_plan_for_a_new_goal_is_made(robot, later):
    speed = robot.speed
    robot.go(2, -4.5, -2.5, 30.0)
    robot.run_for(LEAD_S)
    assert robot.speed == pytest.approx(speed, abs=0.02)
    later.work()
    robot.outputs.clear()
    assert robot.run().result == Result.REACHED
    assert robot.largest_step() <= 0.04 + 1e-6
    assert len(later.jobs) == 2


def test_new_goal_is_in_the_status_at_once(robot):
    robot.go(2, -4.5, -2.5, 30.0)
    assert robot.tick().goal_id.waypoint_id == 2


def test_newest_goal_wins_whichever_plan_is_made_first(robot, later):
    robot.go(2, 4.5, 2.5, 0.0)
    robot.run_for(2 * PERIOD_S)
    robot.go(3, -4.5, -2.5, 30.0)
    robot.tick()
    later.work()
    later.work(1)
    assert robot.run().result == Result.REACHED
    assert math.hypot(robot.miss().x, robot.miss().y) < 0.02


def test_robot_whose_plan_is_late_stops_and_goes_on_when_there_is_one(robot, later):
    robot.go(2, -4.5, -2.5, 30.0)
    robot.run_for(LEAD_S + 2.0)
    assert robot.speed == pytest.approx(0.0, abs=0.02)
    later.work()
    robot.run_for(2 * PERIOD_S)
    later.work()
    assert robot.run().result == Result.REACHED


def test_goal_withdrawn_while_its_plan_is_made_leaves_the_robot_standing(robot, later):
    robot.go(2, -4.5, -2.5, 30.0)
    robot.tick()
    robot.go(0, 0.0, 0.0, 0.0)
    later.work()
    robot.run_for(2.0)
    assert robot.outputs[-1].result == Result.IDLE and robot.speed == pytest.approx(0.0, abs=0.02)


def test_goal_inside_the_car_is_refused_at_once_in_mid_motion(robot, later):
    robot.go(2, 0.0, 0.0, 0.0)
    assert robot.tick().result == Result.REFUSED
    assert len(later.jobs) == 1


@pytest.mark.parametrize("error", [ZeroDivisionError("x"), IndexError(), AssertionError("y"), MemoryError()])
def test_defect_in_planning_refuses_the_goal_and_the_next_one_is_reached(robot, later, error):  # A11
    robot.go(2, -4.5, -2.5, 30.0)
    robot.tick()
    later.fail(error)
    # It tries again while it brakes.
    robot.run_for(LEAD_S + 2.0)
    later.fail(error)
    output = robot.run_for(2.0)
    assert output.result == Result.REFUSED and output.message.code == "motion_planner.planning_defect"
    assert type(error).__name__ in output.message.text and robot.speed == pytest.approx(0.0, abs=0.02)
    robot.go(3, -4.0, 2.5, 0.0)
    robot.tick()
    later.work()
    assert robot.run().result == Result.REACHED


def test_plans_that_nobody_wants_any_more_are_not_made(robot, later):  # D8
    for number in range(2, 12):
        robot.go(number, 4.0 + 0.01 * number, 2.5, 0.0)
        robot.tick()
    waiting = [future for future, *_ in later.jobs if not future.done()]
    assert len(later.jobs) > 5 and len(waiting) <= 1
