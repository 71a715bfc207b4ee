"""The locator's steps beside the node's ticks: a fit that takes longer than a tick silences nobody."""
# SPDX-License-Identifier: Apache-2.0
import concurrent.futures
from dataclasses import replace
from typing import List, Optional, Sequence

from .estimate import Estimate, Inputs
from .locator import CarLocator
from .poses import RobotPose
from .scan import Scan

# A tick waits so long for its step before it repeats what was known: most steps are done within it.
PATIENCE_S = 0.04


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
