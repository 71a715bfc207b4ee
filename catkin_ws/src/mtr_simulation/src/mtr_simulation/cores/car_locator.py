"""The Car locator between its core and the other parts, as mtr_car_locator's node."""
# SPDX-License-Identifier: Apache-2.0
import collections
from dataclasses import replace
from typing import Callable, Deque, List, Optional, Tuple

from mtr_car_locator.conversions import check_message, estimate_message, mapping_message, robot_pose_from, task_from
from mtr_car_locator.estimate import Inputs
from mtr_car_locator.locator import CarLocator
from mtr_car_locator.parameters import LocatorParameters
from mtr_car_locator.poses import RobotPose
from mtr_car_locator.scan import Scan as LocatorScan
from mtr_car_locator.steps import SCAN_LAG_NS, LocatorSteps, ScanWindow, is_map_due
from mtr_car_locator.survey.surface_map import SurfaceMap
from mtr_core.conversions import goal_report_from
from mtr_core.executors import InlineExecutor
from mtr_core.liveness import NS
from mtr_core.schedule import CAR_LOCATOR
from mtr_core.se2 import Pose2
from mtr_description.mounts import LidarMounts
from mtr_msgs.msg import LocalizedPose, MappingOrder
from mtr_simulation.sensors.readings import Scan, Sensors

from . import wire
from .topics import Topics


class CarLocatorPart:
    """Says at each tick what is known of the Car."""

    slot = CAR_LOCATOR

    def __init__(self, topics: Topics, parameters: LocatorParameters, lidars: LidarMounts,
                 order: Callable[[MappingOrder], None]):
        """order: takes what localization's mapper shall do."""
        assert lidars.rear is not None
        self._steps = LocatorSteps(CarLocator(parameters), InlineExecutor())
        self._topics, self._parameters, self._order = topics, parameters, order
        self._mounts = (lidars.front, lidars.rear)
        self._mode, self._drive = topics.mode.input(), topics.motion.input()
        self._poses: List[LocalizedPose] = []
        self._scans: Tuple[Deque[Scan], ...] = (collections.deque(), collections.deque())
        self._window = ScanWindow()
        self._map: Optional[Tuple[SurfaceMap, int]] = None
        self._map_revision = 0

    def take_pose(self, message: LocalizedPose) -> None:
        """Each one counts."""
        self._poses.append(message)

    def sense(self, sensors: Sensors) -> None:
        """Sensors as they come over the wire."""
        for waiting, scan in zip(self._scans, (sensors.front_scan, sensors.rear_scan)):
            if scan is not None:
                waiting.append(scan)

    def take_map(self, surfaces: SurfaceMap, stamp_ns: int) -> None:
        """From localization."""
        self._map = surfaces, stamp_ns

    def step(self, tick_ns: int) -> None:
        """One tick."""
        poses = self._new_poses()
        inputs = Inputs(tick_ns * NS, task_from(self._mode.at(tick_ns)), goal_report_from(self._drive.at(tick_ns)))
        scans = self._new_scans(tick_ns, self._steps.wants_scans(inputs, poses))
        estimate = self._steps.estimate(replace(inputs, scans=scans, surfaces=self._surfaces(tick_ns)))
        stamp = wire.stamp(tick_ns)
        self._topics.car.publish(estimate_message(estimate, stamp))
        self._topics.check.publish(check_message(estimate, self._parameters.refinement, stamp))
        self._order(mapping_message(estimate, stamp))

    def _new_poses(self) -> List[RobotPose]:
        valid = [message for message in self._poses if message.valid]
        self._poses.clear()
        if valid:
            self._map_revision = valid[-1].map_revision
        return [robot_pose_from(message) for message in valid]

    def _new_scans(self, tick_ns: int, wanted: bool) -> List[LocatorScan]:
        self._window.follow(tick_ns, wanted)
        found = []
        for is_rear, (waiting, mount) in enumerate(zip(self._scans, self._mounts)):
            while waiting and (not wanted or waiting[0].stamp_ns <= tick_ns - SCAN_LAG_NS):
                scan = waiting.popleft()
                if self._window.counts(scan.stamp_ns):
                    found.append(_scan(scan, mount, bool(is_rear)))
        return found

    def _surfaces(self, tick_ns: int) -> Optional[SurfaceMap]:
        if self._map is None:
            return None
        surfaces, stamp_ns = self._map
        is_due = is_map_due(stamp_ns, tick_ns) or surfaces.revision == self._map_revision
        return surfaces if is_due else None


def _scan(scan: Scan, mount: Pose2, is_rear: bool) -> LocatorScan:
    return LocatorScan(scan.stamp_ns * NS, scan.time_increment_s, scan.angle_min_rad, scan.angle_increment_rad,
                       scan.range_min_m, scan.range_max_m, scan.ranges_m, mount, is_rear)
