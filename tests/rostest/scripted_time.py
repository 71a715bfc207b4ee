"""Simulated time for tests: /clock in lock-step with the nodes under test, and scripted nodes around them."""
# SPDX-License-Identifier: Apache-2.0
import copy
import threading
import time
from typing import Any, Callable, Dict, Iterable, List

import rosgraph
import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.lockstep.clock import stamp_of
from mtr_core.lockstep.publishers import direct_publisher
from mtr_core.lockstep.samples import Samples
from mtr_core.schedule import CLOCK_STEP, SIMULATION_START_NS, Slot
from mtr_msgs.msg import MotionLock
from mtr_simulation.clock.connections import wait_until_complete

STEP_NS = CLOCK_STEP.period_ns
NS = 1e-9
# Longer than a node waits for a producer that has fallen silent; wall time.
PATIENCE_WALL_S = 20.0
POLL_WALL_S = 0.01
# Before the first /clock a node may hold any time later than zero.
FIRST_HOLD_NS = 1


class Speaker:
    """A scripted topic: says its message at each tick of a slot, unless it is silent.

    Attributes:
        message: what it says; the stamp is set when it does.
        is_silent: True while it says nothing.
        heard_ns: tick at which it spoke last. spoken: messages so far.
        under_way_wall_s: wall time for which what it says is under way, as on a busy machine.
    """

    def __init__(self, topic: str, message: Any, slot: Slot):
        self.message, self.is_silent, self.heard_ns, self.spoken = message, False, 0, 0
        self.under_way_wall_s = 0.0
        self._under_way: List[threading.Timer] = []
        self._slot = slot
        self._publisher = direct_publisher(topic, type(message))

    def speak(self, tick_ns: int) -> None:
        """Say the message if it is time."""
        if not self.is_silent and self._slot.last_at(tick_ns) == tick_ns:
            self.message.header.stamp = stamp_of(tick_ns)
            self.heard_ns = tick_ns
            self._send()
            self.spoken += 1

    def _send(self) -> None:
        if self.under_way_wall_s:
            self._under_way.append(threading.Timer(self.under_way_wall_s, self._publisher.publish,
                                                   [copy.deepcopy(self.message)]))
            self._under_way[-1].start()
        else:
            self._publisher.publish(self.message)

    def arrive(self) -> None:
        """From now on nothing is under way: a later word does not overtake an earlier one."""
        for timer in self._under_way:
            timer.join()
        self._under_way.clear()
        self.under_way_wall_s = 0.0


class Listener:
    """What a node under test says, by its stamps."""

    def __init__(self, topic: str, message_type: Any, slot: Slot):
        self._samples = Samples(slot, lag_ns=0)
        # A node that itself waits for a silent producer speaks only after that.
        self._samples.patience_s = PATIENCE_WALL_S
        self._subscriber = rospy.Subscriber(topic, message_type, self._take, queue_size=50, tcp_nodelay=True)

    def at(self, tick_ns: int) -> Any:
        """Newest message stamped not later than the tick; waits for the one that is due."""
        return self._samples.at(tick_ns)

    def is_connected(self) -> bool:
        """True when somebody says something here."""
        return self._subscriber.get_num_connections() > 0

    def _take(self, message: Any) -> None:
        self._samples.add(message.header.stamp.to_nsec(), message)


class LockListener(Listener):
    """The locks of one owner, on the topic that all of them share."""

    def __init__(self, owner: str, slot: Slot):
        self._owner = owner
        super().__init__(names.MOTION_LOCK, MotionLock, slot)

    def _take(self, message: Any) -> None:
        if message.owner == self._owner:
            super()._take(message)


class Holds:
    """How far the nodes under test let the clock go; one that falls silent fails the test."""

    def __init__(self, nodes: Iterable[str]):
        self._changed = threading.Condition()
        self._holds: Dict[str, Header] = {node: Header() for node in nodes}
        self._received: Dict[str, int] = dict.fromkeys(nodes, 0)
        self._subscriber = rospy.Subscriber(names.SIM_HOLD, Header, self._hold, queue_size=50, tcp_nodelay=True)

    def count(self, message: Any) -> None:
        """A message that its node counts as one to the simulator has arrived."""
        with self._changed:
            self._received[message._connection_header["callerid"]] += 1
            self._changed.notify_all()

    def wait(self, time_ns: int) -> None:
        """Return when each node has done its work before the time; AssertionError when one does not."""
        with self._changed:
            if not self._changed.wait_for(lambda: not self._late(time_ns), PATIENCE_WALL_S):
                raise AssertionError(f"{', '.join(self._late(time_ns))} did not get to {time_ns * NS:.2f} s.")

    def _late(self, time_ns: int) -> List[str]:
        return [node for node, hold in self._holds.items()
                if hold.stamp.to_nsec() < time_ns or self._received[node] < hold.seq]

    def _hold(self, message: Header) -> None:
        with self._changed:
            self._holds[message.frame_id] = message
            self._changed.notify_all()


class ScriptedTime:
    """Takes the place of the simulator: says what the speakers have to say, then the time.

    Attributes:
        tick_ns: present simulated time.
        speakers: who speaks; a test may add one.
    """

    def __init__(self, nodes: Iterable[str], speakers: Iterable[Speaker], listeners: Iterable[Listener]):
        self.tick_ns = SIMULATION_START_NS
        self.holds = Holds(tuple(nodes))
        self.speakers, self._listeners = list(speakers), list(listeners)
        # Without a queue: the time is on its way after all that was said before.
        self._clock = direct_publisher("/clock", Clock)

    def start(self) -> None:
        """Start the clock when all nodes are there and connected, and go to the first tick that all nodes have."""
        self.holds.wait(FIRST_HOLD_NS)
        wait_for(lambda: all(listener.is_connected() for listener in self._listeners), "the nodes' topics")
        wait_until_complete(rosgraph.get_master_uri(), rospy.get_name(), threading.Event(), rospy.logwarn)
        self._clock.publish(stamp_of(self.tick_ns))
        self.advance()

    def advance(self) -> int:
        """The next tick, after everybody's work in the present one."""
        self.holds.wait(self.tick_ns + STEP_NS)
        self.tick_ns += STEP_NS
        for speaker in self.speakers:
            speaker.speak(self.tick_ns)
        self._clock.publish(stamp_of(self.tick_ns))
        return self.tick_ns

    def advance_for(self, duration_s: float) -> None:
        """Let simulated time pass."""
        for _ in range(round(duration_s / (STEP_NS * NS))):
            self.advance()

    def advance_until(self, condition: Callable[[], bool], within_s: float) -> float:
        """Simulated time until the condition holds, in s; AssertionError when it takes longer."""
        begun_ns = self.tick_ns
        while not condition():
            if (self.tick_ns - begun_ns) * NS >= within_s:
                raise AssertionError(f"It did not come to pass within {within_s:g} s of simulated time.")
            self.advance()
        return (self.tick_ns - begun_ns) * NS


def wait_for_subscriptions(node: str, topics: Iterable[str]) -> None:
    """Return when a node that holds no time has subscribed to all that it is to hear: what is said before is lost."""
    def has_all() -> bool:
        subscribers = dict(rosgraph.Master(rospy.get_name()).getSystemState()[1])
        return all(node in subscribers.get(topic, ()) for topic in topics)
    wait_for(has_all, f"what {node} subscribes to")


def wait_for(condition: Callable[[], bool], what: str) -> None:
    """Wait, by wall time, for something that comes before simulated time starts."""
    deadline = time.monotonic() + PATIENCE_WALL_S
    while not condition():
        if time.monotonic() > deadline:
            raise AssertionError(f"There is no sign of {what}.")
        rospy.rostime.wallsleep(POLL_WALL_S)
