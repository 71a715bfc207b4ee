"""ROS node of the car locator. Inputs: poses, scans and maps; outputs: the Car, and orders to the mapper."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
from concurrent.futures import Executor, ThreadPoolExecutor
from dataclasses import replace
from typing import Optional, Tuple

import rospy
import tf2_ros
from visualization_msgs.msg import MarkerArray

from mtr_core import names, schedule
from mtr_core.conversions import goal_report_from
from mtr_core.executors import InlineExecutor, ProcessExecutor
from mtr_core.lockstep import Ticker, TickInput, publisher, run_node
from mtr_core.lockstep.clock import is_held, stamp_of
from mtr_core.se2 import Pose2
from mtr_core.states import CarState
from mtr_description.robot_description import described_robot
from mtr_msgs.msg import CarCheck, CarEstimate, MappingOrder, MotionStatus, RobotMode

from .conversions import (
    check_message,
    estimate_message,
    mapping_message,
    markers_message,
    task_from,
    transform_message,
)
from .drawing import shapes_of
from .estimate import Estimate, Inputs
from .locator import CarLocator
from .memory.keeper import CarKeeper
from .memory.memory_file import MemoryFile
from .parameters import LocatorParameters
from .rectangle import Rectangle
from .sensors import MapSource, PoseSource, ScanSource
from .steps import LocatorSteps
from .survey import survey


class CarLocatorNode:
    """Feeds the locator at its ticks and publishes its estimates."""

    def __init__(self, parameters: LocatorParameters):
        lidars = described_robot().lidars(parameters.rear_lidar)
        self._parameters = parameters
        # In lock-step and in a replay, the clock waits for the fit; otherwise, ticks are not delayed by any step.
        executor, fits = _executors()
        self._keeper = CarKeeper(_memory_file(parameters.memory_folder), ThreadPoolExecutor(1), rospy.logwarn)
        self._steps = LocatorSteps(CarLocator(parameters, self._keeper.read(), fits), executor)
        self._ticker = Ticker(schedule.CAR_LOCATOR)
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        self._drive = TickInput(names.MOTION_STATUS, MotionStatus, schedule.MOTION_PLANNER)
        self._poses, self._scans, self._maps = PoseSource(), ScanSource(
            lidars, parameters.time_increment_s), MapSource()
        self._shown: Optional[Tuple[CarState, Rectangle, Tuple[Pose2, ...]]] = None
        self._said = ("", 0)
        self._estimates = publisher(names.CAR_ESTIMATE, CarEstimate)
        self._checks = publisher(names.CAR_CHECK, CarCheck)
        self._orders = publisher(names.MAPPING_ORDER, MappingOrder)
        self._markers = rospy.Publisher(names.CAR_MARKERS, MarkerArray, queue_size=1, latch=True)
        self._frames = tf2_ros.TransformBroadcaster()

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self.tick(self._ticker.sleep())

    def tick(self, tick_ns: int) -> None:
        """Publish the present estimate of the Car."""
        poses = self._poses.take(tick_ns)
        inputs = Inputs(tick_ns * 1e-9, task_from(self._mode.at(tick_ns)), goal_report_from(self._drive.at(tick_ns)))
        scans = self._scans.take(tick_ns, self._steps.wants_scans(inputs, poses))
        surfaces = self._maps.at(tick_ns, self._poses.map_revision)
        self._publish(self._steps.estimate(replace(inputs, scans=scans, surfaces=surfaces)), tick_ns)

    def _publish(self, estimate: Estimate, tick_ns: int) -> None:
        stamp = stamp_of(tick_ns)
        self._estimates.publish(estimate_message(estimate, stamp))
        self._checks.publish(check_message(estimate, self._parameters.refinement, stamp))
        self._orders.publish(mapping_message(estimate, stamp))
        if estimate.state == CarState.LOCATED:
            self._frames.sendTransform(transform_message(estimate, stamp))
        shown = (estimate.state, estimate.rectangle, estimate.places)
        if shown != self._shown:
            self._shown = shown
            self._markers.publish(markers_message(shapes_of(estimate), stamp))
        self._say(estimate)
        self._keeper.note(estimate)

    def _say(self, estimate: Estimate) -> None:
        """Log each new sentence once; a change or loss of the frame is a warning to the Operator."""
        said = (estimate.message.text, estimate.revision)
        if said == self._said or not estimate.message:
            return
        was_corrected = estimate.revision > 1 and estimate.state == CarState.LOCATED and estimate.correction.x
        log = rospy.logwarn if was_corrected or estimate.state == CarState.FAILED else rospy.loginfo
        log("%s", estimate.message)
        if estimate.fit and estimate.fit.warning and estimate.revision != self._said[1]:
            rospy.logwarn("%s", estimate.fit.warning)
        self._said = said


def _executors() -> Tuple[Executor, Executor]:
    """Return the executors of the locator's steps and of their fits."""
    if is_held():
        return InlineExecutor(), InlineExecutor()
    return ThreadPoolExecutor(1), ProcessExecutor([survey.__name__], rospy.logwarn)


def _memory_file(folder: str) -> Optional[MemoryFile]:
    # Without roslaunch, the run is unknown. /run_id lasts as long as the ROS master, which may outlive a start of the
    # robot.
    run_id = rospy.get_param(names.ROBOT_RUN, rospy.get_param("/run_id", ""))
    return MemoryFile(pathlib.Path(folder) / "car_locator.json", run_id) if folder and run_id else None


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("car_locator", LocatorParameters, CarLocatorNode)
