"""Between ROS messages and the planner's plain types."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Any, Optional

from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.se2 import Pose2
from mtr_core.states import Direction
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose, MotionStatus, RobotMode, VelocityCommand

from .inputs import Car, Drive, Goal, Order, RobotState, Zone
from .planner import Output
from .planner import Path as PlannedPath


def order_from(message: Optional[RobotMode]) -> Optional[Order]:
    """Order of the state machine."""
    if message is None:
        return None
    goal = message.goal
    direction = Direction(goal.direction) if goal.direction in tuple(Direction) else Direction.ANY
    # A frame that nobody knows is no place to go.
    known = goal.id == 0 or goal.frame_id in (names.CAR, names.MAP)
    pose = Pose2(goal.x, goal.y, goal.heading) if known else Pose2(math.nan, math.nan, math.nan)
    return Order(message.header.stamp.to_sec(), Goal(goal.id, goal.frame_id == names.CAR, pose, direction),
                 message.max_speed_mps)


def robot_from(message: Optional[LocalizedPose]) -> Optional[RobotState]:
    """State of the robot."""
    if message is None:
        return None
    return RobotState(message.header.stamp.to_sec(), message.valid, Pose2(message.x, message.y, message.heading),
                      message.speed_mps, message.yaw_rate_radps, message.message, message.degenerate)


def car_from(message: Optional[CarEstimate]) -> Optional[Car]:
    """The Car as estimated; its outline is the prior's before it is located."""
    if message is None:
        return None
    return Car(message.header.stamp.to_sec(), message.state == CarEstimate.LOCATED,
               Pose2(message.x, message.y, message.heading), tuple(zip(message.outline_x, message.outline_y)))


def drive_from(message: Optional[DriveStatus]) -> Optional[Drive]:
    """What the collision stop does."""
    if message is None:
        return None
    zone = Zone(message.zone) if message.zone in tuple(Zone) else Zone.BLOCKED
    return Drive(message.header.stamp.to_sec(), zone, message.obstacle_m, message.obstacle_bearing, message.message)


def velocity_message(output: Output, header: Header) -> VelocityCommand:
    """Velocity for drive control."""
    header.frame_id = names.BASE
    return VelocityCommand(header, output.linear_mps, output.angular_radps, output.active)


def status_message(output: Output, header: Header) -> MotionStatus:
    """Status for the state machine."""
    return MotionStatus(header, output.goal_id, int(output.result), output.remaining_m, output.message)


def path_message(planned: PlannedPath, stamp: Any) -> Path:
    """Path for people who look."""
    path = Path(header=Header(stamp=stamp, frame_id=names.CAR if planned.in_car_frame else names.MAP))
    for x, y in planned.points:
        pose = PoseStamped(header=path.header)
        pose.pose.position.x, pose.pose.position.y, pose.pose.orientation.w = x, y, 1.0
        path.poses.append(pose)
    return path
