"""The motion planner as a ROS node: topics in, velocity and status out, 25 times a second."""
# SPDX-License-Identifier: Apache-2.0
import rospy
from nav_msgs.msg import Path
from std_msgs.msg import Header

from mtr_core import names, schedule
from mtr_lockstep import Ticker, TickInput, publisher, run_node
from mtr_lockstep.clock import stamp_of
from mtr_msgs.msg import CarEstimate, DriveStatus, LocalizedPose, MotionStatus, RobotMode, VelocityCommand

from .conversions import car_from, drive_from, order_from, path_message, robot_from, status_message, velocity_message
from .inputs import Inputs
from .parameters import MotionParameters
from .planner import MotionPlanner


class MotionPlannerNode:
    """Feeds the planner at its ticks and publishes what it says."""

    def __init__(self, parameters: MotionParameters):
        self._planner = MotionPlanner(parameters)
        self._ticker = Ticker(schedule.MOTION_PLANNER)
        self._pose = TickInput(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, lag_ns=0)
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        self._car = TickInput(names.CAR_ESTIMATE, CarEstimate, schedule.CAR_LOCATOR)
        self._drive = TickInput(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL)
        self._velocity = publisher(names.PLANNER_VELOCITY, VelocityCommand)
        self._status = publisher(names.MOTION_STATUS, MotionStatus)
        self._path = rospy.Publisher(names.MOTION_PATH, Path, queue_size=1, latch=True)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self.tick(self._ticker.sleep())

    def tick(self, tick_ns: int) -> None:
        """One step of the planner."""
        inputs = Inputs(tick_ns * 1e-9, order_from(self._mode.at(tick_ns)), robot_from(self._pose.at(tick_ns)),
                        car_from(self._car.at(tick_ns)), drive_from(self._drive.at(tick_ns)))
        output = self._planner.step(inputs)
        stamp = stamp_of(tick_ns)
        self._velocity.publish(velocity_message(output, Header(stamp=stamp)))
        self._status.publish(status_message(output, Header(stamp=stamp)))
        if output.path is not None:
            self._path.publish(path_message(output.path, stamp))


def main() -> int:
    """Run the node; its exit status."""
    return run_node("motion_planner", MotionParameters, MotionPlannerNode)
