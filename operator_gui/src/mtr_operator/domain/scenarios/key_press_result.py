"""What Key press records of one radial."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from dataclasses import dataclass

from ..results.carried import CAUSE_DOC, HEADING_DOC, HEIGHT_DOC, LATERAL_DOC, SPEED_DOC
from ..results.document import OptionalFloat, Texts
from ..results.line_result import LineResult, LineStatus, MeasuredDistance, column, stored

PRESS = "press"


@dataclass(frozen=True)
class KeyPressResult(LineResult):
    """Distances are those of the Remote key from the Car's centre, along the radial."""

    FILE_ORDER = ("radial", "angle_deg", "status", "distance_m", "uncertainty_m", "robot_time_s", "failed_distance_m",
                  "attempts", "reason", "lateral_offset_m", "heading_offset_deg", "key_height_m", "speed_mps", "cause",
                  "evidence")

    radial: int = column("number of the radial, clockwise from the Car's front")
    angle_deg: float = column("angle of the radial, clockwise from the Car's front", "deg", digits=3)
    status: LineStatus = column("ok, not_reached or invalid")
    distance_m: OptionalFloat = column("Remote key from the Car's centre at the farthest press that worked", "m")
    failed_distance_m: OptionalFloat = column(
        "the next farther place that failed, empty if none; with not_reached the nearest place that failed", "m")
    uncertainty_m: OptionalFloat = column("1 sigma of the distance", "m")
    attempts: int = column("presses on this radial")
    robot_time_s: OptionalFloat = column(
        "robot's clock when the button of the press that worked went down", "s", digits=3)
    reason: str = stored()
    lateral_offset_m: OptionalFloat = column(f"{LATERAL_DOC} at the press that worked", "m", default=None)
    heading_offset_deg: OptionalFloat = column(f"{HEADING_DOC} at the press that worked", "deg", 2, None)
    key_height_m: OptionalFloat = column(f"{HEIGHT_DOC} at the press that worked", "m", default=None)
    speed_mps: OptionalFloat = column(f"{SPEED_DOC} at the press that worked", "m/s", default=None)
    cause: str = column(f"what the Car obeyed: {CAUSE_DOC}", default="")
    evidence: Texts = stored(())

    @property
    def number(self) -> int:
        """See LineResult."""
        return self.radial

    @property
    def place(self) -> str:
        """See LineResult."""
        return f"{self.angle_deg:g}\N{DEGREE SIGN}"

    @property
    def distances(self) -> tuple[MeasuredDistance, ...]:
        """See LineResult."""
        return (MeasuredDistance(PRESS, self.status, self.distance_m, self.uncertainty_m),)
