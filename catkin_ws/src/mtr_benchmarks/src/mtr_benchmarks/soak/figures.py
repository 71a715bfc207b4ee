"""Figures of what was seen while the robot wandered. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import itertools
from typing import Callable, Dict, List, NamedTuple, Sequence, Tuple

import numpy as np

from .processes import Usage
from .trend import Trend, trend_of

QUANTITIES: Dict[str, Callable[[Usage], float]] = {
    "memory, MiB": lambda usage: usage.private_mib, "open files": lambda usage: usage.files,
    "threads": lambda usage: usage.threads, "bytes waiting in sockets": lambda usage: usage.queued_bytes}
# Of the time: pools, caches and the first map fill until then.
WARM_UP_SHARE = 0.2
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


def by_halves(places: Sequence[Place]) -> Tuple[List[float], List[float]]:
    """Mean errors of the maps of the first and of the last half: places on one map share the map's error."""
    ordered = sorted(places, key=lambda place: place.map_id)
    maps = [mean([place.error_m for place in group])
            for _, group in itertools.groupby(ordered, key=lambda place: place.map_id)]
    return maps[:len(maps) // 2], maps[len(maps) // 2:]


def mean(values: Sequence[float]) -> float:
    """Of some values; not a number for none."""
    return float(np.mean(values)) if len(values) else float("nan")
