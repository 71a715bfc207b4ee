"""Between ROS messages and the locator's plain types."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Optional

import numpy as np
from geometry_msgs.msg import Point, TransformStamped
from sensor_msgs.msg import LaserScan
from visualization_msgs.msg import Marker, MarkerArray

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_msgs.msg import CarEstimate, MotionStatus, RobotMode, Waypoint

from .locator import Drive, Estimate, Order
from .rectangle import Rectangle
from .scan import Scan

LINE_WIDTH_M = 0.04
MARKER_HEIGHT_M = 0.05


def order_from(message: Optional[RobotMode]) -> Optional[Order]:
    """Order of the state machine."""
    if message is None:
        return None
    goal = message.goal
    return Order(message.mapping, message.map_car_id, goal.id if goal.frame_id == names.MAP else 0, goal.x, goal.y)


def drive_from(message: Optional[MotionStatus]) -> Optional[Drive]:
    """Word of the motion planner."""
    if message is None:
        return None
    return Drive(message.goal_id, message.result in (MotionStatus.REACHED, MotionStatus.REFUSED))


def scan_from(message: LaserScan, base_from_lidar: Pose2) -> Scan:
    """A sweep of one LiDAR."""
    return Scan(message.header.stamp.to_nsec() * 1e-9, message.time_increment, message.angle_min,
                message.angle_increment, message.range_min, message.range_max, np.asarray(message.ranges),
                base_from_lidar)


def estimate_message(estimate: Estimate, stamp: Any) -> CarEstimate:
    """Estimate for the other nodes."""
    message = CarEstimate(state=int(estimate.state), map_car_id=estimate.map_car_id, message=estimate.message)
    message.header.stamp, message.header.frame_id = stamp, names.MAP
    car = estimate.rectangle
    message.x, message.y, message.heading = car.pose.x, car.pose.y, car.pose.heading
    message.covariance = covariance_in_map(estimate)
    message.length, message.width = car.length, car.width
    message.length_sigma, message.width_sigma = estimate.length_sigma, estimate.width_sigma
    message.outline_x = [x for x, _ in estimate.outline]
    message.outline_y = [y for _, y in estimate.outline]
    if estimate.place:
        pose = estimate.place.pose
        message.next_waypoint = Waypoint(estimate.place.place_id, names.MAP, pose.x, pose.y, pose.heading,
                                         Waypoint.DIRECTION_FORWARD)
    return message


def covariance_in_map(estimate: Estimate) -> np.ndarray:
    """Row-major covariance of x, y, heading in map."""
    heading = estimate.rectangle.pose.heading
    cos, sin = math.cos(heading), math.sin(heading)
    map_from_car = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    return (map_from_car @ np.diag(np.square(estimate.sigmas)) @ map_from_car.T).ravel()


def transform_message(estimate: Estimate, stamp: Any) -> TransformStamped:
    """map to car."""
    pose = estimate.rectangle.pose
    message = TransformStamped(child_frame_id=names.CAR)
    message.header.stamp, message.header.frame_id = stamp, names.MAP
    message.transform.translation.x, message.transform.translation.y = pose.x, pose.y
    message.transform.rotation.z, message.transform.rotation.w = (math.sin(0.5 * pose.heading),
                                                                  math.cos(0.5 * pose.heading))
    return message


def markers_message(estimate: Estimate, stamp: Any) -> MarkerArray:
    """Outline and an arrow to the front, green when the Car is located."""
    outline = _marker(estimate, stamp, 0, Marker.LINE_STRIP)
    outline.scale.x = LINE_WIDTH_M
    outline.points = _points_in_map(estimate.rectangle, [*estimate.outline, *estimate.outline[:1]])
    arrow = _marker(estimate, stamp, 1, Marker.ARROW)
    arrow.scale.x, arrow.scale.y = LINE_WIDTH_M, 3.0 * LINE_WIDTH_M
    arrow.points = _points_in_map(estimate.rectangle, [(0.0, 0.0), (0.5 * estimate.rectangle.length, 0.0)])
    return MarkerArray(markers=[outline, arrow])


def _marker(estimate: Estimate, stamp: Any, number: int, kind: int) -> Marker:
    marker = Marker(ns="car", id=number, type=kind, action=Marker.ADD)
    marker.header.stamp, marker.header.frame_id = stamp, names.MAP
    marker.pose.orientation.w = 1.0
    located = estimate.state == CarState.LOCATED
    marker.color.r, marker.color.g, marker.color.b, marker.color.a = (0.1, 0.8, 0.2, 1.0) if located else (
        1.0, 0.6, 0.0, 1.0)
    return marker


def _points_in_map(car: Rectangle, points: Any) -> Any:
    return [Point(*car.pose.apply(x, y), MARKER_HEIGHT_M) for x, y in points]
