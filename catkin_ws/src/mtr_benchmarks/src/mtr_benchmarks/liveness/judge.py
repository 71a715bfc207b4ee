"""Compares commands and speeds of the wheels with the limits while a node is stopped. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import bisect
import math
from dataclasses import dataclass
from typing import List, NamedTuple, Sequence

# Commands come 20 ms apart; after a longer pause the reference is the wheel speed, not the previous command.
PAUSE_S = 0.1
PERIOD_S = 0.02


class Motion(NamedTuple):
    """Velocity at a time: s of the machine's monotonic clock, m/s, rad/s."""

    time_s: float
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True)
class Growth:
    """Allowed change of a velocity, m/s2 and rad/s2: drive control's limits for commands, the base's limits for
    wheels."""

    linear_mps2: float
    angular_radps2: float


class Excess(NamedTuple):
    """Largest excess beyond the allowed change: m/s, rad/s; not negative."""

    linear_mps: float
    angular_radps: float


NO_EXCESS = Excess(0.0, 0.0)


def excess_of_commands(commands: Sequence[Motion], wheels: Sequence[Motion], growth: Growth) -> Excess:
    """Return the worst surge of commands above the previous one, or after a pause above the wheel speed.

    A delay can make two commands arrive at once; each is allowed at least one period's growth.
    """
    times = [each.time_s for each in wheels]
    worst = NO_EXCESS
    for before, now in zip(commands, commands[1:]):
        gap_s = now.time_s - before.time_s
        start = before
        if gap_s > PAUSE_S:
            newest = bisect.bisect_right(times, now.time_s) - 1
            start = wheels[newest] if newest >= 0 else Motion(now.time_s, 0.0, 0.0)
        worst = _worse(worst, start, now, growth, PERIOD_S if gap_s > PAUSE_S else max(gap_s, PERIOD_S))
    return worst


def excess_of_wheels(wheels: Sequence[Motion], growth: Growth) -> Excess:
    """Return the worst change of the wheel speed, in either direction, between readings 20 ms of the base's clock
    apart."""
    worst = NO_EXCESS
    for before, now in zip(wheels, wheels[1:]):
        linear = abs(now.linear_mps - before.linear_mps) - growth.linear_mps2 * PERIOD_S
        angular = abs(now.angular_radps - before.angular_radps) - growth.angular_radps2 * PERIOD_S
        worst = Excess(max(worst.linear_mps, linear), max(worst.angular_radps, angular))
    return worst


def longest_pause_s(times_s: Sequence[float], begin_s: float, end_s: float) -> float:
    """Return the longest time without a message within an interval; its ends count as messages."""
    within: List[float] = [begin_s, *(each for each in times_s if begin_s < each < end_s), end_s]
    return max(after - before for before, after in zip(within, within[1:]))


def between(motions: Sequence[Motion], begin_s: float, end_s: float) -> List[Motion]:
    """Return the motions within an interval."""
    return [each for each in motions if begin_s <= each.time_s < end_s]


def _worse(worst: Excess, before: Motion, now: Motion, growth: Growth, step_s: float) -> Excess:
    return Excess(max(worst.linear_mps, _gain(before.linear_mps, now.linear_mps) - growth.linear_mps2 * step_s),
                  max(worst.angular_radps,
                      _gain(before.angular_radps, now.angular_radps) - growth.angular_radps2 * step_s))


def _gain(before: float, now: float) -> float:
    """Return the gain away from standstill; after a change of sign, the whole new velocity."""
    return abs(now) - abs(before) if math.copysign(1.0, now) == math.copysign(1.0, before) or not before else abs(now)
