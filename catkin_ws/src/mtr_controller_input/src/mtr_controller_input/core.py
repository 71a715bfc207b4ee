"""Deflections of a manual controller to a velocity, only while a dead-man button is held."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Sequence

from .parameters import Parameters


class Velocity(NamedTuple):
    """Velocity of base_link; active False: the person wants nothing."""

    linear_mps: float
    angular_radps: float
    active: bool


RELEASED = Velocity(0.0, 0.0, False)


def velocity(parameters: Parameters, axes: Sequence[float], buttons: Sequence[int], age_s: float) -> Velocity:
    """Velocity that the controller's newest state asks for. An input that the controller lacks counts as released."""
    if not 0.0 <= age_s <= parameters.silent_after_s:
        return RELEASED
    if _is_held(buttons, parameters.fast_button):
        linear_mps, angular_radps = parameters.fast_mps, parameters.fast_radps
    elif _is_held(buttons, parameters.slow_button):
        linear_mps, angular_radps = parameters.slow_mps, parameters.slow_radps
    else:
        return RELEASED
    return Velocity(linear_mps * _deflection(parameters, axes, parameters.linear_axis),
                    angular_radps * _deflection(parameters, axes, parameters.angular_axis), True)


def _is_held(buttons: Sequence[int], index: int) -> bool:
    return index < len(buttons) and buttons[index] == 1


def _deflection(parameters: Parameters, axes: Sequence[float], index: int) -> float:
    value = axes[index] if index < len(axes) else 0.0
    if not math.isfinite(value) or abs(value) < parameters.dead_zone:
        return 0.0
    return min(max(value, -1.0), 1.0)
