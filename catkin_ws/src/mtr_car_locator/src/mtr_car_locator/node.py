"""The car locator as a ROS node: scans and poses in, the Car's estimate, frame and markers out, 10 times a second."""
# SPDX-License-Identifier: Apache-2.0
from typing import Optional

import rospy
import tf2_ros
from visualization_msgs.msg import MarkerArray

from mtr_core import names, schedule
from mtr_core.states import CarState
from mtr_lockstep import Ticker, TickInput, publisher, run_node
from mtr_lockstep.clock import stamp_of
from mtr_msgs.msg import CarEstimate, RobotMode

from .conversions import estimate_message, markers_message, order_from, transform_message
from .locator import CarLocator, Estimate
from .parameters import LocatorParameters
from .sensors import MappingSources, PoseSource


class CarLocatorNode:
    """Feeds the locator at its ticks and publishes what it says."""

    def __init__(self, parameters: LocatorParameters):
        self._parameters = parameters
        self._locator = CarLocator(parameters)
        self._ticker = Ticker(schedule.CAR_LOCATOR)
        self._mode = TickInput(names.ROBOT_MODE, RobotMode, schedule.STATE_MACHINE)
        self._poses = PoseSource(self._locator)
        self._mapping: Optional[MappingSources] = None
        self._shown = None
        self._estimates = publisher(names.CAR_ESTIMATE, CarEstimate)
        self._markers = rospy.Publisher(names.CAR_MARKERS, MarkerArray, queue_size=1, latch=True)
        self._frames = tf2_ros.TransformBroadcaster()

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self.tick(self._ticker.sleep())

    def tick(self, tick_ns: int) -> None:
        """One step of the locator."""
        order = order_from(self._mode.at(tick_ns))
        wants_scans = self._locator.wants_scans(order)
        self._poses.feed(tick_ns, self._locator.needs_poses or wants_scans)
        self._listen(wants_scans)
        scans = self._mapping.scans(tick_ns) if self._mapping else []
        drive = self._mapping.drive(tick_ns) if self._mapping else None
        self._publish(self._locator.step(tick_ns * 1e-9, order, drive, scans), tick_ns)

    def _listen(self, wanted: bool) -> None:
        if wanted and self._mapping is None:
            self._mapping = MappingSources(self._parameters)
        if not wanted and self._mapping is not None:
            self._mapping.close()
            self._mapping = None

    def _publish(self, estimate: Estimate, tick_ns: int) -> None:
        stamp = stamp_of(tick_ns)
        self._estimates.publish(estimate_message(estimate, stamp))
        if estimate.state == CarState.LOCATED:
            self._frames.sendTransform(transform_message(estimate, stamp))
        shown = (estimate.state, estimate.rectangle)
        if shown != self._shown:
            self._shown = shown
            self._markers.publish(markers_message(estimate, stamp))


def main() -> int:
    """Run the node; its exit status."""
    return run_node("car_locator", LocatorParameters, CarLocatorNode)
