"""Self-check of the virtual robot: it lasts some time and finds a given difference."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

from mtr_operator.domain.robot_status import CarCheck, CheckState

DURATION_S = 2.0
LIMIT_M, LIMIT_RAD = 0.02, 0.0087
_IDLE = CarCheck(limit_m=LIMIT_M, limit_rad=LIMIT_RAD)


class VirtualCheck:
    """Self-check that answers each request once.

    Attributes:
        report: as in Status.
    """

    def __init__(self, difference_m: float):
        self._difference_m = difference_m
        self._left_s = 0.0
        self.report = _IDLE

    @property
    def is_running(self) -> bool:
        """True during the check."""
        return self.report.state is CheckState.RUNNING

    def begin_session(self) -> None:
        """Discard the request of the previous session."""
        self.report = _IDLE

    def request(self, check_id: int) -> None:
        """Accept the id of the desired state; 0 means no request."""
        if check_id and check_id != self.report.id:
            self._left_s = DURATION_S
            self.report = CarCheck(check_id, CheckState.RUNNING, limit_m=LIMIT_M, limit_rad=LIMIT_RAD)

    def step(self, dt_s: float) -> None:
        """Advance the time by dt_s at rest in front of the Car."""
        if self.is_running:
            self._left_s -= dt_s
            if self._left_s <= 0.0:
                self._finish()

    def _finish(self) -> None:
        passed = self._difference_m <= LIMIT_M
        found = f"The Car stands {100.0 * self._difference_m:.1f} cm from where it was measured"
        text = f"{found}." if passed else f"{found}; allowed is {100.0 * LIMIT_M:.1f} cm. Map it again."
        self.report = CarCheck(self.report.id, CheckState.PASSED if passed else CheckState.FAILED, self._difference_m,
                               0.0, LIMIT_M, LIMIT_RAD, text)
