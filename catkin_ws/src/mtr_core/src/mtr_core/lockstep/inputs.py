"""A topic as input of a periodic node."""
# SPDX-License-Identifier: Apache-2.0
from typing import Any, Optional

import rospy

from mtr_core.schedule import CLOCK_STEP, PRODUCER_LOST_AFTER_WALL_S, Slot

from . import clock
from .samples import Samples

# Tests that silence many producers set less patience; the C++ nodes read the same parameter.
PATIENCE_PARAMETER = "/lockstep_patience_s"


class TickInput:
    """Subscription to a periodic topic with a header; `at(tick)` gives the message to use at a tick.

    In simulation it waits for the message that is due at that tick, so that the outcome does not depend on the speed
    of the machine. On the robot's own clock it is the newest message.
    """

    def __init__(self, topic: str, message_type: Any, slot: Slot, lag_ns: int = CLOCK_STEP.period_ns):
        self._samples: Samples[Any] = Samples(slot, lag_ns, waits=clock.is_simulated())
        self._samples.patience_s = rospy.get_param(PATIENCE_PARAMETER, PRODUCER_LOST_AFTER_WALL_S)
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=50, tcp_nodelay=True)

    def at(self, tick_ns: int) -> Optional[Any]:
        """Message to use at the tick, None before the first one."""
        return self._samples.at(tick_ns)

    def _take(self, message: Any) -> None:
        self._samples.add(message.header.stamp.to_nsec(), message)
        self._samples.wait_until_wanted()
