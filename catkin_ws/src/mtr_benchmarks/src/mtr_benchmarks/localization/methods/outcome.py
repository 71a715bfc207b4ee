"""What one method makes of one drive."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, NamedTuple, Optional

from .errors import PoseErrors

THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP = "this_system", "odometry_gyro", "mrpt_icp"
METHODS = (THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP)


@dataclass(frozen=True)
class CarErrors:
    """How the Car was found; names are those of the file.

    Attributes:
        position_error_m, along_error_m, across_error_m, yaw_error_deg: of its pose in the adjusted map.
        length_error_m, width_error_m: of what was measured in the LiDARs' plane; _plane_sigma_m: their sigmas.
        length_error_body_m, width_error_body_m: of what was published against the widest parts; _sigma_m: their sigmas.
        sigmas: of the pose, along and across the Car and of its heading; m and rad.
        only_wheels: the LiDARs' plane meets no body.
        warning: of the Car locator.
        key_frame_rmse_m: what the key frames are off among themselves, which is localization's error.
    """

    position_error_m: float
    along_error_m: float
    across_error_m: float
    yaw_error_deg: float
    length_error_m: float
    width_error_m: float
    length_plane_sigma_m: float
    width_plane_sigma_m: float
    length_error_body_m: float
    width_error_body_m: float
    length_sigma_m: float
    width_sigma_m: float
    sigmas: List[float]
    only_wheels: bool
    warning: str
    key_frame_rmse_m: float


class MethodOutcome(NamedTuple):
    """What one method made of one drive.

    Attributes:
        errors: of the key after the loop.
        cpu_ms_per_scan: CPU time.
        car: how the Car was found; None from a method that finds none.
    """

    errors: PoseErrors
    cpu_ms_per_scan: float
    car: Optional[CarErrors] = None
