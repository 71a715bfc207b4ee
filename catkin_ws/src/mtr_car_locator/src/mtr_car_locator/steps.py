"""The locator's steps beside the node's ticks: a long fit silences nobody; which scans and maps count at one."""
# SPDX-License-Identifier: Apache-2.0
import concurrent.futures
from dataclasses import replace
from typing import List, Optional, Sequence

from mtr_core.schedule import MILLISECOND_NS

from .estimate import Estimate, Inputs
from .locator import CarLocator
from .poses import RobotPose
from .scan import Scan

# A tick waits so long for its step before it repeats what was known: most steps are done within it.
PATIENCE_S = 0.04
# A scan bears its first beam's time and is there when the sweep has ended; the pose of its last beam is there too then.
SCAN_LAG_NS = 100 * MILLISECOND_NS
# Scans that come while the connections are being made are not used: how many there are depends on the machine.
CONNECTING_NS = 200 * MILLISECOND_NS
# A map counts from this long after its stamp on.
MAP_LAG_NS = 100 * MILLISECOND_NS


class LocatorSteps:
    """Makes one step after another; what comes meanwhile waits for the next one.

    In lock-step the executor works inline, and each tick has the estimate of its own inputs.
    """

    def __init__(self, locator: CarLocator, executor: concurrent.futures.Executor, patience_s: float = PATIENCE_S):
        self._locator, self._executor, self._patience_s = locator, executor, patience_s
        self._poses: List[RobotPose] = []
        self._scans: List[Scan] = []
        self._wanted = False
        self._running: Optional[concurrent.futures.Future[Estimate]] = None
        self._estimate: Optional[Estimate] = None

    def wants_scans(self, inputs: Inputs, poses: Sequence[RobotPose]) -> bool:
        """True while scans are collected or about to be; poses: those up to the tick, each is given once."""
        self._poses.extend(poses)
        if self._running is None:
            self._add_poses()
            self._wanted = self._locator.wants_scans(inputs)
        return self._wanted

    def estimate(self, inputs: Inputs) -> Estimate:
        """The newest that is known of the Car at a tick; raises what the locator raised."""
        self._scans.extend(inputs.scans)
        if self._running is None:
            scans, self._scans = self._scans, []
            self._running = self._executor.submit(self._locator.step, replace(inputs, scans=scans))
        try:
            # Before the first estimate there is nothing to repeat.
            self._estimate = self._running.result(self._patience_s if self._estimate else None)
            self._running = None
        except concurrent.futures.TimeoutError:
            assert self._estimate is not None
        return self._estimate

    def _add_poses(self) -> None:
        for pose in self._poses:
            self._locator.add_pose(pose)
        self._poses.clear()


class ScanWindow:
    """From when on scans count while they are wanted."""

    def __init__(self) -> None:
        self._usable_from_ns: Optional[int] = None

    def follow(self, tick_ns: int, wanted: bool) -> None:
        """Whether they are wanted at a tick."""
        if not wanted:
            self._usable_from_ns = None
            return
        latest_ns = tick_ns + CONNECTING_NS
        # A clock that was set back must not leave the scans unused until it has come to that time again.
        self._usable_from_ns = latest_ns if self._usable_from_ns is None else min(self._usable_from_ns, latest_ns)

    def counts(self, stamp_ns: int) -> bool:
        """True for a scan that counts."""
        return self._usable_from_ns is not None and stamp_ns >= self._usable_from_ns


def is_map_due(stamp_ns: int, tick_ns: int) -> bool:
    """True when a map counts at a tick, whatever the poses speak of."""
    return stamp_ns + MAP_LAG_NS <= tick_ns
