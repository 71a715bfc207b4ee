"""A robot that was carried away in the middle of a test: driven by hand it finds itself again, and the test goes on."""
# SPDX-License-Identifier: Apache-2.0
import json
import math
import pathlib
import signal
import subprocess
import sys

import pytest

from mtr_bringup.demo import read_rows
from mtr_bringup.stack import Stack, StackOptions
from mtr_proto import robot_link_pb2

HERE = pathlib.Path(__file__).parent
PARAMETERS = HERE / "parameters" / "autolock.yaml"
# In the Car's frame, beside it, where the lot is free for a circle.
CARRIED_TO = (0.5, 3.0, 2.0)
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


def test_robot_that_was_carried_away_is_driven_by_hand_finds_itself_and_the_test_goes_on(
        application, observer, out, stack, hand):
    folder = out / "autolock"
    progress = folder / "progress.json"
    running = application.start("autolock", PARAMETERS, folder)
    observer.wait_for(lambda status: progress.exists())
    measured = json.loads(progress.read_text(encoding="utf-8"))["results"]
    assert measured
    pose = "{{x: {}, y: {}, theta: {}}}".format(*CARRIED_TO)
    subprocess.run(["rostopic", "pub", "-1", "/sim/kidnap", "geometry_msgs/Pose2D", pose], env=stack.environment(),
                   check=True, capture_output=True)
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
