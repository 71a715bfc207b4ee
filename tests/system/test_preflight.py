"""The preflight on the simulated robot: good as it is, and bad beside nodes that do not belong there."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib
import subprocess
import sys

import pytest

from mtr_core import names
from mtr_simulation.stack import Stack, StackOptions

TOP = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = TOP / "catkin_ws/src/mtr_commissioning/scripts/preflight"
LIMIT_S = 60.0
# Commands the wheels to stand, says where base and front LiDAR are, as forgotten nodes would; then waits for its end.
INTRUDER = """
import rospy
from geometry_msgs.msg import TransformStamped, Twist
from tf2_msgs.msg import TFMessage
rospy.init_node("intruder")
wheels = rospy.Publisher("/jackal_velocity_controller/cmd_vel", Twist, queue_size=1, latch=True)
wheels.publish(Twist())
transform = TransformStamped(child_frame_id="base_link")
transform.header.frame_id = "odom"
transform.transform.rotation.w = 1.0
transforms = rospy.Publisher("/tf", TFMessage, queue_size=1, latch=True)
transforms.publish(TFMessage([transform]))
mount = TransformStamped(child_frame_id="front_lidar")
mount.header.frame_id = "base_link"
mount.transform.translation.x = mount.transform.rotation.w = 1.0
mounts = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
mounts.publish(TFMessage([mount]))
print("ready", flush=True)
rospy.spin()
"""


@pytest.fixture(scope="module")
def robot(out):
    """The simulated robot at the pace of the wall clock, alone."""
    with Stack(StackOptions(out, real_time_factor=1.0, lockstep_operator=False)) as running:
        yield running


def preflight(robot, path):
    """Exit status, lines, and findings in the file."""
    done = subprocess.run([sys.executable, str(PROGRAM), "--seconds", "4", "--json", str(path)], text=True,
                          capture_output=True, env=robot.environment(), timeout=LIMIT_S, check=False)
    assert path.exists(), done.stdout + done.stderr
    return done.returncode, done.stdout.splitlines(), json.loads(path.read_text(encoding="utf-8"))["findings"]


def of_robot(findings):
    """Bad findings but those of this computer, and of its load."""
    return [finding for finding in findings if finding["bad"] and not finding["check"].startswith(
        ("machine.", "topic.gap", "topic.age", "topic.rate"))]


def test_simulated_robot_is_good(robot, out):
    status, lines, findings = preflight(robot, out / "good.json")
    assert of_robot(findings) == []
    assert status == int(any(finding["bad"] for finding in findings))
    assert len(lines) == len(findings) + 2 and {line[:4] for line in lines[:-1]} <= {"ok  ", "BAD ", "List"}
    assert {names.FRONT_SCAN, names.REAR_SCAN, names.WHEEL_ODOMETRY, names.IMU_DATA, names.BATTERY,
            names.FIRMWARE_STATE} <= {finding["subject"] for finding in findings}


def test_node_that_does_not_belong_there_is_named(robot, out):
    with subprocess.Popen([sys.executable, "-c", INTRUDER], env=robot.environment(), text=True,
                          stdout=subprocess.PIPE) as intruder:
        try:
            assert intruder.stdout.readline() == "ready\n"
            status, _, findings = preflight(robot, out / "bad.json")
        finally:
            intruder.terminate()
    told = {finding["subject"]: finding["text"] for finding in of_robot(findings)}
    assert status == 1 and set(told) == {names.WHEEL_COMMAND, "odom -> base_link", "base_link -> front_lidar",
                                         names.FRONT_LIDAR}
    assert all("/intruder" in text for text in told.values()) and "publish_odom_tf" in told["odom -> base_link"]
    assert "/intruder has front_lidar at (1.000, 0.000, 0.000) m" in told[names.FRONT_LIDAR]
