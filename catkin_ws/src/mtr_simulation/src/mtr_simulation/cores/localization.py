"""Localization between its core and the other parts, as mtr_localization's node."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Callable, List

import numpy as np
from mtr_localization_core import Estimate, Localizer, MapResult
from std_msgs.msg import Header

from mtr_car_locator.scan import RangeBias
from mtr_car_locator.surfels import surfels_from
from mtr_car_locator.survey.surface_map import SurfaceMap
from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.problems import problem_of
from mtr_msgs.msg import LocalizedPose, MappingOrder
from mtr_simulation.sensors.readings import Sensors

from . import wire
from .topics import Topics


class LocalizationPart:
    """Answers the sensors of each tick."""

    def __init__(self, topics: Topics, urdf: str, take_map: Callable[[SurfaceMap, int], None]):
        """take_map: gets each new map with its stamp in ns, before the first pose that is in it."""
        self._topics, self._take_map = topics, take_map
        self._core = Localizer(urdf)

    def begin(self, start_ns: int) -> None:
        """The clock has started, and no sensor has spoken yet."""
        self._publish(self._core.check_silence(start_ns))

    def step(self, sensors: Sensors) -> None:
        """Sensors as they come over the wire."""
        for is_rear, scan in enumerate((sensors.front_scan, sensors.rear_scan)):
            if scan is not None:
                self._core.add_scan(bool(is_rear), scan)
        self._publish(self._core.step(sensors.time_ns, sensors.imu, sensors.odometry))
        self._publish(self._core.check_silence(sensors.time_ns))

    def take_order(self, order: MappingOrder) -> None:
        """From the Car locator."""
        self._core.add_order(order.header.stamp.to_nsec(), order.map_car_id, order.phase)

    def _publish(self, estimates: List[Estimate]) -> None:
        made = self._core.take_map()
        if made is not None:
            self._take_map(surface_map(made), made.stamp_ns)
        for estimate in estimates:
            self._topics.pose.publish(pose_message(estimate))


def pose_message(estimate: Estimate) -> LocalizedPose:
    """As message_of of mtr_localization."""
    return LocalizedPose(
        header=Header(0, wire.stamp(estimate.stamp_ns), names.MAP),
        valid=estimate.valid, x=estimate.x_m, y=estimate.y_m, heading=estimate.heading_rad,
        covariance=estimate.covariance, speed_mps=estimate.speed_mps, yaw_rate_radps=estimate.yaw_rate_radps,
        message=estimate.message, problems=wire.problems(estimate.problems), mode=estimate.mode,
        degenerate=estimate.degenerate, map_revision=estimate.map_revision,
        origin_id=estimate.origin_id)


def surface_map(made: MapResult) -> SurfaceMap:
    """As the Car locator reads it of a SurfaceMap."""
    frames: Any = np.array([(stamp_ns * NS, x, y, heading) for stamp_ns, x, y, heading in made.key_frames])
    front_m, rear_m = made.range_bias_m
    return SurfaceMap(made.map_car_id, made.revision, made.valid, surfels_from(wire.surfaces(made.surfels)),
                      frames.reshape(-1, 4), problem_of(wire.problems(made.problems), made.message),
                      RangeBias(front_m, rear_m))
