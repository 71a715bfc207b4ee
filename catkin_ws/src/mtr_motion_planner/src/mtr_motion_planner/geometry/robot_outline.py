"""The robot in plan view, relative to its turn centre."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_description.mounts import Footprint

from ..parameters import Slip


@dataclass(frozen=True)
class RobotOutline:
    """The robot's rectangle at poses of its turn centre.

    Attributes:
        footprint: outline in base_link from the URDF.
        slip: contains the turn centre.
    """

    footprint: Footprint
    slip: Slip

    @property
    def front_m(self) -> float:
        """Distance from the turn centre to the front, where the key is."""
        return self.footprint.front_m - self.slip.turn_centre_x_m

    @property
    def rear_m(self) -> float:
        """Distance from the turn centre to the rear."""
        return self.footprint.rear_m + self.slip.turn_centre_x_m

    @property
    def half_width_m(self) -> float:
        """Distance from the turn centre to a side."""
        return self.footprint.half_width_m

    @property
    def radius_m(self) -> float:
        """Radius about the turn centre of the area swept by a turn on the spot."""
        return self.footprint.radius_m(self.slip.turn_centre_x_m)
