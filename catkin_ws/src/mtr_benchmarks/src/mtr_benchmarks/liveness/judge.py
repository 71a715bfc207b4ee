"""What the wheels were told and did while something was stopped, against what the limits allow. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import bisect
import math
from dataclasses import dataclass
from typing import List, NamedTuple, Sequence

# Commands come 20 ms apart; after a longer pause a base goes by its wheels, not by what it was told before.
PAUSE_S = 0.1
PERIOD_S = 0.02


class Motion(NamedTuple):
    """Velocity at a time: s of the machine's monotonic clock, m/s, rad/s."""

    time_s: float
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True)
class Growth:
    """What a velocity may gain, m/s2 and rad/s2: of the commands drive control's acceleration, of wheels the base's."""

    linear_mps2: float
    angular_radps2: float


class Excess(NamedTuple):
    """What was gained beyond that at the worst instant: m/s, rad/s. Nothing or less: 0."""

    linear_mps: float
    angular_radps: float


NO_EXCESS = Excess(0.0, 0.0)


def excess_of_commands(commands: Sequence[Motion], wheels: Sequence[Motion], growth: Growth) -> Excess:
    """The worst surge of commands: above the one before, after a pause above what the wheels did.

    A command may be delayed on its way, so that two arrive at once; each is allowed a period's growth at least.
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
    """The worst step of what the wheels did between two readings 20 ms of the base's clock apart, either way."""
    worst = NO_EXCESS
    for before, now in zip(wheels, wheels[1:]):
        linear = abs(now.linear_mps - before.linear_mps) - growth.linear_mps2 * PERIOD_S
        angular = abs(now.angular_radps - before.angular_radps) - growth.angular_radps2 * PERIOD_S
        worst = Excess(max(worst.linear_mps, linear), max(worst.angular_radps, angular))
    return worst


def longest_pause_s(times_s: Sequence[float], begin_s: float, end_s: float) -> float:
    """Longest time within an interval for which nothing was said; its ends count."""
    within: List[float] = [begin_s, *(each for each in times_s if begin_s < each < end_s), end_s]
    return max(after - before for before, after in zip(within, within[1:]))


def between(motions: Sequence[Motion], begin_s: float, end_s: float) -> List[Motion]:
    """The part of a record."""
    return [each for each in motions if begin_s <= each.time_s < end_s]


def _worse(worst: Excess, before: Motion, now: Motion, growth: Growth, step_s: float) -> Excess:
    return Excess(max(worst.linear_mps, _gain(before.linear_mps, now.linear_mps) - growth.linear_mps2 * step_s),
                  max(worst.angular_radps,
                      _gain(before.angular_radps, now.angular_radps) - growth.angular_radps2 * step_s))


def _gain(before: float, now: float) -> float:
    """By how much a velocity is farther from standstill, or on the other side of it."""
    return abs(now) - abs(before) if math.copysign(1.0, now) == math.copysign(1.0, before) or not before else abs(now)
