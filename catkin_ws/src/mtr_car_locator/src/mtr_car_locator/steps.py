"""Execution of locator steps without delaying the node's ticks, and the timing of scans and maps."""
# SPDX-License-Identifier: Apache-2.0
import concurrent.futures
from dataclasses import replace
from typing import List, Optional, Sequence

from mtr_core.schedule import MILLISECOND_NS

from .estimate import Estimate, Inputs
from .locator import CarLocator
from .poses import RobotPose
from .scan import Scan

# Waiting time of a tick for its step before it repeats the previous estimate; most steps are faster.
PATIENCE_S = 0.04
# A scan is stamped with its first beam and arrives after the sweep; the pose of its last beam has arrived by then.
SCAN_LAG_NS = 100 * MILLISECOND_NS
# Scans during the connection setup are not used, because their number depends on the machine.
CONNECTING_NS = 200 * MILLISECOND_NS
# Delay from the stamp of a map to its use.
MAP_LAG_NS = 100 * MILLISECOND_NS


class LocatorSteps:
    """Executes one step at a time; inputs that arrive meanwhile wait for the next one.

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
        """Return True while scans are collected or will be soon; poses: the new ones up to the tick."""
        self._poses.extend(poses)
        if self._running is None:
            self._add_poses()
            self._wanted = self._locator.wants_scans(inputs)
        return self._wanted

    def estimate(self, inputs: Inputs) -> Estimate:
        """Return the newest estimate at a tick; exceptions of the locator are raised here."""
        self._scans.extend(inputs.scans)
        if self._running is None:
            scans, self._scans = self._scans, []
            self._running = self._executor.submit(self._locator.step, replace(inputs, scans=scans))
        try:
            # Before the first estimate, there is nothing to repeat, so wait without a limit.
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
    """Time from which on scans are used while they are requested."""

    def __init__(self) -> None:
        self._usable_from_ns: Optional[int] = None

    def follow(self, tick_ns: int, wanted: bool) -> None:
        """Update the request at a tick."""
        if not wanted:
            self._usable_from_ns = None
            return
        latest_ns = tick_ns + CONNECTING_NS
        # A clock that was set back must not block the scans until it reaches the old time again.
        self._usable_from_ns = latest_ns if self._usable_from_ns is None else min(self._usable_from_ns, latest_ns)

    def counts(self, stamp_ns: int) -> bool:
        """Return True for a scan that is used."""
        return self._usable_from_ns is not None and stamp_ns >= self._usable_from_ns


def is_map_due(stamp_ns: int, tick_ns: int) -> bool:
    """Return True if a map is used at a tick, independent of the poses."""
    return stamp_ns + MAP_LAG_NS <= tick_ns
