"""Data from messages, parameters and the master."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from types import SimpleNamespace

import numpy as np
import pytest
from geometry_msgs.msg import TransformStamped
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_commissioning.preflight import listening, topics
from mtr_commissioning.preflight.expected import Setup
from mtr_commissioning.preflight.listening import Listener, content_of, sample_of, setup_of_robot
from mtr_commissioning.preflight.obedience import obedience_findings
from mtr_commissioning.preflight.records import SaidTransform, ScanContent
from mtr_core import names
from mtr_msgs.msg import DriveStatus, Problem

PUBLISHED = [[names.IMU_DATA, ["/b", "/a"]], ["/tf", ["/localization"]]]


@pytest.fixture
def robot(monkeypatch):
    """Parameters of a robot, which a test may change; its clock is stopped at 100 s."""
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
    scan = LaserScan(range_min=0.1, range_max=30.0, ranges=[1.0, math.inf, -math.inf, math.nan, 0.05, 31.0, 2.0, 0.0],
                     angle_increment=math.pi / 6.0, time_increment=0.01)
    assert content_of(scan, math.pi) == ScanContent(8, 2, 2, pytest.approx(0.07), pytest.approx(math.pi / 6.0))
    assert sample_of(scan).points_m == pytest.approx(np.array([[1.0, 0.0], [-2.0, 0.0]]))
    assert content_of(LaserScan(), math.pi) == ScanContent(0, 0, 0, 0.0)


@pytest.mark.parametrize("first, last, own_view_deg, unseen_deg", [
    # Beams by the degree, from -135 to 135.
    (125, 144, 115.0, 20.0), (0, 29, 115.0, 10.0), (0, 29, 180.0, 30.0), (240, 270, 180.0, 31.0)])
@pytest.mark.parametrize("nothing", [0.0, math.nan])
def test_widest_piece_without_a_measurement_is_that_of_the_own_view(first, last, own_view_deg, unseen_deg, nothing):
    ranges = [nothing if first <= beam <= last else 5.0 for beam in range(271)]
    ranges[60] = nothing
    scan = LaserScan(range_min=0.1, range_max=30.0, ranges=ranges, angle_min=-0.75 * math.pi,
                     angle_increment=math.radians(1.0))
    found = content_of(scan, math.radians(own_view_deg) + 1e-9)
    assert math.degrees(found.unseen_rad) == pytest.approx(unseen_deg)


def test_what_counts_as_covered_is_drive_control_s():
    collision = pathlib.Path(__file__).resolve().parents[5] / "catkin_ws/src/mtr_drive_control/src/collision"
    headers = collision.parents[1] / "include" / "mtr_drive_control" / "collision"
    text = "".join(path.read_text(encoding="utf-8") for path in [*collision.glob("*.cpp"), *headers.glob("*.hpp")])
    assert f"kLegRad = {topics.MAX_UNSEEN_RAD};" in text
    assert f"kSharedViewRad = {listening.SHARED_VIEW_RAD};" in text


def test_setup_is_what_the_parameters_say(robot):
    assert setup_of_robot() == Setup(rear_lidar=False, controller=True, base_guard=True)
    robot.clear()
    assert setup_of_robot() == Setup(controller=False)
    robot["/use_sim_time"] = True
    assert setup_of_robot().is_simulated
    robot[names.LIDAR_TURN_RATE], robot["/drive_control"] = 15.0, {"lidar_timeout_s": 0.2}
    assert (setup_of_robot().turn_rate_hz, setup_of_robot().lidar_timeout_s) == (15.0, 0.2)
    robot[names.ROBOT_FRAMES] = {names.FRONT_LIDAR: "front_laser"}
    assert setup_of_robot().frames == {names.FRONT_LIDAR: "front_laser"}
    robot[names.WRITTEN_FOLDERS] = ["/var/lib/mtr/ros", "/var/log/mtr"]
    assert setup_of_robot().written_folders == ("/var/lib/mtr/ros", "/var/log/mtr")


def test_record_has_messages_publishers_types_parameters_and_failures(robot):
    robot[names.NODE_PARAMETERS], robot["/drive_control/e_stop_topics"] = {"drive_contrl": {"x": 1}}, ["/e_stop"]
    robot["/base"], robot["/start_failures"] = {"cmd_vel_timeout": 0.25}, {"drive_control": "Because."}
    listener, message = Listener(), Imu()
    message.header.stamp, message.header.frame_id = listening.rospy.Time(99, 990_000_000), "/imu"
    message.linear_acceleration.z, message.angular_velocity.z = 9.81, 0.3
    listener._take(message, names.IMU_DATA)
    record = listener.record("/base")
    heard = record.topic(names.IMU_DATA)
    assert heard.publishers == ("/a", "/b") and heard.type == "sensor_msgs/Imu"
    assert heard.ages_s == [pytest.approx(0.01)] and dict(heard.frames) == {"imu": 1} and len(heard.arrivals_s) == 1
    assert record.nodes == {"a", "b", "localization"}
    assert record.node_parameters == {"drive_contrl": {"x": 1}} and record.e_stop_topics == ("/e_stop",)
    assert record.base == {"cmd_vel_timeout": 0.25} and record.start_failures == {"drive_control": "Because."}
    assert listener.recording.imu[0] == (99.99, (0.0, 0.0, 0.3), (0.0, 0.0, 9.81))
    assert listener.record("/none").base is None


@pytest.fixture
def come(monkeypatch):
    """come(topic, seconds, ...) delivers messages at these times; it returns their recorded number and the end of the
    recording."""
    def listened(topic, *times_s, seconds=2.0):
        listener, now_s, coming = Listener(), [0.0], list(times_s)

        def sleep(for_s):
            now_s[0] += for_s
            while coming and coming[0] <= now_s[0]:
                coming.pop(0)
                listener._take(Imu(), topic)
        monkeypatch.setattr(listening.time, "sleep", sleep)
        monkeypatch.setattr(listening.time, "monotonic", lambda: now_s[0])
        return len(listener.listen(seconds, Setup()).topic(topic).arrivals_s), now_s[0]
    return listened


@pytest.mark.parametrize("times_s, count, until_s", [
    ((0.1, 0.2, 1.9), 3, 2.0), ((1.4, 2.4, 3.4), 2, 2.4), ((1.0, 9.0), 1, 6.0), ((), 0, 6.0)],
    ids=["in time", "seldom", "once", "never"])
def test_who_speaks_seldom_or_is_reached_late_is_waited_for(robot, come, times_s, count, until_s):
    heard, ready_s = come(names.IMU_DATA, *times_s)
    assert (heard, ready_s) == (count, pytest.approx(until_s, abs=0.11))


def test_topic_that_no_node_publishes_is_not_waited_for(robot, come, monkeypatch):
    monkeypatch.setattr(listening, "publishers", dict)
    assert come(names.IMU_DATA) == (0, 2.0)


def test_what_drive_control_says_of_base_and_sensors_is_found_and_what_else_stops_it_is_not(robot):
    listener = Listener()
    said = {"drive_control.base_disobeys": "The base does not obey: told 0.29 m/s.",
            "drive_control.obstacle": "Blocked."}
    for code, text in said.items():
        listener._take_drive_status(DriveStatus(problems=[Problem(code=code, text=text), Problem(code="cause")]))
    found = obedience_findings(listener.drive_control)
    assert [(each.is_bad, each.check) for each in found] == [(True, "motion.stopped")]
    assert "told 0.29 m/s" in found[0].text and not obedience_findings({})


def test_a_robot_is_heard_where_it_was_started_and_not_where_others_speak(robot, monkeypatch):
    heard = {}
    monkeypatch.setattr(listening.rospy, "Subscriber",
                        lambda topic, _kind, _take, callback_args=None: heard.update({callback_args: topic}))
    robot[names.ROBOT_TOPICS] = {"front_scan": "/rear/scan", "rear_scan": "front/scan", "imu_data": "/imu/elsewhere"}
    record = Listener().record("/none")
    assert (heard[names.FRONT_SCAN], heard[names.REAR_SCAN]) == (names.REAR_SCAN, names.FRONT_SCAN)
    assert heard[names.IMU_DATA] == "/imu/elsewhere" and not record.topic(names.IMU_DATA).publishers
    assert heard[names.WHEEL_ODOMETRY] == names.WHEEL_ODOMETRY


def test_topic_that_this_program_is_told_goes_before_that_of_the_start(robot, monkeypatch):
    monkeypatch.setattr(listening.rospy, "resolve_name", lambda name: {names.IMU_DATA: "/imu/told"}.get(name, name))
    robot[names.ROBOT_TOPICS] = {"imu_data": "/imu/elsewhere"}
    assert Listener().names[names.IMU_DATA] == "/imu/told"


def test_transforms_are_kept_by_the_node_that_sent_them(robot):
    listener = Listener()
    for node in ("/base", "/localization", "/base"):
        each = TransformStamped(child_frame_id="base_link")
        each.header.frame_id, each.transform.rotation.w = "/odom", 1.0
        each.transform.translation.x += len(node)
        message = TFMessage([each])
        message._connection_header = {"callerid": node}
        listener._take_transforms(message)
    record = listener.record("/none")
    assert record.transforms == {("odom", "base_link"): {"/base", "/localization"}}
    assert record.said == {("odom", "base_link", node): SaidTransform((len(node), 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
                           for node in ("/base", "/localization")}
