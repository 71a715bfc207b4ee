"""By how much the simulated robot is wrong about its key's place: each part of the budget of docs/accuracy.md."""
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
    """Errors as they are, what the robot believes less what is true, and what it tells of them.

    All but line_m are the same for the whole test. Names of the calibration record are those of default.yaml.
    """

    PREFIX = "errors."

    position_x_m: float = number(0.0, -1.0, 1.0, "m")  # of base_link in the Car's frame: localization, Car locator
    position_y_m: float = number(0.0, -1.0, 1.0, "m")
    heading_rad: float = number(0.0, -0.2, 0.2, "rad")  # lidar_yaw_deg: the robot looks beside where it thinks
    mast_lean_rad: float = number(0.0, -0.2, 0.2, "rad")  # mast_lean_deg: forward, times the key's height
    floor_slope_rad: float = number(0.0, -0.2, 0.2, "rad")  # floor_slope_deg: down towards the Car's front
    key_lever_m: float = number(0.0, -0.2, 0.2, "m")  # key_lever_m: the key is nearer to base_link than is known
    inset_m: float = number(0.0, -0.2, 0.2, "m")  # each side of the Car stands back so far in the LiDARs' plane
    clock_s: float = number(0.0, -0.3, 0.3, "s")  # what the bus tells is taken for so much later
    line_m: float = number(0.002, 0.0, 0.5, "m")  # 1 sigma of the position along x and y, anew for each line
    told_position_m: float = number(0.003, 0.0005, 0.5, "m")  # 1 sigma as the robot tells it
    told_heading_rad: float = number(0.002, 0.0001, 0.2, "rad")
    # Twice that of a line: both sides stand back alike, see "Limits" of docs/accuracy.md.
    told_car_m: float = number(0.07, 0.001, 1.0, "m")

    def world(self, length_m: float, width_m: float) -> VirtualWorld:
        """What the robot believes of a Car of this size."""
        return VirtualWorld(length_m - 2.0 * self.inset_m, width_m - 2.0 * self.inset_m, starting_s=0.0, mapping_s=0.0,
                            position_sigma_m=self.told_position_m, heading_sigma_rad=self.told_heading_rad,
                            car_sigma_m=self.told_car_m)

    def true_key(self, believed: Pose, key_x_m: float, height_m: float, line: tuple[float, float]) -> Point:
        """Where the key truly is, x, y, z in the true Car's frame. line: error of the line at hand, x and y in m."""
        heading = believed.heading - self.heading_rad
        ahead_m = key_x_m - self.key_lever_m + height_m * self.mast_lean_rad
        return (believed.x - self.position_x_m - line[0] + height_m * self.floor_slope_rad
                + math.cos(heading) * ahead_m,
                believed.y - self.position_y_m - line[1] + math.sin(heading) * ahead_m, height_m)
