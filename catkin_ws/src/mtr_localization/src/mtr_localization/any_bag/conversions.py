"""Converts a bag of any robot to a bag with the topics and frames of localization."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Tuple

import numpy as np
import rosbag
import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, LaserScan
from tf2_msgs.msg import TFMessage

from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.bags.diagnosis import unreadable
from mtr_core.errors import RobotError
from mtr_core.se2 import Pose2
from mtr_description.shipped import urdf_in
from mtr_description.urdf_tree import UrdfTree

from . import sources
from .delays import Delays
from .errors import BagUnusable
from .frames import FrameTree, add_urdf, matrix, quaternion_of, yaw_of
from .imu_check import ImuCheck
from .input_checks import OdometryClock, ScanCheck, check_odometry, check_scans
from .motion import WHEELS_TURN, Sample, Sweep, check_moves, check_same_time, samples_of
from .sources import TF, Asked

TF_TOPICS = ("/tf", "/tf_static", "tf")
FRONT_FRAME, REAR_FRAME, IMU_FRAME = "front_lidar", "rear_lidar", "imu"
NO_FORCE = -1.0
TRANSFORMS = "the transforms"
# Largest height difference of two LiDARs for a common map; a higher LiDAR sees other outlines.
SAME_PLANE_M = 0.5
EVERY = 500


class Found(NamedTuple):
    """Inputs found in the bag.

    Attributes:
        base: the robot's frame; odometry_frame: parent of its odometry.
        mounts: topics with scans -> (frame, base_from_lidar).
        parameters: parameters of localization that replace missing inputs.
        said: sentences for the user.
        delays: of the odometry.
        faults: sentences on unusable inputs; other advice would be misleading.
    """

    base: str
    odometry: str
    imu: Optional[str]
    mounts: Dict[str, Tuple[str, FloatArray]]
    samples: List[Sample]
    parameters: Dict[str, float]
    said: List[str]
    delays: Delays
    faults: List[str]


def convert(path: pathlib.Path, out: pathlib.Path, asked: Asked, needs_motion: bool,
            progress: Callable[[float], None]) -> Found:
    """Write the converted bag to `out`; BagUnusable with a sentence on failure.

    Args:
        needs_motion: a map must be built.
        progress: callback with the finished share.
    """
    try:
        with rosbag.Bag(str(path)) as bag:
            found = look(bag, asked)
            if needs_motion:
                check_moves(found.samples)
            with rosbag.Bag(str(out), "w") as written:
                _write(bag, written, found, asked, progress)
    except RobotError:
        raise
    except Exception as error:
        raise BagUnusable(unreadable(path, error)) from None
    return found


def look(bag: rosbag.Bag, asked: Asked) -> Found:
    """Return the inputs in the bag, from its topics, stamps and transforms."""
    topics = {topic: about.msg_type for topic, about in bag.get_type_and_topic_info().topics.items()}
    scans = sources.scans_of(topics, asked)
    odometry, imu = sources.odometry_of(topics, asked), sources.imu_of(topics, asked)
    tree = _tree_of(bag, asked)
    frames = {topic: _scan_frame(bag, topic) for topic in scans}
    base = asked.base_frame or _base_of(bag, odometry, tree, next(iter(frames.values())))
    delays = Delays()
    samples = _samples(bag, odometry, base, delays)
    check_same_time({odometry: samples[0].time_s,
                     **{topic: _first(bag, topic).header.stamp.to_sec() for topic in scans}})
    at = {topic: tree.fixed(base, frame) for topic, frame in frames.items()}
    said: List[str] = []
    if asked.front_scan is None:
        scans, said = _as_low(scans, at)
    front, rear = ((scans[0], scans[1] if len(scans) > 1 else None) if asked.front_scan is not None else
                   sources.front_and_rear([(topic, float(at[topic][0, 3])) for topic in scans]))
    mounts = {front: (FRONT_FRAME, at[front]), **({} if rear is None else {rear: (REAR_FRAME, at[rear])})}
    said += [f"{frame}: {topic}, {1e3 * place[0, 3]:.0f} mm ahead and {1e3 * place[1, 3]:.0f} mm left of {base}, "
            f"turned by {np.degrees(yaw_of(place)):.1f} degrees{' and upside down' if place[2, 2] < 0.0 else ''}."
            for topic, (frame, place) in mounts.items()]
    said.append(f"Odometry: {'transforms' if odometry == TF else odometry}; turn rate: {imu or 'of the wheels'}.")
    if asked.time_increment_s is None and any(_first(bag, topic).time_increment == 0.0 for topic in mounts):
        said.append("The scans do not say how long a sweep takes: each is taken at once, which is wrong by its length "
                    "times the speed; give --time-increment.")
    return Found(base, odometry, imu, mounts, samples, {} if imu else dict(WHEELS_TURN), said, delays, [])


def _scan_frame(bag: rosbag.Bag, topic: str) -> str:
    frame = str(_first(bag, topic).header.frame_id)
    if not frame.strip("/ "):
        raise BagUnusable(f"The scans of {topic} have no frame_id, so their place on the robot is unknown: set the "
                          "frame_id in the LiDAR's driver.")
    return frame


def _samples(bag: rosbag.Bag, odometry: str, base: str, delays: Delays) -> List[Sample]:
    poses = list(_poses(bag, odometry, base, delays))
    if not poses:
        raise BagUnusable(f"The bag contains no odometry of {base}; give its topic by --odometry, or the robot's "
                          "frame by --base-frame.")
    samples = samples_of(poses)
    if len(samples) < 2:
        name = TRANSFORMS if odometry == TF else odometry
        raise BagUnusable(f"Each of the {len(poses)} poses of {name} has the stamp {samples[0].time_s:g}, at least two "
                          "are needed: correct the odometry's driver, or name another topic by --odometry.")
    return samples


def _as_low(scans: List[str], at: Dict[str, FloatArray]) -> Tuple[List[str], List[str]]:
    """Return the topics of LiDARs at about the height of the lowest one, and a sentence about each excluded one."""
    lowest_m = min(at[topic][2, 3] for topic in scans)
    high = [topic for topic in scans if at[topic][2, 3] > lowest_m + SAME_PLANE_M]
    said = [f"{topic} is left out: its LiDAR is {at[topic][2, 3] - lowest_m:.1f} m above the lowest and sees other "
            "things." for topic in high]
    return [topic for topic in scans if topic not in high], said


def _tree_of(bag: rosbag.Bag, asked: Asked) -> FrameTree:
    tree = FrameTree()
    if asked.urdf is not None:
        add_urdf(tree, UrdfTree(urdf_in(pathlib.Path(asked.urdf))))
        return tree
    for _, message, _ in bag.read_messages(topics=TF_TOPICS):
        for each in message.transforms:
            tree.add(each.header.frame_id, each.child_frame_id, _matrix(each))
    return tree


def _base_of(bag: rosbag.Bag, odometry: str, tree: FrameTree, scan_frame: str) -> str:
    """Return the base frame of the odometry; with transforms only, the moving frame that carries the LiDAR."""
    if odometry != TF:
        return str(_first(bag, odometry).child_frame_id).lstrip("/") or "base_link"
    frame: Optional[str] = scan_frame.lstrip("/")
    while frame is not None and not tree.is_moving(frame):
        frame = tree.parent_of(frame)
    if frame is None:
        raise BagUnusable("The bag has no odometry: neither a topic nor a transform that moves above the LiDAR; name "
                          "its topic by --odometry.")
    return frame


def _poses(bag: rosbag.Bag, odometry: str, base: str, delays: Delays) -> Iterator[Tuple[float, Pose2]]:
    for _, message, received in bag.read_messages(topics=TF_TOPICS if odometry == TF else [odometry]):
        if odometry != TF:
            at = message.pose.pose
            delays.add(received.to_sec(), message.header.stamp.to_sec())
            yield message.header.stamp.to_sec(), _planar(matrix(_xyz(at.position), _xyzw(at.orientation), odometry))
            continue
        for each in message.transforms:
            if each.child_frame_id.lstrip("/") == base:
                delays.add(received.to_sec(), each.header.stamp.to_sec())
                yield each.header.stamp.to_sec(), _planar(_matrix(each))


def _write(bag: rosbag.Bag, out: rosbag.Bag, found: Found, asked: Asked, progress: Callable[[float], None]) -> None:
    begin = rospy.Time.from_sec(bag.get_start_time())
    static = TFMessage([_mount(frame, place) for frame, place in found.mounts.values()])
    out.write("/tf_static", static, begin)
    for sample in found.samples:
        time = rospy.Time.from_sec(sample.time_s)
        out.write(names.WHEEL_ODOMETRY, _odometry(sample, time), time)
        if found.imu is None:
            out.write(names.IMU_DATA, _imu(sample.angular_radps, time), time)
    checks = {topic: ScanCheck(topic, float(np.copysign(1.0, place[2, 2])))
              for topic, (_, place) in found.mounts.items()}
    targets = {FRONT_FRAME: names.FRONT_SCAN, REAR_FRAME: names.REAR_SCAN}
    wanted = [*found.mounts, *([found.imu] if found.imu else [])]
    count = max(1, bag.get_message_count(wanted))
    imu_check = None if found.imu is None else ImuCheck(found.imu)
    imu_turn = None if found.imu is None else _imu_turn(bag, found, asked)
    for number, (topic, message, received) in enumerate(bag.read_messages(topics=wanted)):
        if number % EVERY == 0:
            progress(number / count)
        if topic in found.mounts:
            frame = found.mounts[topic][0]
            message.header.frame_id = frame
            message.header.stamp -= rospy.Duration.from_sec(asked.scan_delay_s or 0.0)
            checks[topic].add(_sweep(message), received.to_sec())
            if asked.time_increment_s is not None:
                message.time_increment = asked.time_increment_s
                message.scan_time = asked.time_increment_s * len(message.ranges)
            out.write(targets[frame], message, message.header.stamp)
        elif imu_turn is not None and imu_check is not None:
            rate, force = message.angular_velocity, message.linear_acceleration
            rate.x, rate.y, rate.z = imu_turn @ _xyz(rate)
            force.x, force.y, force.z = imu_turn @ _xyz(force)
            message.header.frame_id = IMU_FRAME
            if imu_check.add(message.header.stamp.to_sec(), _xyz(rate), _xyz(force)):
                out.write(names.IMU_DATA, message, message.header.stamp)
    _check(list(checks.values()), imu_check, found, asked)
    progress(1.0)


def _check(scans: List[ScanCheck], imu: Optional[ImuCheck], found: Found, asked: Asked) -> None:
    """Compare the inputs with each other and extend the faults; BagUnusable if they do not allow a reliable pose."""
    clock = OdometryClock(TRANSFORMS if found.odometry == TF else found.odometry, found.samples, found.delays)
    if imu is not None:
        check_odometry(scans, imu, clock)
        found.faults.extend(imu.faults(clock.name, clock.turns))
    found.faults.extend(check_scans(scans, clock, asked))


def _imu_turn(bag: rosbag.Bag, found: Found, asked: Asked) -> FloatArray:
    """Return base_from_imu (rotation only); the identity if no transform is available."""
    try:
        turn: FloatArray = _tree_of(bag, asked).fixed(found.base, _first(bag, str(found.imu)).header.frame_id)[:3, :3]
    except BagUnusable:
        found.said.append(f"Nothing says how the IMU of {found.imu} is turned on the robot: its z axis is taken as up.")
        return np.eye(3)
    return turn


def _first(bag: rosbag.Bag, topic: str) -> Any:
    return next(message for _, message, _ in bag.read_messages(topics=[topic]))


def _mount(frame: str, place: FloatArray) -> TransformStamped:
    message = TransformStamped(child_frame_id=frame)
    message.header.frame_id = names.BASE
    at = message.transform
    at.translation.x, at.translation.y, at.translation.z = place[:3, 3]
    at.rotation.x, at.rotation.y, at.rotation.z, at.rotation.w = quaternion_of(place)
    return message


def _odometry(sample: Sample, time: rospy.Time) -> Odometry:
    message = Odometry(child_frame_id=names.BASE)
    message.header.stamp, message.header.frame_id = time, names.ODOM
    message.pose.pose.position.x, message.pose.pose.position.y = sample.pose.x, sample.pose.y
    message.pose.pose.orientation.z = float(np.sin(0.5 * sample.pose.heading))
    message.pose.pose.orientation.w = float(np.cos(0.5 * sample.pose.heading))
    message.twist.twist.linear.x, message.twist.twist.angular.z = sample.linear_mps, sample.angular_radps
    return message


def _sweep(message: LaserScan) -> Sweep:
    return Sweep(message.header.stamp.to_sec(), message.angle_increment, message.range_min, message.range_max,
                 message.ranges)


def _imu(rate_radps: float, time: rospy.Time) -> Imu:
    """Return a message with a gyro rate only; REP-145 marks unmeasured quantities with -1."""
    message = Imu()
    message.header.stamp, message.header.frame_id = time, IMU_FRAME
    message.angular_velocity.z = rate_radps
    covariance = [0.0] * 9
    covariance[0] = NO_FORCE
    message.orientation_covariance = message.linear_acceleration_covariance = covariance
    return message


def _planar(transform: FloatArray) -> Pose2:
    return Pose2(float(transform[0, 3]), float(transform[1, 3]), yaw_of(transform))


def _matrix(message: TransformStamped) -> FloatArray:
    at, source = message.transform, f"the transform from {message.header.frame_id} to {message.child_frame_id}"
    return matrix(_xyz(at.translation), _xyzw(at.rotation), source)


def _xyz(vector: Any) -> List[float]:
    return [vector.x, vector.y, vector.z]


def _xyzw(rotation: Any) -> List[float]:
    return [rotation.x, rotation.y, rotation.z, rotation.w]
