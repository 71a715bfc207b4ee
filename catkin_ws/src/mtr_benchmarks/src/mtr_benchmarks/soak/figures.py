"""Figures of what was seen while the robot wandered. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import Callable, Dict, Iterator, List, NamedTuple, Sequence, Tuple

import numpy as np

from .processes import Usage
from .trend import Trend, trend_of

QUANTITIES: Dict[str, Callable[[Usage], float]] = {
    "memory, MiB": lambda usage: usage.private_mib, "open files": lambda usage: usage.files,
    "threads": lambda usage: usage.threads, "bytes waiting in sockets": lambda usage: usage.queued_bytes}
# Of the time: pools, caches and the first map fill until then.
WARM_UP_SHARE = 0.2
# Of a soak on the robot in lock-step: its nodes and what ROS needs beside them.
PROCESSES = ("simulator", "drive_control", "localization", "motion_planner", "car_locator", "state_machine",
             "peripherals", "dispatcher", "fault_injection", "robot_state_publisher", "rosmaster", "rosout")
# From the robot's start to the first look, and from the last one to the end: looks are 10 s apart, and one of a busy
# machine comes late, s of the robot's time.
MAX_UNSEEN_S = 60.0
Samples = Dict[str, List[Tuple[float, Usage]]]


class Place(NamedTuple):
    """Where the robot stood, how far from there it said to be (m), and by which order to map the Car it knows."""

    time_s: float
    error_m: float
    map_id: int


def trends_of(samples: Samples, quantity: str) -> Dict[str, Trend]:
    """Slope of a quantity by process, after the warm-up; those that were there for too short a time have none."""
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
    """Processes that are missing, or were not seen from the robot's start until an end, s, or too seldom."""
    trends = trends_of(samples, next(iter(QUANTITIES)))
    return [name for name in sorted({*PROCESSES, *samples}) if name not in trends or any(
        after - before > MAX_UNSEEN_S for before, after in _pauses(samples[name], end_s))]


def _pauses(samples: Sequence[Tuple[float, Usage]], end_s: float) -> Iterator[Tuple[float, float]]:
    times_s = [0.0, *(time_s for time_s, _ in samples), end_s]
    return zip(times_s, times_s[1:])


def by_halves(places: Sequence[Place]) -> Tuple[List[float], List[float]]:
    """Mean errors of the maps of the first and of the last half: places on one map share the map's error."""
    ordered = sorted(places, key=lambda place: place.map_id)
    maps = [mean([place.error_m for place in group])
            for _, group in itertools.groupby(ordered, key=lambda place: place.map_id)]
    return maps[:len(maps) // 2], maps[len(maps) // 2:]


def mean(values: Sequence[float]) -> float:
    """Of some values; not a number for none."""
    return float(np.mean(values)) if len(values) else float("nan")
