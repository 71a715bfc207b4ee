"""What Autolock records of one axis."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..geometry.ray import Ray
from ..results.carried import CAUSE_DOC, HEADING_DOC, HEIGHT_DOC, LATERAL_DOC, SPEED_DOC
from ..results.document import OptionalFloat, Texts
from ..results.line_result import LineResult, LineStatus, MeasuredDistance, column, stored

UNLOCK, LOCK = "unlock", "lock"


@dataclass(frozen=True)
class AutolockResult(LineResult):
    """Distances are those of the Remote key from the Car's side or corner, along the axis."""

    FILE_ORDER = ("axis", "side", "origin_x_m", "origin_y_m", "direction_x", "direction_y", "reason",
                  "unlock_distance_m", "unlock_uncertainty_m", "unlock_robot_time_s", "unlock_status",
                  "lock_distance_m", "lock_uncertainty_m", "lock_robot_time_s", "lock_status",
                  "unlock_lateral_offset_m", "unlock_heading_offset_deg", "unlock_key_height_m", "unlock_speed_mps",
                  "unlock_cause", "lock_lateral_offset_m", "lock_heading_offset_deg", "lock_key_height_m",
                  "lock_speed_mps", "lock_cause", "evidence")

    axis: int = column("number of the axis, clockwise around the Car")
    side: str = column("side or corner of the Car that the axis belongs to")
    origin_x_m: float = column("origin of the axis, Car coordinate system", "m")
    origin_y_m: float = column("origin of the axis, Car coordinate system", "m")
    direction_x: float = column("unit vector of the axis away from the Car", digits=6)
    direction_y: float = column("unit vector of the axis away from the Car", digits=6)
    unlock_status: LineStatus = column("ok, not_reached or invalid")
    unlock_distance_m: OptionalFloat = column("Remote key from the Car's side or corner when the Car unlocked", "m")
    unlock_uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    unlock_robot_time_s: OptionalFloat = column("robot's clock when the Car unlocked", "s", digits=3)
    lock_status: LineStatus = column("ok, not_reached or invalid")
    lock_distance_m: OptionalFloat = column("Remote key from the Car's side or corner when the Car locked", "m")
    lock_uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    lock_robot_time_s: OptionalFloat = column("robot's clock when the Car locked", "s", digits=3)
    reason: str = stored()
    unlock_lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} when the Car unlocked", "m", default=None)
    unlock_heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} when the Car unlocked", "deg", 2, None)
    unlock_key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} when the Car unlocked", "m", default=None)
    unlock_speed_mps: OptionalFloat = column(f"{SPEED_DOC} when the Car unlocked", "m/s", default=None)
    unlock_cause: str = column(f"what unlocked the Car: {CAUSE_DOC}", default="")
    lock_lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} when the Car locked", "m", default=None)
    lock_heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} when the Car locked", "deg", 2, None)
    lock_key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} when the Car locked", "m", default=None)
    lock_speed_mps: OptionalFloat = column(f"{SPEED_DOC} when the Car locked", "m/s", default=None)
    lock_cause: str = column(f"what locked the Car: {CAUSE_DOC}", default="")
    evidence: Texts = stored(())

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.axis

    @property
    def place(self) -> str:
        """See LineResult."""
        return self.side.replace("_", " ")

    @property
    def ray(self) -> Ray:
        """The axis."""
        return Ray(self.origin_x_m, self.origin_y_m, self.direction_x, self.direction_y)

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult."""
        return (MeasuredDistance(UNLOCK, self.unlock_status, self.unlock_distance_m, self.unlock_uncertainty_m),
                MeasuredDistance(LOCK, self.lock_status, self.lock_distance_m, self.lock_uncertainty_m))
