"""Converts between ROS messages and the planner's plain types; a stamp_s is of the steady clock, which is never set."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Optional, Sequence, Tuple

from geometry_msgs.msg import Point, PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import ColorRGBA, Header
from visualization_msgs.msg import Marker, MarkerArray

from mtr_core import names
from mtr_core.conversions import goal_from
from mtr_core.problems import messages_of, problem_of
from mtr_core.se2 import Pose2
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose, MotionStatus, Problem, RobotMode, VelocityCommand
from mtr_msgs.msg import TestArea as AreaMessage

from .inputs import CollisionStop, DesiredMotion, DrawnArea, EstimatedCar, RobotState, SideSigmas, Zone
from .outputs import Path as PlannedPath
from .outputs import PlannerOutput
from .picture import PlanPicture

# Markers: line width, height above ground, arrow length, and colours by meaning.
LINE_M, HEIGHT_M, ARROW_M = 0.03, 0.02, 0.5
RED, GREEN, YELLOW = (0.9, 0.2, 0.1), (0.1, 0.9, 0.2), (1.0, 0.9, 0.1)
SLOW, FAST = (0.2, 0.4, 1.0), (1.0, 1.0, 1.0)


def desired_from(message: Optional[RobotMode], stamp_s: float) -> Optional[DesiredMotion]:
    """Return the motion that the state machine requests."""
    if message is None:
        return None
    # A robot on hold remains in its state, but must not drive.
    follows_waypoints = message.mode == RobotMode.FOLLOWING_WAYPOINT and not message.hold_id
    return DesiredMotion(stamp_s, goal_from(message), message.max_speed_mps, follows_waypoints)


def nav_goal_from(message: PoseStamped) -> Optional[Tuple[Pose2, bool]]:
    """Return the pose set in rviz, and True if it is in the Car's frame; None for a frame other than car and map."""
    frame, at, turned = message.header.frame_id, message.pose.position, message.pose.orientation
    if frame not in (names.CAR, names.MAP):
        return None
    return Pose2(at.x, at.y, 2.0 * math.atan2(turned.z, turned.w)), frame == names.CAR


def robot_from(message: Optional[LocalizedPose], stamp_s: float) -> Optional[RobotState]:
    """Return the state of the robot."""
    if message is None:
        return None
    return RobotState(stamp_s, message.valid, Pose2(message.x, message.y, message.heading),
                      message.speed_mps, message.yaw_rate_radps, problem_of(message.problems, message.message),
                      message.degenerate, *_pose_sigmas(message.covariance))


def car_from(message: Optional[CarEstimate], stamp_s: float) -> Optional[EstimatedCar]:
    """Return the estimated Car; before it is located, its outline is the prior."""
    if message is None:
        return None
    sides = SideSigmas(message.front_sigma, message.rear_sigma, message.left_sigma, message.right_sigma)
    return EstimatedCar(stamp_s, message.state == CarEstimate.LOCATED,
                        Pose2(message.x, message.y, message.heading),
                        tuple(zip(message.outline_x, message.outline_y)), sides,
                        _root(message.covariance[8]), (message.length or math.inf, message.width or math.inf))


def _pose_sigmas(covariance: Sequence[float]) -> Tuple[float, float]:
    """Return 1 sigma of the position in its least certain direction, m, and of the heading, rad; NaN if invalid."""
    xx, xy, yy = covariance[0], covariance[1], covariance[4]
    largest = 0.5 * (xx + yy) + math.hypot(0.5 * (xx - yy), xy)
    return _root(largest), _root(covariance[8])


def _root(variance: float) -> float:
    """Return 1 sigma; NaN, which stops the robot, for a value that is not a variance."""
    return math.sqrt(variance) if variance >= 0.0 else math.nan


def collision_stop_from(message: Optional[DriveStatus], stamp_s: float) -> Optional[CollisionStop]:
    """Return the state of drive control's collision stop."""
    if message is None:
        return None
    zone = Zone(message.zone) if message.zone in tuple(Zone) else Zone.BLOCKED
    return CollisionStop(stamp_s, zone, message.obstacle_m, message.obstacle_bearing,
                         problem_of(message.problems, message.message))


def area_from(message: AreaMessage) -> DrawnArea:
    """Return the Operator's test area."""
    return DrawnArea(tuple(zip(message.x, message.y)))


def velocity_message(output: PlannerOutput, header: Header) -> VelocityCommand:
    """Velocity for drive control."""
    header.frame_id = names.BASE
    return VelocityCommand(header, output.linear_mps, output.angular_radps, output.active)


def status_message(output: PlannerOutput, header: Header) -> MotionStatus:
    """Status for the state machine."""
    goal_id = output.goal_id
    return MotionStatus(header=header, requester=goal_id.requester, goal_id=goal_id.waypoint_id,
                        goal_attempt=goal_id.attempt, result=int(output.result), remaining_m=output.remaining_m,
                        message=output.message.text, replans=output.replans,
                        problems=messages_of(output.message, Problem))


def path_message(planned: PlannedPath, stamp: Any) -> Path:
    """Return the path for visualisation."""
    path = Path(header=Header(stamp=stamp, frame_id=names.CAR if planned.in_car_frame else names.MAP))
    for x, y in planned.points:
        pose = PoseStamped(header=path.header)
        pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = x, y, 1.0
        path.poses.append(pose)
    return path


def markers_message(picture: PlanPicture, stamp: Any) -> MarkerArray:
    """Return markers of the keep-out zone, trajectory (brighter means faster), reference pose and goal."""
    header = Header(stamp=stamp, frame_id=names.CAR if picture.in_car_frame else names.MAP)
    zone = _marker(header, "keep out", Marker.LINE_STRIP, RED)
    zone.points = [Point(x, y, HEIGHT_M) for x, y in picture.keep_out]
    way = _marker(header, "trajectory", Marker.LINE_STRIP, FAST)
    way.points = [Point(x, y, HEIGHT_M) for x, y, _ in picture.trajectory]
    top = max((speed for _, _, speed in picture.trajectory), default=0.0) or 1.0
    way.colors = [ColorRGBA(*(slow + speed / top * (fast - slow) for slow, fast in zip(SLOW, FAST)), 1.0)
                  for _, _, speed in picture.trajectory]
    arrows = [("goal", picture.goal, GREEN), ("reference", picture.reference, YELLOW)]
    return MarkerArray([zone, way, *(_arrow(header, name, pose, colour) for name, pose, colour in arrows)])


def _arrow(header: Header, name: str, pose: Optional[Pose2], colour: Tuple[float, float, float]) -> Marker:
    marker = _marker(header, name, Marker.ARROW, colour)
    if pose is None:
        marker.action = Marker.DELETE
        return marker
    marker.points = [Point(*pose.apply(x, 0.0), HEIGHT_M) for x in (0.0, ARROW_M)]
    marker.scale.y = 3.0 * LINE_M
    return marker


def _marker(header: Header, name: str, kind: int, colour: Tuple[float, float, float]) -> Marker:
    marker = Marker(header=header, ns=name, type=kind, action=Marker.ADD, color=ColorRGBA(*colour, 1.0))
    marker.pose.orientation.w, marker.scale.x = 1.0, LINE_M
    return marker
