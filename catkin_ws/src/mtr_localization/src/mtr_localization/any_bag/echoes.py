"""Check for usable echoes in LiDAR scans; without echoes, scans do not determine a pose."""
# SPDX-License-Identifier: Apache-2.0
from typing import List, Sequence

import numpy as np

from .errors import BagUnusable
from .motion import Sweep

# Beyond the range of a 2D LiDAR in metres, and at most 200 m in millimetres; larger values mark a missing echo.
MIN_MM, MAX_MM = 200.0, 2e5
# Drivers may insert a constant for a missing echo, so several distinct values are required.
DISTINCT = 3
MOST = 0.9


class EchoCount:
    """Counts the usable scans of one topic.

    Attributes:
        scans: number of scans.
        usable: number of scans with at least one echo between range_min and range_max.
    """

    def __init__(self, topic: str) -> None:
        self.topic, self.scans, self.usable = topic, 0, 0
        self._in_mm, self._impossible = 0, 0
        self._limits_m = (0.0, 0.0)

    def add(self, scan: Sweep) -> None:
        """Count one more scan."""
        ranges = np.asarray(scan.ranges, dtype=float)
        echoes = ranges[np.isfinite(ranges) & (ranges > 0.0)]
        self.scans += 1
        self._impossible += int(ranges.size < 2 or scan.range_max_m <= scan.range_min_m)
        self._limits_m = (scan.range_min_m, scan.range_max_m)
        self.usable += bool(((echoes >= scan.range_min_m) & (echoes <= scan.range_max_m)).any())
        large = echoes[(echoes > MIN_MM) & (echoes < MAX_MM)]
        self._in_mm += bool(large.size > MOST * echoes.size and np.unique(large).size >= DISTINCT)

    @property
    def is_blind(self) -> bool:
        """True if no scan has a usable echo; localization itself reports scans without beams and swapped limits."""
        return self._impossible < self.scans and not self.usable

    def check_unit(self) -> None:
        """Raise BagUnusable if the ranges are in millimetres."""
        if self.scans and self._in_mm > MOST * self.scans:
            raise BagUnusable(f"The ranges of {self.topic} are mostly above {MIN_MM:g} m, probably "
                              f"millimetres (range_max is {self._limits_m[1]:g}): convert ranges, range_min "
                              "and range_max to metres.")

    def blind_sentence(self) -> str:
        """Return a sentence about a topic without usable echoes."""
        low_m, high_m = self._limits_m
        return (f"None of the {self.scans} scans of {self.topic} has an echo between range_min {low_m:g} m and "
                f"range_max {high_m:g} m: check the LiDAR and its driver.")


def check_echoes(counts: Sequence[EchoCount]) -> List[str]:
    """Return sentences about blind topics; BagUnusable if all are blind, or if ranges are in another unit."""
    for count in counts:
        count.check_unit()
    blind = [count.blind_sentence() for count in counts if count.is_blind]
    if blind and len(blind) == len(counts):
        raise BagUnusable(" ".join(blind))
    return blind
