"""The rate of a periodic node: a simulated clock does not pass a tick before its work is done."""
# SPDX-License-Identifier: Apache-2.0
import rospy
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.schedule import SIMULATION_START_NS, Slot

from . import clock
from .publishers import direct_publisher


class Ticker:
    """Wakes at the ticks of a slot of the schedule.

    In simulation each sleep first publishes a hold: frame_id is the node, stamp its next tick, seq the number of
    messages that it has sent to the simulator so far. The simulator does not advance past the stamp and waits until
    the messages have arrived. On the robot's own clock nothing is published.

    Attributes:
        messages_sent: messages sent to the simulator since the start; the owner increments it.
    """

    def __init__(self, slot: Slot):
        self._slot = slot
        self.messages_sent = 0
        self._tick_ns = SIMULATION_START_NS
        self._holds = None
        if clock.is_simulated():
            self._holds = direct_publisher(names.SIM_HOLD, Header, latch=True)

    def sleep(self) -> int:
        """Wait for the next tick and return it in ns of the ROS clock; rospy.ROSInterruptException on shutdown.

        A node that took longer than a period goes on at the next tick that is still to come. So does one that was
        stopped, or whose clock was set, while it waited: no tick is worked off that is not the present one.
        """
        while True:
            # Before the first /clock the time is zero, but no tick lies before the start of the simulated clock.
            now = max(clock.now_ns(), SIMULATION_START_NS) if self._holds else clock.now_ns()
            self._tick_ns = self._slot.next_after(now)
            self.renew()
            clock.wait_until(self._tick_ns)
            if abs(clock.now_ns() - self._tick_ns) < self._slot.period_ns:
                return self._tick_ns

    def renew(self) -> None:
        """Say the present hold again: a sign of life of a node that has reason to let simulated time stand still."""
        if self._holds:
            self._holds.publish(Header(self.messages_sent, clock.stamp_of(self._tick_ns), rospy.get_name()))
