"""The motion planner as a ROS node: topics in, velocity and status out, 25 times a second."""
# SPDX-License-Identifier: Apache-2.0

import rospy
from geometry_msgs.msg import PoseStamped
from nav_msgs.msg import Path
from std_msgs.msg import Header
from visualization_msgs.msg import MarkerArray

from mtr_core import names, schedule
from mtr_core.executors import InlineExecutor, ProcessesExecutor
from mtr_core.liveness import NS
from mtr_core.lockstep import Ticker, TickInput, publisher, run_node
from mtr_core.lockstep.clock import is_lockstep, stamp_of, steady_at
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose, MotionStatus, RobotMode, TestArea, VelocityCommand

from .conversions import (
    area_from,
    car_from,
    collision_stop_from,
    desired_from,
    markers_message,
    nav_goal_from,
    path_message,
    robot_from,
    status_message,
    velocity_message,
)
from .inputs import Inputs
from .nav_goal import NavGoals
from .parameters import MotionParameters
from .picture import picture_of
from .planner import MotionPlanner
from .search import planning

# Topic of rviz's tool "2D Nav Goal".
NAV_GOAL = "/move_base_simple/goal"
# Markers are published at one in this many ticks, 2.5 times a second.
MARKER_TICKS = 10
# A new plan does not wait for an obsolete one.
PLANS_AT_ONCE = 2


class MotionPlannerNode:
    """Feeds the planner at its ticks and publishes its outputs."""

    def __init__(self, parameters: MotionParameters):
        self._parameters = parameters
        # In lock-step, simulated time waits for the plan.
        executor = (InlineExecutor() if is_lockstep() else
                    ProcessesExecutor(PLANS_AT_ONCE, [planning.__name__], rospy.logwarn))
        self._planner = MotionPlanner(parameters, described_robot().footprint(), executor)
        self._ticker = Ticker(schedule.MOTION_PLANNER)
        self._pose = TickInput(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, lag_ns=0)
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        self._car = TickInput(names.CAR_ESTIMATE, CarEstimate, schedule.CAR_LOCATOR)
        self._drive = TickInput(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL)
        self._area = rospy.Subscriber(names.TEST_AREA, TestArea, self._take_area, queue_size=1)
        self._drawn = area_from(TestArea())
        self._velocity = publisher(names.PLANNER_VELOCITY, VelocityCommand)
        self._status = publisher(names.MOTION_STATUS, MotionStatus)
        self._path = rospy.Publisher(names.MOTION_PATH, Path, queue_size=1, latch=True)
        self._markers = rospy.Publisher(names.MOTION_MARKERS, MarkerArray, queue_size=1)
        self._nav_goals = NavGoals(parameters.nav_goal_speed_mps)
        if parameters.accept_nav_goal:
            self._nav_subscriber = rospy.Subscriber(NAV_GOAL, PoseStamped, self._take_nav_goal, queue_size=1)
        self._ticks = 0

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self.tick(self._ticker.sleep())

    def tick(self, tick_ns: int) -> None:
        """Run one step of the planner."""
        desired = self._nav_goals.joined(desired_from(self._mode.at(tick_ns), self._mode.stamp_s))
        refusal = self._nav_goals.refusal()
        if refusal:
            rospy.logwarn("%s", refusal)
        inputs = Inputs(steady_at(tick_ns) * NS, desired, robot_from(self._pose.at(tick_ns), self._pose.stamp_s),
                        car_from(self._car.at(tick_ns), self._car.stamp_s),
                        collision_stop_from(self._drive.at(tick_ns), self._drive.stamp_s), self._drawn)
        output = self._planner.step(inputs)
        stamp = stamp_of(tick_ns)
        self._velocity.publish(velocity_message(output, Header(stamp=stamp)))
        self._status.publish(status_message(output, Header(stamp=stamp)))
        if output.path is not None:
            self._path.publish(path_message(output.path, stamp))
        self._show(stamp)

    def _show(self, stamp: rospy.Time) -> None:
        """Publish the markers at some ticks, if there are subscribers."""
        self._ticks += 1
        if self._ticks % MARKER_TICKS == 0 and self._markers.get_num_connections():
            picture = picture_of(self._planner, self._parameters)
            if picture:
                self._markers.publish(markers_message(picture, stamp))

    def _take_area(self, message: TestArea) -> None:
        self._drawn = area_from(message)

    def _take_nav_goal(self, message: PoseStamped) -> None:
        goal = nav_goal_from(message)
        if goal is None:
            rospy.logwarn("A goal in frame %s is not taken; allowed are car and map.", message.header.frame_id)
        else:
            self._nav_goals.take(*goal)


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("motion_planner", MotionParameters, MotionPlannerNode)
