"""Requirements of the nodes on a URDF, as independent checks, so that all missing parts are reported at once."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Dict, Iterator, List, Tuple

from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_description.mounts import Mount
from mtr_description.robot_geometry import RobotGeometry
from mtr_motion_check.finding import Finding, bad, good

from .balance import balance_parameters

DESCRIPTION = "contract.description"
REMEDY = "Correct the file that robot_file:= names."
# Limits of drive control (mtr_drive_control/src/robot_shape.cpp): m from base_link, and rotation of a LiDAR.
REACHES: Dict[str, Tuple[float, float]] = {"front_m": (0.1, 1.0), "rear_m": (0.1, 1.0), "half_width_m": (0.1, 0.6)}
MAX_TURN_RAD = 0.25 * math.pi


def description_findings(urdf_text: str, has_rear_lidar: bool) -> List[Finding]:
    """Return one finding for each part that a node reads from the URDF."""
    try:
        geometry = RobotGeometry(urdf_text)
    except ConfigurationError as error:
        return [bad(DESCRIPTION, names.ROBOT_DESCRIPTION, f"{error} {REMEDY}")]
    questions: Dict[str, Callable[[], str]] = {
        "wheels": lambda: _wheels(geometry), "footprint": lambda: _footprint(geometry), "key": lambda: _key(geometry),
        names.FRONT_LIDAR: lambda: _lidar(geometry.mount(names.FRONT_LIDAR), 0.0),
        names.IMU: lambda: _mount(geometry.mount(names.IMU)), "masses": lambda: _masses(geometry)}
    if has_rear_lidar:
        questions[names.REAR_LIDAR] = lambda: _lidar(geometry.mount(names.REAR_LIDAR), math.pi)
    return list(_answers(questions))


def _answers(questions: Dict[str, Callable[[], str]]) -> Iterator[Finding]:
    for subject, ask in questions.items():
        try:
            yield good(DESCRIPTION, subject, ask())
        except ConfigurationError as error:
            yield bad(DESCRIPTION, subject, f"{error} {REMEDY}")


def _wheels(geometry: RobotGeometry) -> str:
    wheels = geometry.wheels()
    return (f"Four wheels of {wheels.radius_m:.3f} m radius, axles {wheels.base_m:.3f} m and sides "
            f"{wheels.track_m:.3f} m apart.")


def _footprint(geometry: RobotGeometry) -> str:
    found = geometry.footprint()
    for name, (low, high) in REACHES.items():
        value = getattr(found, name)
        if not low <= value <= high:
            raise ConfigurationError(f"The footprint's {name} is {value:.3f} m; allowed is {low:g} to {high:g} m.")
    return (f"{found.front_m:.3f} m ahead of base_link, {found.rear_m:.3f} m behind it, {found.half_width_m:.3f} m "
            "aside.")


def _key(geometry: RobotGeometry) -> str:
    key = geometry.key()
    return (f"{key.x_m:.3f} m ahead of base_link, {key.y_m:.3f} m to its left, {key.min_height_m:.2f} to "
            f"{key.max_height_m:.2f} m above ground.")


def _lidar(mount: Mount, ahead_rad: float) -> str:
    # Raises if it is upside down or not level.
    mount.level()
    turn_rad = math.remainder(mount.yaw_rad - ahead_rad, 2.0 * math.pi)
    if abs(turn_rad) > MAX_TURN_RAD:
        raise ConfigurationError(f"The turn of {mount.frame} is {turn_rad:.3f} rad; allowed is {-MAX_TURN_RAD:.3f} to "
                                 f"{MAX_TURN_RAD:.3f} rad.")
    return f"At {mount.x_m:.3f}, {mount.y_m:.3f}, {mount.z_m:.3f} m, upright and level."


def _mount(mount: Mount) -> str:
    return f"At {mount.x_m:.3f}, {mount.y_m:.3f}, {mount.z_m:.3f} m."


def _masses(geometry: RobotGeometry) -> str:
    values = ", ".join(f"{name}: {value:g}" for name, value in balance_parameters(geometry).items())
    return f"Drive control has to have {values}."
