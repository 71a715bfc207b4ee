"""Errors of the key position that the simulated robot believes, one for each part of the budget in docs/accuracy.md."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.robot_link.virtual.robot import VirtualWorld

Point = tuple[float, float, float]


@dataclass(frozen=True)
class RadioErrors(ParameterSet):
    """Errors (believed less true values), and the uncertainties that the robot reports.

    All except line_m are constant during a test. Names of the calibration record are those in default.yaml.
    """

    PREFIX = "errors."

    position_x_m: float = number(0.0, -1.0, 1.0, "m")  # of base_link in the Car's frame: localization, Car locator
    position_y_m: float = number(0.0, -1.0, 1.0, "m")
    heading_rad: float = number(0.0, -0.2, 0.2, "rad")  # lidar_yaw_deg: mounting yaw of the LiDAR
    mast_lean_rad: float = number(0.0, -0.2, 0.2, "rad")  # mast_lean_deg: forward, times the key's height
    floor_slope_rad: float = number(0.0, -0.2, 0.2, "rad")  # floor_slope_deg: down towards the Car's front
    # key_lever_m: the key is this much nearer to base_link than specified
    key_lever_m: float = number(0.0, -0.2, 0.2, "m")
    inset_m: float = number(0.0, -0.2, 0.2, "m")  # recess of each side of the Car in the scan plane
    clock_s: float = number(0.0, -0.3, 0.3, "s")  # delay that is added to the time stamps of bus events
    line_m: float = number(0.002, 0.0, 0.5, "m")  # 1 sigma of the position along x and y, drawn for each line
    told_position_m: float = number(0.003, 0.0005, 0.5, "m")  # 1 sigma reported by the robot
    told_heading_rad: float = number(0.002, 0.0001, 0.2, "rad")
    # Twice the value of a line, because both sides have the same recess; see "Limits" in docs/accuracy.md.
    told_car_m: float = number(0.07, 0.001, 1.0, "m")

    def world(self, length_m: float, width_m: float) -> VirtualWorld:
        """Return the world as believed by the robot, for a Car of this size."""
        return VirtualWorld(length_m - 2.0 * self.inset_m, width_m - 2.0 * self.inset_m, starting_s=0.0, mapping_s=0.0,
                            position_sigma_m=self.told_position_m, heading_sigma_rad=self.told_heading_rad,
                            car_sigma_m=self.told_car_m)

    def true_key(self, believed: Pose, key_x_m: float, height_m: float, line: tuple[float, float]) -> Point:
        """Return the true key position x, y, z in the true Car's frame.

        line: error on the current line, x and y in m.
        """
        heading = believed.heading - self.heading_rad
        ahead_m = key_x_m - self.key_lever_m + height_m * self.mast_lean_rad
        return (believed.x - self.position_x_m - line[0] + height_m * self.floor_slope_rad
                + math.cos(heading) * ahead_m,
                believed.y - self.position_y_m - line[1] + math.sin(heading) * ahead_m, height_m)
