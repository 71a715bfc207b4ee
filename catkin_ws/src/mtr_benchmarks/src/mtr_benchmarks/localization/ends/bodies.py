"""Random Car with different ends: its section with the LiDAR plane, and the data known to its laboratory.

The benchmark has its own distribution. Insets are uniform, whereas the Car locator's prior is half-normal. Sizes are
typical of ordinary cars; the axles are at realistic places, and not symmetric to the Car's middle.
"""
# SPDX-License-Identifier: Apache-2.0
from typing import List, NamedTuple, Sequence, Tuple

import numpy as np

from mtr_car_locator.parameters import DataSheet
from mtr_core.arrays import FloatArray
from mtr_simulation.noise import stream

LENGTH_M, WIDTH_M = (3.5, 5.4), (1.6, 2.0)
# Wheelbase divided by length in makers' data sheets: 0.54 (large saloons) to 0.70; most compact cars have 0.57 to 0.63.
WHEELBASE_SHARE, WHEELBASE_SHARE_SIGMA, WHEELBASE_SHARES = 0.61, 0.035, (0.54, 0.70)
# Half the difference between front and rear overhang.
HALF_DIFFERENCE_M, MIN_OVERHANG_M = 0.2, 0.5
FRONT_INSET_M, REAR_INSET_M, SIDE_INSET_M = (0.0, 0.22), (0.0, 0.15), (0.0, 0.04)
# Shares of ends in the LiDAR plane: both bumpers, only the wheels, or one bumper.
BOTH, NONE, ONE = 0.6, 0.25, 0.15
KNOWS_SIZE, KNOWS_AXLES = 0.5, 0.5
# Difference of a car from its data sheet by number plates, load and trim levels, 1 sigma. In half of the cases the
# ground is not level: the plane cuts tyres at other heights, which shifts the middles of their faces.
SHEET_ERROR_M, UNEVEN, UNEVEN_M = 0.005, 0.5, 0.005
HALF_CHORD_M, ARCH_GAP_M, TYRE_WIDTH_M, TYRE_INSET_M = (0.28, 0.33), (0.06, 0.09), 0.2, (0.02, 0.04)
EXPONENTS, TUNNEL_HALF_WIDTH_M = (2.5, 5.0), 0.55
BUMPER_POINTS = 24

Points = Sequence[Tuple[float, float]]


class DrawnCar(NamedTuple):
    """Truth in a frame whose origin is midway between both ends, x to the front.

    Attributes:
        segments: surfaces in the LiDAR plane, rows (x, y, x, y) in m.
        sheet: data entered by the laboratory.
        front_seen, rear_seen: the bumper is in the plane.
        front_inset_m, rear_inset_m: how far the bumper is set back in the plane.
    """

    length_m: float
    width_m: float
    wheelbase_m: float
    front_overhang_m: float
    front_inset_m: float
    rear_inset_m: float
    front_seen: bool
    rear_seen: bool
    segments: FloatArray
    sheet: DataSheet


def drawn_car(seed: int) -> DrawnCar:
    """Return the seed's Car; the same on every machine."""
    chance = stream(seed, "car with different ends")
    length_m, width_m = chance.uniform(*LENGTH_M), chance.uniform(*WIDTH_M)
    share = np.clip(chance.normal(WHEELBASE_SHARE, WHEELBASE_SHARE_SIGMA), *WHEELBASE_SHARES)
    wheelbase_m = share * length_m
    overhangs_m = length_m - wheelbase_m
    front_m = 0.5 * overhangs_m + chance.uniform(-HALF_DIFFERENCE_M, HALF_DIFFERENCE_M)
    front_m = float(np.clip(front_m, MIN_OVERHANG_M, overhangs_m - MIN_OVERHANG_M))
    insets_m = chance.uniform(*FRONT_INSET_M), chance.uniform(*REAR_INSET_M)
    is_seen = _ends_in_plane(chance)
    segments = _segments(chance, _Plan(length_m, width_m, wheelbase_m, front_m, insets_m, is_seen))
    sheet = _sheet(chance, length_m, width_m, front_m, wheelbase_m)
    return DrawnCar(length_m, width_m, wheelbase_m, front_m, *insets_m, *is_seen, segments, sheet)


def _ends_in_plane(chance: np.random.Generator) -> Tuple[bool, bool]:
    drawn = chance.random()
    if drawn < BOTH + NONE:
        return (drawn < BOTH,) * 2
    is_front = bool(chance.random() < 0.5)
    return is_front, not is_front


def _sheet(chance: np.random.Generator, length_m: float, width_m: float, overhang_m: float,
           wheelbase_m: float) -> DataSheet:
    """Return sizes and axles as far as they are known."""
    known = np.array([length_m, width_m, overhang_m, wheelbase_m]) + SHEET_ERROR_M * chance.standard_normal(4)
    size, axles = chance.random() < KNOWS_SIZE, chance.random() < KNOWS_AXLES
    length, width, overhang, wheelbase = np.where([size, size, axles, axles], known, 0.0)
    return DataSheet(known_length_m=float(length), known_width_m=float(width), front_overhang_m=float(overhang),
                     wheelbase_m=float(wheelbase))


class _Plan(NamedTuple):
    length_m: float
    width_m: float
    wheelbase_m: float
    front_overhang_m: float
    insets_m: Tuple[float, float]
    is_seen: Tuple[bool, bool]


def _segments(chance: np.random.Generator, plan: _Plan) -> FloatArray:
    """Return bumpers, sills and tyres; without a bumper in the plane, only the tyres."""
    side_m = 0.5 * plan.width_m - chance.uniform(*SIDE_INSET_M)
    half_chord_m = chance.uniform(*HALF_CHORD_M)
    arch_m = half_chord_m + chance.uniform(*ARCH_GAP_M)
    front_axle_m = 0.5 * plan.length_m - plan.front_overhang_m
    axles_m = (front_axle_m, front_axle_m - plan.wheelbase_m)
    exponents = chance.uniform(*EXPONENTS, 2)
    found: List[FloatArray] = []
    for end, axle_m, inset_m, exponent, seen in zip((1.0, -1.0), axles_m, plan.insets_m, exponents, plan.is_seen):
        if seen:
            tip_m, arch_end_m = end * (0.5 * plan.length_m - inset_m), axle_m + end * arch_m
            found.append(_open(_bumper(tip_m, arch_end_m, side_m, exponent)))
    if any(plan.is_seen):
        sill = [(axles_m[1] + arch_m, side_m), (axles_m[0] - arch_m, side_m)]
        found += [_open([(x, sign * y) for x, y in sill]) for sign in (1.0, -1.0)]
        found += [_open([(axle_m - arch_m, sign * TUNNEL_HALF_WIDTH_M), (axle_m + arch_m, sign * TUNNEL_HALF_WIDTH_M)])
                  for axle_m in axles_m for sign in (1.0, -1.0)]
    tyre_m = side_m - chance.uniform(*TYRE_INSET_M)
    shift_m = UNEVEN_M if chance.random() < UNEVEN else 0.0
    for axle_m in np.array(axles_m) + shift_m * chance.standard_normal(2):
        for sign in (1.0, -1.0):
            corners = [(axle_m + x, sign * (tyre_m - y)) for x, y in (
                (half_chord_m, 0.0), (-half_chord_m, 0.0), (-half_chord_m, TYRE_WIDTH_M), (half_chord_m, TYRE_WIDTH_M))]
            found.append(_open([*corners, corners[0]]))
    return np.vstack(found)


def _bumper(tip_m: float, arch_m: float, side_m: float, exponent: float) -> Points:
    """Return a superellipse from the left wheel arch around the tip to the right one, with edges to the tunnel at both
    arches."""
    shares = np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, BUMPER_POINTS))
    curve = [(arch_m + (tip_m - arch_m) * (1.0 - abs(share) ** exponent) ** (1.0 / exponent), share * side_m)
             for share in shares]
    return [(arch_m, -TUNNEL_HALF_WIDTH_M), *curve, (arch_m, TUNNEL_HALF_WIDTH_M)]


def _open(points: Points) -> FloatArray:
    return np.array([(*one, *other) for one, other in zip(points[:-1], points[1:])])
