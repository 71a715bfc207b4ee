"""A robot that was carried away: driven by hand it finds itself and its test goes on, or the Car is mapped anew."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import signal
import subprocess
import sys
import time

import pytest

from mtr_operator.domain.requests import DesiredState
from mtr_operator.domain.robot_status import Mode
from mtr_operator.robot_link.client import ZmqRobotLink
from mtr_proto import robot_link_pb2
from mtr_simulation.demo import read_rows
from mtr_simulation.stack import Stack, StackOptions

HERE = pathlib.Path(__file__).parent
PARAMETERS = HERE / "parameters" / "autolock.yaml"
# In the Car's frame: beside it, where the lot is free for a circle, and about where it started.
CARRIED_TO = (0.5, 3.0, 2.0)
STARTING_PLACE = (4.1, 2.5, -2.6)
AXES = 8
STANDING_MPS = 0.02
NEAR_M = 0.05
WALL_LIMIT_S = 300.0


@pytest.fixture(scope="module")
def stack(out):
    """Paced, as somebody who holds the controller has to keep up with it."""
    with Stack(StackOptions(out, seed=3, real_time_factor=3.0, lockstep_operator=False,
                            arguments={"controller": "true"})) as running:
        yield running


@pytest.fixture
def hand(stack):
    """Somebody who holds the manual controller, and has released the emergency stop."""
    process = subprocess.Popen([sys.executable, str(HERE / "hand_on_joystick.py")], env=stack.environment())
    yield process
    process.send_signal(signal.SIGINT)
    process.wait(timeout=20)


def true_place(stack):
    """Of base_link in the Car's frame, now."""
    said = subprocess.run(["rostopic", "echo", "-n", "1", "-p", "/sim/truth/pose/pose/position"], check=True,
                          env=stack.environment(), text=True, capture_output=True).stdout.splitlines()
    columns = dict(zip(said[0].split(","), said[1].split(",")))
    return float(columns["field.x"]), float(columns["field.y"])


def carry(stack, place):
    """Lift the robot and put it down elsewhere in the Car's frame."""
    pose = "{{x: {}, y: {}, theta: {}}}".format(*place)
    subprocess.run(["rostopic", "pub", "-1", "/sim/kidnap", "geometry_msgs/Pose2D", pose], env=stack.environment(),
                   check=True, capture_output=True)


def test_robot_that_was_carried_away_is_driven_by_hand_finds_itself_and_the_test_goes_on(
        application, observer, out, stack, hand):
    folder = out / "autolock"
    progress = folder / "progress.json"
    running = application.start("autolock", PARAMETERS, folder)
    observer.wait_for(lambda status: progress.exists())
    measured = json.loads(progress.read_text(encoding="utf-8"))["results"]
    assert measured
    carry(stack, CARRIED_TO)
    lost = observer.wait_for(lambda status: not status.state.pose_valid)
    # It stands until somebody drives it.
    still_lost = observer.wait_for(lambda status: status.sent_time_s > lost.sent_time_s + 5.0)
    assert not still_lost.state.pose_valid
    assert abs(still_lost.state.speed) < STANDING_MPS

    hand.send_signal(signal.SIGUSR1)
    observer.wait_for(lambda status: status.motion_source == robot_link_pb2.MOTION_SOURCE_MANUAL)
    observer.wait_for(lambda status: status.state.pose_valid)
    hand.send_signal(signal.SIGUSR1)
    _, told = running.communicate(timeout=WALL_LIMIT_S)
    assert running.returncode == 0, told
    assert json.loads(progress.read_text(encoding="utf-8"))["results"][:len(measured)] == measured
    rows = read_rows(folder / "results.csv")
    assert len(rows) == AXES
    # On the way of the second one it was carried away.
    assert {row[column] for row in rows if row["axis"] != "2" for column in ("unlock_status", "lock_status")} == {"ok"}

    # It stands beside the Car and says where.
    place = true_place(stack)
    observer.wait_for(lambda status: status.state.pose_valid and math.dist((status.state.x, status.state.y), place)
                      < NEAR_M)


class Controller:
    """An application that wants the Car mapped, and nothing else."""

    def __init__(self, stack):
        self.link = ZmqRobotLink("127.0.0.1", stack.status_port, stack.command_port, is_unencrypted=True)
        self.link.connect()

    def order(self, map_car_id, until):
        """Say so until the robot's Status is as wanted; that Status."""
        deadline = time.monotonic() + WALL_LIMIT_S
        while time.monotonic() < deadline:
            status = self.link.next_status(0.5)
            if status is not None:
                self.link.send(DesiredState(map_car_id=map_car_id, max_speed_mps=0.8, resume_hold_id=status.hold_id))
                if until(status):
                    return status
        pytest.fail(f"The robot's Status did not become as wanted; the last one was {status}")


@pytest.fixture
def controller(stack):
    """The second application of this module."""
    ordering = Controller(stack)
    yield ordering
    ordering.link.close()


def is_beside_the_car(status):
    """It knows where it stands beside the Car."""
    return status.mode is Mode.FOLLOWING_WAYPOINT and status.pose_valid and status.car is not None


def test_lost_robot_that_was_put_at_the_starting_place_maps_the_car_anew(controller, stack, hand):
    assert hand.poll() is None
    controller.order(1, is_beside_the_car)
    carry(stack, CARRIED_TO)
    controller.order(1, lambda status: status.mode is Mode.FAULT and not status.pose_valid)
    carry(stack, STARTING_PLACE)
    controller.order(2, lambda status: status.mode is Mode.MAPPING_CAR)
    status = controller.order(2, is_beside_the_car)
    assert math.dist((status.x, status.y), true_place(stack)) < NEAR_M
