"""Result of one method in one drive."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import List, NamedTuple, Optional

from .errors import PoseErrors

THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP = "this_system", "odometry_gyro", "mrpt_icp"
METHODS = (THIS_SYSTEM, ODOMETRY_GYRO, MRPT_ICP)


@dataclass(frozen=True)
class CarErrors:
    """Errors of the located Car; the names are those in the file.

    Attributes:
        position_error_m, along_error_m, across_error_m, yaw_error_deg: errors of its pose in the adjusted map.
        length_error_m, width_error_m: errors of the size in the LiDAR plane; _plane_sigma_m: their sigmas.
        length_error_body_m, width_error_body_m: errors of the published size against the widest parts; _sigma_m: their
            sigmas.
        sigmas: sigmas of the pose, along and across the Car and of its heading; m and rad.
        only_wheels: the LiDAR plane does not meet the body.
        warning: warning of the Car locator.
        key_frame_rmse_m: errors of the key frames relative to each other, which localization causes.
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
    """Result of one method in one drive.

    Attributes:
        errors: errors of the key after the loop.
        cpu_ms_per_scan: CPU time.
        car: errors of the located Car; None if the method does not locate it.
    """

    errors: PoseErrors
    cpu_ms_per_scan: float
    car: Optional[CarErrors] = None
