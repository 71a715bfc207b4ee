"""Figures of the samples that were taken while the robot wandered. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import Callable, Dict, Iterator, List, NamedTuple, Sequence, Tuple

import numpy as np

from .processes import Usage
from .trend import Trend, trend_of

QUANTITIES: Dict[str, Callable[[Usage], float]] = {
    "memory, MiB": lambda usage: usage.private_mib, "open files": lambda usage: usage.files,
    "threads": lambda usage: usage.threads, "bytes waiting in sockets": lambda usage: usage.queued_bytes}
# Share of the time in which pools, caches and the first map fill.
WARM_UP_SHARE = 0.2
# Processes of a soak on the robot in lock-step: its nodes and the processes of ROS.
PROCESSES = ("simulator", "drive_control", "localization", "motion_planner", "car_locator", "state_machine",
             "peripherals", "dispatcher", "fault_injection", "robot_state_publisher", "rosmaster", "rosout")
# Longest time without a sample, s of the robot's time, also at the start and at the end; samples are 10 s apart, and
# delayed on a busy machine.
MAX_UNSEEN_S = 60.0
Samples = Dict[str, List[Tuple[float, Usage]]]


class Place(NamedTuple):
    """Stop of the robot: its position error in m, and the id of the map on which it was localized."""

    time_s: float
    error_m: float
    map_id: int


def trends_of(samples: Samples, quantity: str) -> Dict[str, Trend]:
    """Return the slope of a quantity by process, after the warm-up; processes with too few samples are left out."""
    found = {}
    for name, each in samples.items():
        begin_s = each[0][0] + WARM_UP_SHARE * (each[-1][0] - each[0][0])
        settled = [(time_s, QUANTITIES[quantity](usage)) for time_s, usage in each if time_s >= begin_s]
        try:
            found[name] = trend_of(settled)
        except ValueError:
            continue
    return found


def unseen(samples: Samples, end_s: float) -> List[str]:
    """Return processes that are missing, or have gaps without samples between the robot's start and end_s."""
    trends = trends_of(samples, next(iter(QUANTITIES)))
    return [name for name in sorted({*PROCESSES, *samples}) if name not in trends or any(
        after - before > MAX_UNSEEN_S for before, after in _pauses(samples[name], end_s))]


def _pauses(samples: Sequence[Tuple[float, Usage]], end_s: float) -> Iterator[Tuple[float, float]]:
    times_s = [0.0, *(time_s for time_s, _ in samples), end_s]
    return zip(times_s, times_s[1:])


def by_halves(places: Sequence[Place]) -> Tuple[List[float], List[float]]:
    """Return mean errors of the maps of the first and the last half; places on one map share the map's error."""
    ordered = sorted(places, key=lambda place: place.map_id)
    maps = [mean([place.error_m for place in group])
            for _, group in itertools.groupby(ordered, key=lambda place: place.map_id)]
    return maps[:len(maps) // 2], maps[len(maps) // 2:]


def mean(values: Sequence[float]) -> float:
    """Return the mean of the values; NaN without values."""
    return float(np.mean(values)) if len(values) else float("nan")
