"""The rate of a periodic node: a held clock does not pass a tick before the node's work is done."""
# SPDX-License-Identifier: Apache-2.0
import time
from typing import Callable, Optional

import rospy
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.schedule import SIMULATION_START_NS, Slot

from . import clock
from .publishers import direct_publisher

# Wall time after which a missing simulator is reported.
MISSED_AFTER_WALL_S = 15.0
NO_CLOCK = ("Simulated time does not begin: /use_sim_time is set and nobody publishes /clock. Start the simulator, or "
            "set /use_sim_time to false on a robot.")
NOT_HELD = (f"Nobody waits for the nodes: /lockstep is set, and the simulator does not listen to {names.SIM_HOLD}. Set "
            "/lockstep to false for a simulator that goes on by itself.")


class Ticker:
    """Wakes at the ticks of a slot of the schedule.

    In lock-step and in a replay each sleep first publishes a hold. Its frame_id is the node, its stamp the node's next
    tick, its seq the number of messages sent to the simulator so far. The simulator does not advance past the stamp and
    waits until the messages have arrived; a replay's player only waits for the stamp. Otherwise nothing is published.

    Attributes:
        messages_sent: messages sent to the simulator since the start; the owner increments it.
    """

    def __init__(self, slot: Slot, on_missed_simulator: Optional[Callable[[str], None]] = None,
                 wall_clock: Callable[[], float] = time.monotonic):
        """on_missed_simulator: called once with a sentence about missing simulated time."""
        self._slot = slot
        self._tell_missed, self._wall_clock = on_missed_simulator, wall_clock
        self._begun_wall_s = wall_clock()
        self.messages_sent = 0
        self._tick_ns = SIMULATION_START_NS
        self._holds = None
        if clock.is_held():
            self._holds = direct_publisher(names.SIM_HOLD, Header, latch=True)

    def sleep(self) -> int:
        """Wait for the next tick and return it in ns of the ROS clock; rospy.ROSInterruptException on shutdown.

        A node that exceeded its period continues at the next future tick. The same applies if it was suspended or its
        clock was set while it waited: missed ticks are skipped.
        """
        while True:
            # Before the first /clock the time is zero, but no tick is earlier than the start of the simulated clock.
            now = max(clock.now_ns(), SIMULATION_START_NS) if self._holds else clock.now_ns()
            self._tick_ns = self._slot.next_after(now)
            self.renew()
            clock.wait_until(self._tick_ns, self._look_for_simulator)
            self._look_for_simulator()
            if abs(clock.now_ns() - self._tick_ns) < self._slot.period_ns:
                return self._tick_ns

    def _look_for_simulator(self) -> None:
        if self._tell_missed is None or self._wall_clock() - self._begun_wall_s < MISSED_AFTER_WALL_S:
            return
        if clock.is_simulated() and not clock.now_ns():
            self._tell_missed(NO_CLOCK)
        elif self._holds and not self._holds.get_num_connections():
            self._tell_missed(NOT_HELD)
        self._tell_missed = None

    def renew(self) -> None:
        """Publish the present hold again: a sign of life of a node that intentionally stops simulated time."""
        if self._holds:
            self._holds.publish(Header(self.messages_sent, clock.stamp_of(self._tick_ns), rospy.get_name()))
