"""What became of a robot one of whose nodes died. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import NamedTuple, Optional, Sequence, Tuple

from ..faults.judge import STANDS_MPS, standstill_s

# For how long each may be silent, see docs/robot.md: drive control sends zero in time after the last word of the first
# three, and the state machine calls the fourth silent after 0.5 s. The simulation has no serial bridge; what stands
# between board and robot is the node of the peripherals.
LIMITS_S = {"dispatcher": 0.0, "state_machine": 0.0, "motion_planner": 0.0, "peripherals": 0.5}
STANDS_S = 0.5
# The servos and tyres need up to 0.18 s after the zero velocity (measured, docs/faults.md).
AFTER_ZERO_S = 0.2
# Of stamps as floats; two are 20 ms apart.
ROUNDING_S = 1e-6


class Kill(NamedTuple):
    """One death of a node, times in s of the robot's clock, from its last word; speeds of the fastest point.

    Attributes:
        speed_mps: that the wheels were sent then.
        stopped_s: until they were sent zero for as long as the node was away; None: they were not.
        stood_s: until they stood, which a base on tyres does somewhat later.
        back_s: until its next word; None: there was none.
        is_back: it was started again, and has said a word, unless the test came to its end meanwhile: without an
            application time stands still, and nobody says anything.
        observed_s: length of the record after the last message; the simulated time ends with the test.
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
        """Longest time until zero is sent."""
        return LIMITS_S[self.node] + STANDS_S

    @property
    def is_judged(self) -> bool:
        """True when the robot had to stop: it drove, and the node was away for longer than it may drive on.

        A record that ends before that time proves nothing.
        """
        away_s = self.observed_s if self.back_s is None else self.back_s
        return self.speed_mps > STANDS_MPS and away_s > self.limit_s + ROUNDING_S

    @property
    def shows_standstill(self) -> bool:
        """False if the record ended with the test before the wheels had to be at rest."""
        return self.back_s is not None or self.observed_s > self.limit_s + AFTER_ZERO_S

    @property
    def stopped_in_time(self) -> bool:
        """True unless the robot drove on for too long."""
        return not self.is_judged or (self.stopped_s is not None and self.stopped_s <= self.limit_s + ROUNDING_S)


Speeds = Sequence[Tuple[float, float]]


def silence(words_s: Sequence[float]) -> Tuple[float, float]:
    """The longest of a node's silences: its last word before, and its first one after."""
    return max(zip(words_s, words_s[1:]), key=lambda pair: pair[1] - pair[0])


def kill_of(node: str, sent: Speeds, wheels: Speeds, last_s: float, back_s: Optional[float],
            *, is_back: bool = True) -> Kill:
    """Of a robot whose node said its last word at a time, and the next at another.

    sent, wheels: speeds that were sent to the wheels, and theirs, each with its time.
    """
    before = [speed_mps for time_s, speed_mps in sent if time_s <= last_s]
    end_s = sent[-1][0] if back_s is None else back_s
    return Kill(node, abs(before[-1]) if before else 0.0, first_zero_s(sent, last_s, end_s),
                standstill_s(wheels, last_s, end_s), None if back_s is None else back_s - last_s,
                is_back=is_back, observed_s=end_s - last_s)


def first_zero_s(sent: Speeds, begin_s: float, end_s: float) -> Optional[float]:
    """Time from a beginning to the first zero after which nothing else was sent until an end; None: there is none."""
    between = [(time_s, speed_mps) for time_s, speed_mps in sent if begin_s <= time_s <= end_s]
    moving = [index for index, (_, speed_mps) in enumerate(between) if speed_mps]
    first = moving[-1] + 1 if moving else 0
    return between[first][0] - begin_s if first < len(between) else None
