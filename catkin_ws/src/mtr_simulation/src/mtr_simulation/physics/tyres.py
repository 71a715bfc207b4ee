"""Tyres on the ground: spring and damper upwards, bristles within the friction circle along the ground.

A physics engine's contact of a convex wheel with the ground is wrong for a skid-steered robot: the wheels hop, and the
turning rate depends on the time step. With these forces, the ratio of the wheels' to the true turning rate on the spot
does not depend on friction and time step. It is 1 + (half wheelbase / half track)^2 = 1.487, as for four sliding
points.
"""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from math import sqrt
from typing import List, NamedTuple, Optional, Tuple

import mujoco

from mtr_core.parameters import ParameterSet, number

from ..site.cables import Cables
from ..site.surroundings import Ground
from .base_state import BaseState, Vector
from .robot import WHEELS, RobotModel

# Below this spin the rolling resistance fades out, so that a wheel can stop.
ROLLING_FADE_RADPS = 0.05


@dataclass(frozen=True)
class TyreParameters(ParameterSet):
    """Parameters with which neither mast nor friction causes chatter of the tyres.

    Attributes:
        stiffness_npm: upwards; with 2e4 N/m the robot sinks by 3 mm.
        damping_nspm: upwards.
        bristle_stiffness_npm: along the ground.
        bristle_damping_nspm: along the ground while it sticks.
        rolling_resistance: force against the rolling.
    """

    stiffness_npm: float = number(2.0e4, 1e3, 1e5, "N/m")
    damping_nspm: float = number(1000.0, 0.0, 2000.0, "Ns/m")
    bristle_stiffness_npm: float = number(2.0e4, 1e3, 1e5, "N/m")
    bristle_damping_nspm: float = number(60.0, 0.0, 500.0, "Ns/m")
    rolling_resistance: float = number(0.015, 0.0, 0.1, "(force by load)")


_NO_CABLE = (0.0, 0.0, 0.0)


class Surface(NamedTuple):
    """Surface below the wheels; level without a ground."""

    friction: float
    ground: Optional[Ground] = None
    cables: Optional[Cables] = None


class _WheelPlane(NamedTuple):
    """Orientation of all wheels, in world: axle, vector from a wheel's centre to its lowest point, rolling
    direction."""

    axle: Vector
    down: Vector
    forward: Tuple[float, float]


class _Foot(NamedTuple):
    """Lowest point of a wheel, from base_link, its depth in the ground, and the slopes of a cable there."""

    arm: Vector
    depth: float
    rise: Tuple[float, ...]


def _wheel_plane(base: BaseState, radius_m: float) -> _WheelPlane:
    (_, ax, _), (_, ay, _), (_, az, _) = base.rotation
    upright = sqrt(max(1e-9, 1.0 - az * az))
    level = sqrt(ax * ax + ay * ay) or 1.0
    scale = radius_m / upright
    return _WheelPlane((ax, ay, az), (scale * az * ax, scale * az * ay, -radius_m * upright),
                       (ay / level, -ax / level))


class Tyres:
    """Writes the ground's forces on the wheels into the physics before each of its steps.

    Uneven ground has small slopes, so its forces are approximated as acting upwards and along the level plane.
    """

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, robot: RobotModel, surface: Surface,
                 parameters: TyreParameters):
        self._radius_m, self._positions = robot.wheel_radius_m, robot.wheel_positions
        self._forces = data.xfrc_applied
        self._speeds = data.qvel
        self._step_s = model.opt.timestep
        self._surface, self._parameters = surface, parameters
        self._bodies = [model.body(f"{name}_wheel").id for name in WHEELS]
        self._dofs = [int(model.joint(name).dofadr[0]) for name in WHEELS]
        self._bristles = [[0.0, 0.0] for _ in WHEELS]

    def apply(self, base: BaseState) -> None:
        """Set forces and torques on each wheel's centre for the base's motion and the wheels' spin."""
        (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = base.rotation
        plane = _wheel_plane(base, self._radius_m)
        dx, dy, dz = plane.down
        height = base.position[2] + dz
        for index, (x, y, z) in enumerate(self._positions):
            lift = r20 * x + r21 * y + r22 * z
            arm = (r00 * x + r01 * y + r02 * z + dx, r10 * x + r11 * y + r12 * z + dy, lift + dz)
            rise = self._cable(base, arm)
            depth = self._ground_height(base, arm) + rise[0] - height - lift
            if depth > 0.0:
                self._forces[self._bodies[index]] = self._wrench(index, base, plane, _Foot(arm, depth, rise[1:]))
            else:
                self._bristles[index][:] = (0.0, 0.0)
                self._forces[self._bodies[index]] = 0.0

    def loads_n(self) -> List[float]:
        """Return the upward force of the ground on each wheel; 0 in the air."""
        return [float(self._forces[body][2]) for body in self._bodies]

    def lift_off(self) -> None:
        """Relax the bristles of a robot that was lifted."""
        self._bristles = [[0.0, 0.0] for _ in WHEELS]

    def _ground_height(self, base: BaseState, arm: Vector) -> float:
        ground = self._surface.ground
        return ground.height_m(base.position[0] + arm[0], base.position[1] + arm[1]) if ground else 0.0

    def _cable(self, base: BaseState, arm: Vector) -> Vector:
        """Return the height of a cable below a wheel, and its slopes along x and y."""
        cables = self._surface.cables
        return cables.at(base.position[0] + arm[0], base.position[1] + arm[1]) if cables else _NO_CABLE

    def _wrench(self, index: int, base: BaseState, plane: _WheelPlane, foot: _Foot) -> Tuple[float, ...]:
        """Return force and torque at a wheel's centre, in world.

        A cable pushes along the line from its axis to the wheel's axis: not only upwards, and without a torque.
        """
        parameters, (arm, depth, rise) = self._parameters, foot
        (vx, vy, vz), (ox, oy, oz) = base.velocity, base.angular_velocity
        (ex, ey, ez), (ax, ay, az), (hx, hy, hz), (cos, sin) = (arm, *plane)
        spin = float(self._speeds[self._dofs[index]])
        vertical = vz + ox * ey - oy * ex + spin * (ax * hy - ay * hx)
        climbing = rise[0] * (vx - oz * ey) + rise[1] * (vy + oz * ex)
        load = max(0.0, parameters.stiffness_npm * depth - parameters.damping_nspm * (vertical - climbing))
        along_x = vx + oy * ez - oz * ey + spin * (ay * hz - az * hy)
        along_y = vy + oz * ex - ox * ez + spin * (az * hx - ax * hz)
        rolling, side = self._friction_force(index, along_x * cos + along_y * sin, along_y * cos - along_x * sin, load)
        fx, fy = rolling * cos - side * sin, rolling * sin + side * cos
        resistance = -parameters.rolling_resistance * load * self._radius_m * max(
            -1.0, min(1.0, spin / ROLLING_FADE_RADPS))
        return (fx - rise[0] * load, fy - rise[1] * load, load, hy * load - hz * fy + resistance * ax,
                hz * fx - hx * load + resistance * ay, hx * fy - hy * fx + resistance * az)

    def _friction_force(self, index: int, slip: float, side_slip: float, load: float) -> List[float]:
        """Return the force along and across the rolling direction for the slip speeds in m/s."""
        parameters, bristle = self._parameters, self._bristles[index]
        limit = self._surface.friction * load
        along, across = bristle[0] + slip * self._step_s, bristle[1] + side_slip * self._step_s
        longest = limit / parameters.bristle_stiffness_npm
        length = sqrt(along * along + across * across)
        damping = parameters.bristle_damping_nspm
        if length > longest:
            along, across, damping = along * longest / length, across * longest / length, 0.0
        bristle[0], bristle[1] = along, across
        force = [-parameters.bristle_stiffness_npm * along - damping * slip,
                 -parameters.bristle_stiffness_npm * across - damping * side_slip]
        size = sqrt(force[0] * force[0] + force[1] * force[1])
        if size > limit:
            force = [force[0] * limit / size, force[1] * limit / size]
        return force
