"""Possible motion of the robot, for which the view needs a stop: from its reports and its orders."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

from mtr_operator.domain.robot_status import Mode, MotionSource, RobotStatus

# Below these speeds the robot counts as stopped: noise of its estimate.
STANDING_MPS, STANDING_RADPS = 0.02, 0.02
# Wall time for which an order counts as active although the robot does not show it yet, or pauses.
ORDER_PATIENCE_S = 3.0
# A lift that moves less than this between two Statuses counts as stopped.
_LIFT_NOISE_M = 0.0005
ROUNDS = (Mode.MAPPING_CAR, Mode.CHECKING_CAR)


def is_driving(status: RobotStatus) -> bool:
    """Return True if the wheels turn, also by other causes."""
    return abs(status.speed_mps) > STANDING_MPS or abs(status.yaw_rate_radps) > STANDING_RADPS or \
        status.motion_source in (MotionSource.MANUAL, MotionSource.PLANNER)


class Motion:
    """Orders of the Operator between two tests; belongs to the view's thread. Times are of one clock, s."""

    def __init__(self) -> None:
        self._since_s = -math.inf
        self._is_ordered = False
        self._status: RobotStatus | None = None

    def order(self, now_s: float) -> None:
        """Record an order with motion: to map or check the Car, or to move lift or servos."""
        self._since_s, self._is_ordered = now_s, True

    def stop(self) -> None:
        """Record a stop or the end of a test; the robot may still report mapping or checking although it is stopped."""
        self._since_s, self._is_ordered = -math.inf, False

    def learn(self, status: RobotStatus, now_s: float) -> None:
        """Record the newest Status."""
        before, self._status = self._status, status
        if before is not None and self._is_ordered and _moves_key(before, status):
            self._since_s = now_s

    def goes_round(self, mode: Mode) -> bool:
        """Return True while the robot maps or checks the Car (mode); without an order its reported mode alone does not
        count."""
        status = self._status
        return status is not None and status.mode is mode and (self._is_ordered or is_driving(status))

    def is_possible(self, now_s: float) -> bool:
        """Return True while the robot may move."""
        status = self._status
        ordered = now_s - self._since_s < ORDER_PATIENCE_S
        return ordered or (status is not None and (is_driving(status) or any(map(self.goes_round, ROUNDS))))


def _moves_key(before: RobotStatus, after: RobotStatus) -> bool:
    lifted = abs(after.key_height_m - before.key_height_m) > _LIFT_NOISE_M
    return lifted or bool(after.pressed_buttons)
