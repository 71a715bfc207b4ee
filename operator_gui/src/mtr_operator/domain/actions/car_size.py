"""How well the sides of the Car are known, what that does to a test's distances, and which measures would help.

The robot's LiDARs see the Car at their own height. Above it a body may reach farther out, never less far. Without a
data sheet a distance from its outline may therefore be too long. With the length alone it is not known which end stands
back: distances may be too long or too short (docs/accuracy.md, Limits).
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Iterable, Sequence

from ..geometry.outline import FRONT, LEFT, REAR, RIGHT, SIDES, side_errors
from ..geometry.pose import Point
from ..geometry.ray import Ray
from ..robot_status import CarDimensions

# An inset that is as likely anywhere from 0 to its end has this end for a root of its mean square of 1.
_END_PER_SIGMA = math.sqrt(3.0)
# Half the width of an interval that holds 95 %, in sigmas.
_SIGMAS_OF_95 = 1.96
# A data sheet is right to 5 mm, 1 sigma; what is farther off than this was not said by one.
_TOLD_FROM_M = 0.02
# The key is not carried nearer to a side than this many of its sigmas and a gap: the Car may reach out as far.
SAFE_SIGMAS, SAFE_GAP_M = 3.0, 0.1
_CM_PER_M = 100.0
# A line begins on the outline; its origin is rounded.
_ON_OUTLINE_M = 0.001
# Keys of the robot's car_file.
LENGTH, WIDTH = "known_length_m", "known_width_m"
AXLES = ("front_overhang_m", "wheelbase_m")


def size_excess(car: CarDimensions) -> float:
    """How much too long a distance from an end or side may be, in m; 0 where a data sheet says both sizes, or no size
    is known yet."""
    if car.knows_sides:
        excess_m = _SIGMAS_OF_95 * max(car.side_sigmas)
    else:
        sigmas_m = [sigma_m / 2.0 for sigma_m in (car.length_sigma, car.width_sigma) if not math.isnan(sigma_m)]
        excess_m = _END_PER_SIGMA * max(sigmas_m, default=0.0)
    return excess_m if excess_m > _TOLD_FROM_M else 0.0


def missing_measures(car: CarDimensions, sides: Iterable[str] = SIDES) -> tuple[str, ...]:
    """Keys of car_file that would make these sides of the Car better known."""
    vague = {side for side, sigma_m in zip(SIDES, car.side_sigmas)
             if side in sides and _SIGMAS_OF_95 * sigma_m > _TOLD_FROM_M}
    found = []
    if vague & {FRONT, REAR}:
        # The axles tell the front, and with the length the rear.
        found += [LENGTH] if REAR in vague and _SIGMAS_OF_95 * car.length_sigma > _TOLD_FROM_M else []
        found += AXLES if _SIGMAS_OF_95 * car.front_sigma > _TOLD_FROM_M or not found else ()
    return (*found, *((WIDTH,) if vague & {LEFT, RIGHT} else ()))


def size_cautions(rays: Iterable[Ray], car: CarDimensions) -> tuple[str, ...]:
    """A sentence when distances on one of these lines depend on a size that no data sheet has said."""
    if car.knows_sides:
        return _side_cautions(list(rays), car)
    along_m = [abs(ray.direction_x) * car.length_sigma / 2.0 + abs(ray.direction_y) * car.width_sigma / 2.0
               for ray in rays if (ray.origin_x, ray.origin_y) != (0.0, 0.0)]
    excess_m = _END_PER_SIGMA * max((each_m for each_m in along_m if not math.isnan(each_m)), default=0.0)
    if excess_m <= _TOLD_FROM_M:
        return ()
    excess_cm = _CM_PER_M * excess_m
    return (f"Without length and width of the Car's data sheet the distances may be up to {excess_cm:.0f} cm too long: "
            "the Car may be wider above the height at which the LiDARs see it. Start the robot with car_file, and map "
            "the Car again.",)


def _side_cautions(rays: Sequence[Ray], car: CarDimensions) -> tuple[str, ...]:
    met = {side.side: side for ray in rays for side in side_errors(ray, car)}
    vague = [met[name] for name in SIDES if name in met and _SIGMAS_OF_95 * met[name].sigma_m > _TOLD_FROM_M]
    if not vague:
        return ()
    named = ", ".join(f"{side.side} {_CM_PER_M * _SIGMAS_OF_95 * side.sigma_m:.0f} cm" for side in vague)
    return (f"The Car's sides are known to (95 %): {named}; distances from them may be wrong by that much. "
            f"{_remedy(missing_measures(car, {side.side for side in vague}))}",)


def _remedy(keys: Iterable[str]) -> str:
    return (f"Fill in {', '.join(keys)} (data sheet or tape measure) in the robot's car_file, restart the robot with "
            "it, and map the Car again.")


@dataclass(frozen=True)
class Nearness:
    """A test that would bring the key nearer to the Car than its outline is known.

    Attributes:
        sides: of the Car that are known too vaguely, the worst first. keys: of car_file that would help.
        vague_m: half the width of the worst side's 95 % interval. least_m: smallest distance from it that is safe.
    """

    sides: tuple[str, ...]
    keys: tuple[str, ...]
    vague_m: float
    least_m: float

    @property
    def sentence(self) -> str:
        """What is wrong and which measures help."""
        return (f"The Car's {self.sides[0]} is known to {_CM_PER_M * self.vague_m:.0f} cm only (95 %); the robot may "
                f"touch it nearer than {self.least_m:.2f} m. {_remedy(self.keys)}")


def nearness_of(rays: Iterable[Ray], nearest_m: float, car: CarDimensions) -> Nearness | None:
    """What speaks against bringing the key as near as this on these lines; None when nothing does.

    nearest_m: smallest distance of the key along the lines. Lines from the Car's centre do not count: along them the
    robot refuses what is too near, and the test goes on with the next place.
    """
    if not car.knows_sides:
        return None
    touched = {side for ray in rays if not ray.begins_in_centre for side in _touched_sides(ray.point(nearest_m), car)}
    if not touched:
        return None
    sigmas_m = {side: sigma_m for side, sigma_m in zip(SIDES, car.side_sigmas) if side in touched}
    worst_first = sorted(sigmas_m, key=lambda side: -sigmas_m[side])
    worst_m = sigmas_m[worst_first[0]]
    return Nearness(tuple(worst_first), missing_measures(car, touched), _SIGMAS_OF_95 * worst_m,
                    SAFE_SIGMAS * worst_m + SAFE_GAP_M)


def _touched_sides(point: Point, car: CarDimensions) -> set[str]:
    """Vague sides beyond which a point lies, when the Car may reach there."""
    x, y = point
    beyond_m = {FRONT: x - car.length / 2.0, REAR: -x - car.length / 2.0, LEFT: y - car.width / 2.0,
                RIGHT: -y - car.width / 2.0}
    may_reach = all(beyond_m[side] < SAFE_SIGMAS * sigma_m + SAFE_GAP_M
                    for side, sigma_m in zip(SIDES, car.side_sigmas))
    # What is well known is watched by the robot itself; it keeps a gap of its own.
    vague = {side for side, sigma_m in zip(SIDES, car.side_sigmas) if _SIGMAS_OF_95 * sigma_m > _TOLD_FROM_M}
    return {side for side in vague if beyond_m[side] > -_ON_OUTLINE_M} if may_reach else set()
