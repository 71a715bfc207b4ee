"""Records the running robot: messages on its topics, their publishers, and its parameters."""
# SPDX-License-Identifier: Apache-2.0
import math
import time
from typing import Any, Callable, Dict, FrozenSet, Set, Tuple, Type

import numpy as np
import rospy
from nav_msgs.msg import Odometry
from rospy.numpy_msg import numpy_msg
from sensor_msgs.msg import BatteryState, Imu, Joy, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_core import names
from mtr_motion_check.recording import ImuSample, Recording, ScanSample, SentSample, Sweep, WheelSample, scan_sample
from mtr_msgs.msg import DriveStatus, FirmwareState

from .expected import CONTROLLER_OWNER, Setup
from .records import RobotRecord, SaidTransform, ScanContent, TopicRecord
from .topics import silent_topics

TYPES: Dict[str, Type[Any]] = {
    names.FRONT_SCAN: numpy_msg(LaserScan), names.REAR_SCAN: numpy_msg(LaserScan), names.WHEEL_ODOMETRY: Odometry,
    names.IMU_DATA: Imu, names.BATTERY: BatteryState, names.FIRMWARE_STATE: FirmwareState, names.JOY: Joy}

# View to each side that a LiDAR covers alone if there are two: drive control's kSharedViewRad.
SHARED_VIEW_RAD = 2.0
# A battery publishes once a second, and on a busy computer a connection needs time: two messages within it.
PATIENCE_S, LOOK_EVERY_S = 4.0, 0.1


# Arguments of robot.launch for topics -> the topics' names in the nodes.
ARGUMENTS = {"front_scan": names.FRONT_SCAN, "rear_scan": names.REAR_SCAN, "imu_data": names.IMU_DATA,
             "wheel_odometry": names.WHEEL_ODOMETRY, "wheel_command": names.WHEEL_COMMAND, "battery": names.BATTERY}


def topics_of_robot() -> Dict[str, str]:
    """Return topics of sensors and base by their names in the nodes: as the robot was started, or as remapped on this
    program's command line (/front/scan:=/scan)."""
    started: Dict[str, Any] = rospy.get_param(names.ROBOT_TOPICS, {})
    found = {}
    for argument, topic in ARGUMENTS.items():
        told = rospy.resolve_name(topic)
        found[topic] = told if told != topic else rospy.resolve_name(str(started.get(argument, topic)))
    return found


def setup_of_robot() -> Setup:
    """Return the configuration of the running robot, from the parameters of drive control and of ROS."""
    drive: Dict[str, Any] = rospy.get_param("/drive_control", {})
    default = Setup()
    return Setup(
        bool(drive.get("rear_lidar", default.rear_lidar)), CONTROLLER_OWNER in drive.get("lock_owners", []),
        bool(drive.get("base_guard", default.base_guard)),
        str(drive.get("base_controller", default.base_controller)),
        bool(rospy.get_param("/use_sim_time", False)) or names.SIM_TRUTH in publishers(),
        float(rospy.get_param("/localization/time_increment_s", default.time_increment_s)),
        float(rospy.get_param(names.LIDAR_TURN_RATE, default.turn_rate_hz)),
        float(drive.get("lidar_timeout_s", default.lidar_timeout_s)),
        {str(link): str(frame) for link, frame in rospy.get_param(names.ROBOT_FRAMES, {}).items()},
        tuple(str(folder) for folder in rospy.get_param(names.WRITTEN_FOLDERS, ())),
        float(drive.get("reaction_s", default.reaction_s)))


def publishers() -> Dict[str, Tuple[str, ...]]:
    """Return topic -> publishing nodes, as listed by the master."""
    _, _, state = rospy.get_master().getSystemState()
    return {topic: tuple(sorted(nodes)) for topic, nodes in state[0]}


def nodes() -> FrozenSet[str]:
    """Return the running nodes, as listed by the master; each of them publishes or offers a service."""
    _, _, state = rospy.get_master().getSystemState()
    return frozenset(node.lstrip("/") for table in state for _, owners in table for node in owners)


class Listener:
    """Subscriber from its construction on, which stores the messages until they are requested.

    Attributes:
        recording: messages of the sensors that are compared in motion.
        drive_control: sentences of drive control about stops of the wheels, by their codes; the newest of each. names:
        topics of the robot by their names in the nodes; the records use the latter.
    """

    def __init__(self) -> None:
        self.recording = Recording()
        self.names = topics_of_robot()
        self._own_view_rad = SHARED_VIEW_RAD if rospy.get_param("/drive_control/rear_lidar", True) else math.pi
        self.drive_control: Dict[str, str] = {}
        self._topics: Dict[str, TopicRecord] = {}
        self._transforms: Dict[Tuple[str, str], Set[str]] = {}
        self._said: Dict[Tuple[str, str, str], SaidTransform] = {}
        self._clock: Callable[[], float] = rospy.get_time if rospy.get_param("/use_sim_time", False) else time.monotonic
        self._begun_s = self._clock()
        self._keepers: Dict[str, Callable[[Any], None]] = {
            names.FRONT_SCAN: self._keep_front, names.REAR_SCAN: self._keep_rear,
            names.WHEEL_ODOMETRY: self._keep_wheels, names.IMU_DATA: self._keep_imu}
        for topic, kind in TYPES.items():
            self._topics[topic] = TopicRecord()
            rospy.Subscriber(self.names.get(topic, topic), kind, self._take, callback_args=topic)
        rospy.Subscriber(names.DRIVE_STATUS, DriveStatus, self._take_drive_status)
        for topic in ("/tf", "/tf_static"):
            rospy.Subscriber(topic, TFMessage, self._take_transforms)

    def listen(self, seconds: float, setup: Setup) -> RobotRecord:
        """Record for this time, and for up to PATIENCE_S more if a publishing node has not been received yet."""
        # The simulated clock is not used, because it may be stopped.
        time.sleep(seconds)
        end_s = time.monotonic() + PATIENCE_S
        record = self.record(setup.base_parameters)
        while silent_topics(record, setup) and time.monotonic() < end_s:
            time.sleep(LOOK_EVERY_S)
            record = self.record(setup.base_parameters)
        return record

    def record(self, base_parameters: str) -> RobotRecord:
        """Return all messages so far, with the master's lists."""
        types, known = dict(rospy.get_master().getTopicTypes()[2]), publishers()
        for topic in {*known, *self.names}:
            heard, name = self._topics.setdefault(topic, TopicRecord()), self.names.get(topic, topic)
            heard.publishers, heard.type = known.get(name, ()), types.get(name, "")
        base = rospy.get_param(base_parameters, None)
        failures = rospy.get_param(names.START_FAILURES, {})
        transforms = {pair: set(nodes) for pair, nodes in list(self._transforms.items())}
        return RobotRecord(dict(self._topics), transforms, dict(self._said), self._clock() - self._begun_s,
                           base if isinstance(base, dict) else None,
                           {str(node): str(why) for node, why in failures.items()}, nodes(),
                           rospy.get_param(names.NODE_PARAMETERS, {}),
                           tuple(rospy.get_param("/drive_control/e_stop_topics", ())))

    def _take(self, message: Any, topic: str) -> None:
        heard = self._topics[topic]
        heard.arrivals_s.append(self._clock())
        header = getattr(message, "header", None)
        if header is not None:
            heard.ages_s.append((rospy.Time.now() - header.stamp).to_sec())
            heard.frames[header.frame_id.lstrip("/")] += 1
        keep = self._keepers.get(topic)
        if keep:
            keep(message)

    def _take_drive_status(self, message: Any) -> None:
        self.recording.sent.append(SentSample(message.header.stamp.to_sec(), message.linear_mps))
        # Further problems are its consequences; the first one is the cause.
        for problem in message.problems[:1]:
            self.drive_control[problem.code] = problem.text

    def _take_transforms(self, message: Any) -> None:
        node = message._connection_header["callerid"]
        for each in message.transforms:
            pair = (each.header.frame_id.lstrip("/"), each.child_frame_id.lstrip("/"))
            self._transforms.setdefault(pair, set()).add(node)
            self._said[(*pair, node)] = said_transform(each.transform)

    def _keep_front(self, message: Any) -> None:
        self._topics[names.FRONT_SCAN].scans.append(content_of(message, self._own_view_rad))
        self.recording.front.append(sample_of(message))

    def _keep_rear(self, message: Any) -> None:
        self._topics[names.REAR_SCAN].scans.append(content_of(message, self._own_view_rad))
        self.recording.rear.append(sample_of(message))

    def _keep_wheels(self, message: Any) -> None:
        twist = message.twist.twist
        self.recording.wheels.append(WheelSample(message.header.stamp.to_sec(), twist.linear.x, twist.angular.z))

    def _keep_imu(self, message: Any) -> None:
        rate, force = message.angular_velocity, message.linear_acceleration
        self.recording.imu.append(ImuSample(message.header.stamp.to_sec(), (rate.x, rate.y, rate.z),
                                            (force.x, force.y, force.z)))


def said_transform(transform: Any) -> SaidTransform:
    """Convert the transform of a message."""
    at, turn = transform.translation, transform.rotation
    return SaidTransform((at.x, at.y, at.z), (turn.x, turn.y, turn.z, turn.w))


def content_of(message: Any, own_view_rad: float) -> ScanContent:
    """Count the beams of a scan message, the hits, and the beams without a number or with zero, as from drivers without
    REP 117.

    own_view_rad: to each side of the LiDAR's direction; not covered by another LiDAR.
    """
    ranges = np.asarray(message.ranges)
    with np.errstate(invalid="ignore"):
        hits = np.isfinite(ranges) & (ranges >= message.range_min) & (ranges <= message.range_max)
    sweep_s = message.time_increment * max(len(ranges) - 1, 0)
    missing = np.isnan(ranges) | (ranges == 0.0)
    angles_rad = message.angle_min + message.angle_increment * np.arange(len(ranges))
    is_own = np.abs(np.remainder(angles_rad + math.pi, 2.0 * math.pi) - math.pi) <= own_view_rad
    unseen_rad = longest_run(missing & is_own) * abs(message.angle_increment)
    return ScanContent(len(ranges), int(np.count_nonzero(hits)), int(np.count_nonzero(missing)), sweep_s, unseen_rad)


def longest_run(flags: "np.ndarray[Any, Any]") -> int:
    """Return the length of the longest run of true values."""
    ends = np.flatnonzero(np.diff(np.concatenate(([0], flags.astype(np.int8), [0]))))
    return int(np.max(ends[1::2] - ends[::2], initial=0))


def sample_of(message: Any) -> ScanSample:
    """Return the hits of a scan message."""
    return scan_sample(Sweep(message.header.stamp.to_sec(), message.angle_min, message.angle_increment,
                             message.time_increment, message.range_min, message.range_max, message.ranges))
