"""Planar LiDAR that rotates while the robot moves: each part of a sweep is cast from the robot's pose at its time."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field
from typing import Dict, Optional, Tuple

import mujoco
import numpy as np

from mtr_core import names
from mtr_core import sensor_figures as figures
from mtr_core.arrays import FloatArray
from mtr_core.parameters import ParameterSet, number
from mtr_description.mounts import Mount

from ..noise import stream
from ..physics.base_state import BaseState
from .readings import Scan
from .scan_errors import ScanErrors, with_errors

# Excluded groups: the robot itself (2), and parts far above the LiDAR plane (3).
SEEN_GROUPS = np.array([1, 1, 0, 0, 1, 1], dtype=np.uint8)
# Beams within this time are cast together from one place, each in its own direction. At 1 m/s and 1 rad/s the place is
# off by at most 5 mm, and the direction is exact.
SLICE_S = 0.01


@dataclass(frozen=True)
class LidarParameters(ParameterSet):
    """Sensor of the class of a Hokuyo UST or SICK TiM at 25 Hz.

    Attributes:
        beams: number of beams of one sweep.
        field_of_view_rad: centred on the LiDAR's x axis.
        rotation_s: one turn; the period of the scans.
        range_min_m, range_max_m: smallest and largest measured range.
        noise_m: 1 sigma of each range.
        height_m: height of its plane above the ground; None: the height of its mount.
        roll_rad, pitch_rad: errors of its mounting, unknown to the robot; positive pitch looks down ahead.
        errors: errors in addition to white noise.
    """

    beams: int = number(720, 2, 4000, "beams")
    field_of_view_rad: float = number(math.radians(270.0), 0.1, 2.0 * math.pi, "rad")
    rotation_s: float = number(0.04, 0.02, 0.2, "s")
    range_min_m: float = number(0.1, 0.0, 1.0, "m")
    range_max_m: float = number(30.0, 1.0, 100.0, "m")
    noise_m: float = number(*figures.SIMULATED_RANGE_NOISE_M)
    height_m: Optional[float] = None
    roll_rad: float = number(0.0, -0.1, 0.1, "rad")
    pitch_rad: float = number(0.0, -0.1, 0.1, "rad")
    errors: ScanErrors = field(default_factory=ScanErrors)

    @property
    def time_increment_s(self) -> float:
        """Time between two beams."""
        return self.angle_increment_rad / (2.0 * math.pi) * self.rotation_s

    @property
    def angle_increment_rad(self) -> float:
        """Angle between two beams."""
        return self.field_of_view_rad / (self.beams - 1)


class Lidar:
    """One LiDAR.

    A sweep is cast in slices, each in the physics step nearest to the time of its middle.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, mount: Mount, parameters: LidarParameters,
                 noise: Tuple[int, str]):
        self._model, self._data, self._parameters = model, data, parameters
        seed, name = noise
        self._noise, self._error_noise = stream(seed, name), stream(seed, f"{name}_errors")
        self._place, self._is_rear = mount.position, mount.frame == names.REAR_LIDAR
        self._rays = _rays(parameters, mount)
        slices, delays = _slices(parameters, model.opt.timestep)
        # Change of a ray until the time of its beam, per rad/s of the robot's turning rate.
        turns = delays[:, np.newaxis] * np.stack(
            [-self._rays[:, 1], self._rays[:, 0], np.zeros(parameters.beams)], axis=1)
        self._distances = np.zeros(parameters.beams)
        geoms = np.zeros(parameters.beams, dtype=np.int32)
        # By the physics step that casts them: rays, their changes, and buffers of geoms and distances.
        self._slices = {step: tuple(each[first:last] for each in (self._rays, turns, geoms, self._distances))
                        for step, (first, last) in slices.items()}
        self._excluded = model.body("base_link").id

    def cast(self, base: BaseState, step: int) -> None:
        """Cast the beams of one physics step of the sweep; step counts from the sweep's start."""
        due = self._slices.get(step)
        if due is None:
            return
        at_rest, turns, geoms, distances = due
        rays = at_rest + base.angular_velocity[2] * turns
        directions = (rays @ np.array(base.rotation).T).reshape(-1)
        mujoco.mj_multiRay(self._model, self._data, base.point(*self._place), directions, SEEN_GROUPS, 1,
                           self._excluded, geoms, distances, len(distances), self._parameters.range_max_m)

    def scan(self, stamp_ns: int) -> Scan:
        """Return the completed sweep that began at stamp_ns."""
        parameters, seen = self._parameters, self._distances
        noisy = np.where(seen < 0.0, math.inf, seen)
        noisy = with_errors(noisy, parameters.errors, self._error_noise, self._is_rear)
        noisy = noisy + parameters.noise_m * self._noise.standard_normal(parameters.beams)
        noisy[noisy < parameters.range_min_m] = -math.inf
        noisy[noisy > parameters.range_max_m] = math.inf
        return Scan(stamp_ns, -parameters.field_of_view_rad / 2.0, parameters.angle_increment_rad,
                    parameters.time_increment_s, parameters.rotation_s, parameters.range_min_m,
                    parameters.range_max_m, noisy.astype(np.float32))


def _rays(parameters: LidarParameters, mount: Mount) -> FloatArray:
    """Return unit vectors of all beams in base_link; the mounting is rotated by yaw, then pitch, then roll."""
    angles = parameters.angle_increment_rad * np.arange(parameters.beams) - parameters.field_of_view_rad / 2.0
    x, y = np.cos(angles), np.sin(angles)
    roll, pitch = mount.roll_rad + parameters.roll_rad, mount.pitch_rad + parameters.pitch_rad
    y, z = y * math.cos(roll), y * math.sin(roll)
    x, z = x * math.cos(pitch) + z * math.sin(pitch), z * math.cos(pitch) - x * math.sin(pitch)
    cos, sin = math.cos(mount.yaw_rad), math.sin(mount.yaw_rad)
    return np.stack([cos * x - sin * y, sin * x + cos * y, z], axis=1)


def _slices(parameters: LidarParameters, step_s: float) -> Tuple[Dict[int, Tuple[int, int]], FloatArray]:
    """Return half-open ranges of beams by the physics step that casts them, and each beam's time after that step."""
    times = np.arange(parameters.beams) * parameters.time_increment_s
    steps_per_slice = max(1, round(SLICE_S / step_s))
    steps = np.rint(times / (step_s * steps_per_slice)).astype(int) * steps_per_slice
    edges = np.flatnonzero(np.diff(steps, prepend=-1, append=-1))
    slices = {int(steps[first]): (int(first), int(last)) for first, last in zip(edges[:-1], edges[1:])}
    return slices, times - steps * step_s
