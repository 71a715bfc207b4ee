"""Speeds that end in time, and changes of speed within the limits."""
# SPDX-License-Identifier: Apache-2.0
import math

# Braking by plan uses less than the limit, so that the loop can still correct.
BRAKING_SHARE = 0.8
# Last centimetres: speed proportional to the rest, 1/s. With a loop delay of 0.15 s this does not overshoot.
END_GAIN = 3.0
# Time between the pose and its effect on the wheels, s.
DELAY_S = 0.10


def clamp(value: float, limit: float) -> float:
    """Value limited to [-limit, limit]."""
    return max(-limit, min(limit, value))


def slew(value: float, target: float, step: float) -> float:
    """Value moved towards target by at most step."""
    return value + clamp(target - value, step)


def approach_speed(rest: float, speed: float, acceleration: float, creep: float) -> float:
    """Speed >= 0 from which the rest (m or rad) suffices to stop, never below creep; 0 when nothing is left.

    rest counts from the present pose; speed is the present one and stands for what is covered during the delay.
    """
    ahead = rest - abs(speed) * DELAY_S
    if rest <= 0.0:
        return 0.0
    wanted = min(math.sqrt(2.0 * BRAKING_SHARE * acceleration * max(ahead, 0.0)), END_GAIN * ahead)
    return max(wanted, creep)
