"""What is read from messages, parameters and the master."""
# SPDX-License-Identifier: Apache-2.0
import math
from types import SimpleNamespace

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_bringup.preflight import listening
from mtr_bringup.preflight.expected import Setup
from mtr_bringup.preflight.listening import Listener, content_of, sample_of, setup_of_robot
from mtr_bringup.preflight.records import ScanContent
from mtr_core import names

PUBLISHED = [[names.IMU_DATA, ["/b", "/a"]], ["/tf", ["/localization"]]]


@pytest.fixture
def robot(monkeypatch):
    """Parameters of a robot, which a test may change; its clock stands at 100 s."""
    parameters = {"/drive_control": {"rear_lidar": False, "base_guard": True,
                                     "lock_owners": ["dispatcher", "controller_input"]}}
    master = SimpleNamespace(getSystemState=lambda: (1, "", [PUBLISHED, [], []]),
                             getTopicTypes=lambda: (1, "", [[names.IMU_DATA, "sensor_msgs/Imu"]]))
    monkeypatch.setattr(listening.rospy, "get_param", lambda name, default=None: parameters.get(name, default))
    monkeypatch.setattr(listening.rospy, "get_master", lambda: master)
    monkeypatch.setattr(listening.rospy, "Subscriber", lambda *_, **__: None)
    monkeypatch.setattr(listening.rospy.Time, "now", lambda: listening.rospy.Time(100))
    return parameters


def test_scan_is_counted_beam_by_beam():
    scan = LaserScan(range_min=0.1, range_max=30.0, ranges=[1.0, math.inf, -math.inf, math.nan, 0.05, 31.0, 2.0],
                     angle_increment=math.pi / 6.0)
    assert content_of(scan) == ScanContent(7, 2, 1)
    assert sample_of(scan).points_m == pytest.approx(np.array([[1.0, 0.0], [-2.0, 0.0]]))
    assert content_of(LaserScan()) == ScanContent(0, 0, 0)


def test_setup_is_what_the_parameters_say(robot):
    assert setup_of_robot() == Setup(rear_lidar=False, controller=True, base_guard=True)
    robot.clear()
    assert setup_of_robot() == Setup(controller=False)
    robot["/use_sim_time"] = True
    assert setup_of_robot().is_simulated


def test_record_has_messages_publishers_types_parameters_and_failures(robot):
    robot["/base"], robot["/start_failures"] = {"cmd_vel_timeout": 0.25}, {"drive_control": "Because."}
    listener, message = Listener(), Imu()
    message.header.stamp, message.header.frame_id = listening.rospy.Time(99, 990_000_000), "/imu"
    message.linear_acceleration.z, message.angular_velocity.z = 9.81, 0.3
    listener._take(message, names.IMU_DATA)
    record = listener.record("/base")
    heard = record.topic(names.IMU_DATA)
    assert heard.publishers == ("/a", "/b") and heard.type == "sensor_msgs/Imu"
    assert heard.ages_s == [pytest.approx(0.01)] and dict(heard.frames) == {"imu": 1} and len(heard.arrivals_s) == 1
    assert record.base == {"cmd_vel_timeout": 0.25} and record.start_failures == {"drive_control": "Because."}
    assert listener.recording.imu[0] == (99.99, (0.0, 0.0, 0.3), (0.0, 0.0, 9.81))
    assert listener.record("/none").base is None


def test_transforms_are_kept_by_the_node_that_sent_them(robot):
    listener = Listener()
    for node in ("/base", "/localization", "/base"):
        each = TransformStamped(child_frame_id="base_link")
        each.header.frame_id = "/odom"
        message = TFMessage([each])
        message._connection_header = {"callerid": node}
        listener._take_transforms(message)
    assert listener.record("/none").transforms == {("odom", "base_link"): {"/base", "/localization"}}
