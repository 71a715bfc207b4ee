"""Figures that move on a site: one or two persons, wheelchair, pram, child, and a lying test body."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Dict, NamedTuple, Set, Tuple

from mtr_core.errors import ConfigurationError


class Leg(NamedTuple):
    """One leg: name of its body, offset to the left of the walk's line, and sense of its swing."""

    name: str
    side_m: float
    sense: float


@dataclass(frozen=True)
class Figure:
    """Shape of a figure; x ahead, y left, z up from the ground.

    Attributes:
        geoms: MJCF attributes of the parts that do not swing.
        legs: legs that swing about the hip.
        hip_height_m: height above ground.
        leg_length_m: from the hip to the middle of the foot.
        leg_radius_m: radius of a leg.
        stride_m: length of two steps.
    """

    geoms: Tuple[str, ...]
    legs: Tuple[Leg, ...] = ()
    hip_height_m: float = 0.92
    leg_length_m: float = 0.82
    leg_radius_m: float = 0.07
    stride_m: float = 1.4


def _adult(side_m: float) -> Tuple[str, ...]:
    """Return torso and head."""
    return (f'type="capsule" fromto="0 {side_m} 0.95 0 {side_m} 1.45" size="0.18"',
            f'type="sphere" pos="0 {side_m} 1.68" size="0.12"')


# Half the distance between two persons side by side, and between the legs of an adult and of a child.
_HALF_PAIR_M, _HALF_HIP_M, _HALF_CHILD_HIP_M = 0.30, 0.1, 0.06
FIGURES: Dict[str, Figure] = {
    "person": Figure(_adult(0.0), (Leg("left_leg", _HALF_HIP_M, 1.0), Leg("right_leg", -_HALF_HIP_M, -1.0))),
    "pair": Figure((*_adult(_HALF_PAIR_M), *_adult(-_HALF_PAIR_M)),
                   (Leg("left_leg", _HALF_PAIR_M + _HALF_HIP_M, 1.0),
                    Leg("right_leg", _HALF_PAIR_M - _HALF_HIP_M, -1.0),
                    Leg("second_left_leg", _HALF_HIP_M - _HALF_PAIR_M, -1.0),
                    Leg("second_right_leg", -_HALF_HIP_M - _HALF_PAIR_M, 1.0))),
    # Outlines of a wheelchair with its user, and of a pram; the person who pushes the pram walks behind it.
    "wheelchair": Figure(('type="box" pos="0 0 0.6" size="0.55 0.33 0.55"',)),
    "pram": Figure(('type="box" pos="0.45 0 0.5" size="0.45 0.30 0.45"', *(
        f'type="capsule" fromto="-0.45 {side} 0.1 -0.45 {side} 0.92" size="0.07"' for side in (0.1, -0.1)))),
    "child": Figure(('type="capsule" fromto="0 0 0.55 0 0 0.85" size="0.11"',
                     'type="sphere" pos="0 0 1.02" size="0.1"'),
                    (Leg("left_leg", _HALF_CHILD_HIP_M, 1.0), Leg("right_leg", -_HALF_CHILD_HIP_M, -1.0)),
                    hip_height_m=0.5, leg_length_m=0.45, leg_radius_m=0.045, stride_m=1.2),
    # Test body of ISO 3691-4 for a lying person: 0.2 m in diameter, 0.6 m long, across the line of its walk.
    "lying": Figure(('type="cylinder" pos="0 0 0.1" size="0.1 0.3" euler="1.5708 0 0"',)),
}
# Names of all bodies of the figures.
BODIES: Set[str] = {"person", *(leg.name for figure in FIGURES.values() for leg in figure.legs)}


def figure_named(name: str) -> Figure:
    """Return the figure of this name."""
    if name not in FIGURES:
        raise ConfigurationError(f"Parameter figure is '{name}'; allowed is {', '.join(FIGURES)}.")
    return FIGURES[name]
