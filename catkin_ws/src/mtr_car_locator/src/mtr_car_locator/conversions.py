"""Conversions between ROS messages and the locator's plain types."""
# SPDX-License-Identifier: Apache-2.0
import math
import pathlib
from typing import Any, Dict, Iterator, List, Optional

import numpy as np
from geometry_msgs.msg import Point, TransformStamped
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

from mtr_core import names
from mtr_core.arrays import FloatArray
from mtr_core.bags.diagnosis import unreadable
from mtr_core.conversions import goal_from, waypoint_message
from mtr_core.errors import RobotError
from mtr_core.problems import messages_of, problem_of
from mtr_core.se2 import Pose2
from mtr_core.states import State
from mtr_description.mounts import LidarMounts
from mtr_msgs.msg import CarCheck, CarEstimate, LocalizedPose, MappingOrder, Problem, RobotMode
from mtr_msgs.msg import SurfaceMap as SurfaceMapMessage

from . import problems
from .drawing import MarkerKind, MarkerShape
from .estimate import Estimate, LocatorTask
from .offline import FilesUnusable
from .parameters import RefinementParameters
from .poses import PoseMode, RobotPose
from .scan import RangeBias, Scan
from .surfels import surfels_from
from .survey.surface_map import SurfaceMap

MARKER_HEIGHT_M = 0.05
MARKER_TYPES = {MarkerKind.LOOP: Marker.LINE_STRIP, MarkerKind.SEGMENTS: Marker.LINE_LIST,
                MarkerKind.ARROW: Marker.ARROW, MarkerKind.DOTS: Marker.SPHERE_LIST}


def task_from(message: Optional[RobotMode]) -> Optional[LocatorTask]:
    """Return the locator's task from the mode of the state machine."""
    if message is None:
        return None
    return LocatorTask(message.mapping, message.map_car_id, goal_from(message), message.mode == State.CHECKING_CAR,
                       message.check_car_id)


def robot_pose_from(message: LocalizedPose) -> RobotPose:
    """Return the robot's pose."""
    return RobotPose(message.header.stamp.to_nsec() * 1e-9, Pose2(message.x, message.y, message.heading),
                     message.speed_mps, message.yaw_rate_radps, PoseMode(message.mode), message.map_revision,
                     tuple(message.covariance))


def scan_from(message: LaserScan, base_from_lidar: Pose2, is_rear: bool, time_increment_s: float = 0.0) -> Scan:
    """Return a sweep of one LiDAR. time_increment_s: time between beams, if the message does not state it."""
    return Scan(message.header.stamp.to_nsec() * 1e-9, message.time_increment or time_increment_s, message.angle_min,
                message.angle_increment, message.range_min, message.range_max, np.asarray(message.ranges),
                base_from_lidar, is_rear)


def scan_mounts(lidars: LidarMounts) -> Dict[str, Pose2]:
    """Return the LiDAR mount of each scan topic."""
    mounts = {names.FRONT_SCAN: lidars.front}
    if lidars.rear is not None:
        mounts[names.REAR_SCAN] = lidars.rear
    return mounts


def scans_in(bag: pathlib.Path, lidars: LidarMounts) -> Iterator[Scan]:
    """Yield the sweeps of the LiDARs in a recorded drive, in the order of their times."""
    # Imported here, so that the node, which does not read bags, starts without rosbag.
    import rosbag

    mounts = scan_mounts(lidars)
    try:
        with rosbag.Bag(str(bag)) as recorded:
            for topic, message, _ in recorded.read_messages(topics=list(mounts)):
                yield scan_from(message, mounts[topic], topic == names.REAR_SCAN)
    except RobotError:
        raise
    except Exception as error:
        raise FilesUnusable(unreadable(bag, error)) from None


def surface_map_from(message: SurfaceMapMessage) -> SurfaceMap:
    """Return the adjusted map of localization; columns of different lengths make it invalid."""
    columns = [message.x, message.y, message.normal, message.length, message.sigma, message.hits]
    frames = np.array([(frame.stamp.to_nsec() * 1e-9, frame.x, frame.y, frame.heading)
                       for frame in message.key_frames]).reshape(-1, 4)
    whole = len({len(column) for column in columns}) == 1
    surfels = surfels_from(np.column_stack(columns) if whole else np.empty((0, 6)))
    problem = problem_of(message.problems, message.message) if whole else problems.MAP_DAMAGED()
    return SurfaceMap(message.map_car_id, message.revision, message.valid and whole, surfels, frames, problem,
                      RangeBias(message.range_bias_m, message.rear_range_bias_m))


def estimate_message(estimate: Estimate, stamp: Any) -> CarEstimate:
    """Return the estimate as a message."""
    message = CarEstimate(state=int(estimate.state), map_car_id=estimate.map_car_id, message=estimate.message.text,
                          problems=messages_of(estimate.message, Problem),
                          revision=estimate.revision)
    message.header.stamp, message.header.frame_id = stamp, names.MAP
    car, correction = estimate.rectangle, estimate.correction
    message.x, message.y, message.heading = car.pose.x, car.pose.y, car.pose.heading
    message.covariance = covariance_in_map(estimate)
    message.length, message.width = car.length, car.width
    message.length_sigma, message.width_sigma = estimate.length_sigma, estimate.width_sigma
    sides = estimate.side_sigmas
    message.front_sigma, message.rear_sigma, message.left_sigma, message.right_sigma = sides
    message.outline_x = [x for x, _ in estimate.outline]
    message.outline_y = [y for _, y in estimate.outline]
    message.correction_x, message.correction_y = correction.x, correction.y
    message.correction_heading = correction.heading
    if estimate.waypoint:
        message.next_waypoint = waypoint_message(estimate.waypoint)
    return message


def covariance_in_map(estimate: Estimate) -> FloatArray:
    """Return the row-major covariance of x, y, heading in map."""
    heading = estimate.rectangle.pose.heading
    cos, sin = math.cos(heading), math.sin(heading)
    map_from_car = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return (map_from_car @ np.diag(np.square(estimate.sigmas)) @ map_from_car.T).ravel()


def mapping_message(estimate: Estimate, stamp: Any) -> MappingOrder:
    """Return the order to the mapper of localization."""
    message = MappingOrder(map_car_id=estimate.map_id, phase=int(estimate.phase))
    message.header.stamp = stamp
    return message


def check_message(estimate: Estimate, limits: RefinementParameters, stamp: Any) -> CarCheck:
    """Return the state of the self-check."""
    report = estimate.check
    message = CarCheck(id=report.check_id, state=int(report.state), difference_m=report.difference_m,
                       difference_rad=report.difference_rad, limit_m=limits.check_limit_m,
                       limit_rad=limits.check_limit_rad, message=report.message.text,
                       problems=messages_of(report.message, Problem))
    message.header.stamp = stamp
    return message


def transform_message(estimate: Estimate, stamp: Any) -> TransformStamped:
    """Return the transform from map to car."""
    pose = estimate.rectangle.pose
    message = TransformStamped(child_frame_id=names.CAR)
    message.header.stamp, message.header.frame_id = stamp, names.MAP
    message.transform.translation.x, message.transform.translation.y = pose.x, pose.y
    message.transform.rotation.z, message.transform.rotation.w = (math.sin(0.5 * pose.heading),
                                                                  math.cos(0.5 * pose.heading))
    return message


def markers_message(shapes: List[MarkerShape], stamp: Any) -> MarkerArray:
    """Return markers that replace all previous ones."""
    clear = Marker(action=Marker.DELETEALL)
    clear.header.stamp, clear.header.frame_id = stamp, names.MAP
    return MarkerArray(markers=[clear, *(_marker(shape, stamp) for shape in shapes if shape.points)])


def _marker(shape: MarkerShape, stamp: Any) -> Marker:
    marker = Marker(ns=shape.name, type=MARKER_TYPES[shape.kind], action=Marker.ADD)
    marker.header.stamp, marker.header.frame_id = stamp, names.MAP
    marker.pose.orientation.w = 1.0
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = shape.colour
    marker.scale.x = marker.scale.y = marker.scale.z = shape.size_m
    if shape.kind is MarkerKind.ARROW:
        marker.scale.y, marker.scale.z = 3.0 * shape.size_m, 0.0
    points = [*shape.points, *shape.points[:1]] if shape.kind is MarkerKind.LOOP else shape.points
    marker.points = [Point(x, y, MARKER_HEIGHT_M) for x, y in points]
    return marker
