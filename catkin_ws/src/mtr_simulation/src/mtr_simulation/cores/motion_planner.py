"""The motion planner between its core and the other parts, as mtr_motion_planner's node."""
# SPDX-License-Identifier: Apache-2.0
from std_msgs.msg import Header

from mtr_core.executors import InlineExecutor
from mtr_core.liveness import NS
from mtr_core.schedule import MOTION_PLANNER
from mtr_description.mounts import Footprint
from mtr_motion_planner.conversions import (
    car_from,
    collision_stop_from,
    desired_from,
    robot_from,
    status_message,
    velocity_message,
)
from mtr_motion_planner.inputs import Inputs
from mtr_motion_planner.parameters import MotionParameters
from mtr_motion_planner.planner import MotionPlanner

from . import wire
from .topics import Topics


class MotionPlannerPart:
    """Plans and follows at each tick."""

    slot = MOTION_PLANNER

    def __init__(self, topics: Topics, parameters: MotionParameters, footprint: Footprint):
        self._core, self._topics = MotionPlanner(parameters, footprint, InlineExecutor()), topics
        self._pose, self._mode = topics.pose.input(lag_ns=0), topics.mode.input()
        self._car, self._drive = topics.car.input(), topics.drive.input()

    def step(self, tick_ns: int) -> None:
        """One tick."""
        mode, pose, car, drive = (each.at(tick_ns) for each in (self._mode, self._pose, self._car, self._drive))
        output = self._core.step(Inputs(
            tick_ns * NS, desired_from(mode, self._mode.stamp_s), robot_from(pose, self._pose.stamp_s),
            car_from(car, self._car.stamp_s), collision_stop_from(drive, self._drive.stamp_s)))
        stamp = wire.stamp(tick_ns)
        self._topics.velocity.publish(velocity_message(output, Header(stamp=stamp)))
        self._topics.motion.publish(status_message(output, Header(stamp=stamp)))
