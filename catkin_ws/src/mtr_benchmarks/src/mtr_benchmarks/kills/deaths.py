"""Behaviour of a robot after one of its nodes was killed. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional, Sequence, Tuple

from ..faults.judge import STANDS_MPS, standstill_s

# Tolerated silence of nodes, see docs/robot-motion.md. Drive control sends zero in time after the last message of the
# first three. The state machine reports the fourth as silent after 0.5 s. The simulation has no serial bridge; the
# peripherals connect board and robot.
LIMITS_S = {"dispatcher": 0.0, "state_machine": 0.0, "motion_planner": 0.0, "peripherals": 0.5}
STANDS_S = 0.5
# Servos and tyres need up to 0.18 s after the zero velocity (measured, docs/lab-notebook/faults.md).
AFTER_ZERO_S = 0.2
# Rounding of stamps as floats; two stamps are 20 ms apart.
ROUNDING_S = 1e-6


class Kill(NamedTuple):
    """One kill of a node; times in s of the robot's clock from its last message, speeds of the fastest point.

    Attributes:
        speed_mps: speed sent to the wheels at the last message.
        stopped_s: time until zero was sent for the rest of the absence; None: it was not.
        stood_s: time until the wheels stopped, which on tyres is somewhat later.
        back_s: time until the next message; None: there was none.
        is_back: the node was restarted and has published. Also True if the test ended before that: without an
            application, simulated time stops and no node publishes.
        observed_s: length of the record after the last message; simulated time ends with the test.
    """

    node: str
    speed_mps: float
    stopped_s: Optional[float]
    stood_s: Optional[float]
    back_s: Optional[float]
    is_back: bool = True
    observed_s: float = math.inf

    @property
    def limit_s(self) -> float:
        """Longest time until zero must be sent."""
        return LIMITS_S[self.node] + STANDS_S

    @property
    def is_judged(self) -> bool:
        """True if the robot had to stop: it drove, and the node was missing for longer than the limit.

        A record that ends before that time proves nothing.
        """
        away_s = self.observed_s if self.back_s is None else self.back_s
        return self.speed_mps > STANDS_MPS and away_s > self.limit_s + ROUNDING_S

    @property
    def shows_standstill(self) -> bool:
        """False if the record ended with the test before the wheels had to be stopped."""
        return self.back_s is not None or self.observed_s > self.limit_s + AFTER_ZERO_S

    @property
    def stopped_in_time(self) -> bool:
        """True unless the robot drove on for too long."""
        return not self.is_judged or (self.stopped_s is not None and self.stopped_s <= self.limit_s + ROUNDING_S)


Speeds = Sequence[Tuple[float, float]]


def silence(words_s: Sequence[float]) -> Tuple[float, float]:
    """Return the longest silence of a node: its last message before and its first one after."""
    return max(zip(words_s, words_s[1:]), key=lambda pair: pair[1] - pair[0])


def kill_of(node: str, sent: Speeds, wheels: Speeds, last_s: float, back_s: Optional[float],
            *, is_back: bool = True) -> Kill:
    """Return the evaluation of a kill. last_s, back_s: times of the node's last message and of its next one.

    sent, wheels: speeds sent to the wheels and speeds of the wheels, each with its time.
    """
    before = [speed_mps for time_s, speed_mps in sent if time_s <= last_s]
    end_s = sent[-1][0] if back_s is None else back_s
    return Kill(node, abs(before[-1]) if before else 0.0, first_zero_s(sent, last_s, end_s),
                standstill_s(wheels, last_s, end_s), None if back_s is None else back_s - last_s,
                is_back=is_back, observed_s=end_s - last_s)


def first_zero_s(sent: Speeds, begin_s: float, end_s: float) -> Optional[float]:
    """Return the time from begin_s to the first zero after which only zeros were sent until end_s; None: there is
    none."""
    between = [(time_s, speed_mps) for time_s, speed_mps in sent if begin_s <= time_s <= end_s]
    moving = [index for index, (_, speed_mps) in enumerate(between) if speed_mps]
    first = moving[-1] + 1 if moving else 0
    return between[first][0] - begin_s if first < len(between) else None
