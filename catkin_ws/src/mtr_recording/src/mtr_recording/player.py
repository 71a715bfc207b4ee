"""Plays the inputs of a recording, and waits for the replayed nodes.

Messages of a robot are played at their reception by the recorder. A simulated clock in lock-step waits for the robot's
nodes but not for the recorder, which on a busy machine receives late, with different delays per topic. In this case
each message is played at its own stamp.
"""
# SPDX-License-Identifier: Apache-2.0
import heapq
import operator
import pathlib
import threading
import time
from typing import Any, Dict, Iterable, Iterator, List, NamedTuple, Optional, Sequence, Tuple

import rosbag
import rosgraph
import roslib.message
import rospy
from rosgraph_msgs.msg import Clock
from std_msgs.msg import Header

from mtr_core import names
from mtr_core.bags.diagnosis import unreadable
from mtr_core.liveness import NS
from mtr_core.lockstep.clock import stamp_of
from mtr_core.schedule import MILLISECOND_NS
from mtr_msgs.msg import LocalizedPose

from .listening import is_listening
from .pace import Follower, Pace
from .profiles import REPLAYED, CannotReplay

# Localization answers each odometry message; the other two work at their ticks.
FOLLOWER = Follower(names.LOCALIZED_POSE, names.WHEEL_ODOMETRY, 100 * MILLISECOND_NS)
HOLDERS = ["/car_locator", "/state_machine"]
LISTENERS = ("/localization", *HOLDERS)
# Steady time after which a silent node is ignored, and time limit for the start of all nodes. On a busy machine a map
# has needed more than 15 s.
PATIENCE_S, START_LIMIT_S = 60.0, 60.0
CLOCK_STEP_NS = 10 * MILLISECOND_NS
# Recorded time before the first message, in which the nodes' ticks start.
LEAD_NS = 1000 * MILLISECOND_NS
QUEUE = 100
# Written by the recorder next to the bag: its clock did not wait for it.
RECORDED_IN_LOCKSTEP = "/recorded_in_lockstep"
# Longer delays of the recorder are rare; messages held back for the order of the stamps fit into memory.
LATE_LIMIT_S = 5.0


class Played(NamedTuple):
    """Message of the recording. time_s: time of its playback, in recorded time."""

    time_s: float
    topic: str
    message: Any


class Player:
    """Publisher of /clock and the messages of the bags, at most `rate` times as fast as recorded.

    Attributes:
        recorder: node whose connections are awaited too, so that it receives everything; None without a recorder.
    """

    def __init__(self, bags: Sequence[pathlib.Path], rate: float, recorder: Optional[str] = None):
        self._bags, self._rate, self.recorder = bags, rate, recorder
        self._topics = {rospy.resolve_name(name): name for name in REPLAYED}
        self._pace = Pace(FOLLOWER, HOLDERS, PATIENCE_S)
        self._spoken = threading.Condition()
        # Latched for nodes that connect while the clock is stopped.
        self._clock = rospy.Publisher("/clock", Clock, queue_size=QUEUE, latch=True)
        self._publishers: Dict[str, rospy.Publisher] = {}
        self._voices = [
            rospy.Subscriber(FOLLOWER.topic, LocalizedPose, self._answered, queue_size=QUEUE, tcp_nodelay=True),
            rospy.Subscriber(names.SIM_HOLD, Header, self._held, queue_size=QUEUE, tcp_nodelay=True)]

    def play(self) -> str:
        """Play to the end; return a sentence about it. CannotReplay if it cannot start."""
        opened = opened_bags(self._bags)
        try:
            self._advertise(opened)
            self._wait_for_listeners()
            return self._run(opened)
        finally:
            for bag in opened:
                bag.close()

    def _run(self, bags: List[rosbag.Bag]) -> str:
        begin_ns = min(_ns(bag.get_start_time()) for bag in bags) - LEAD_NS
        started_s, clock_ns = time.monotonic(), begin_ns
        # The nodes' ticks start with this message.
        self._clock.publish(Clock(stamp_of(clock_ns)))
        for played in in_time(recorded(bags, list(self._topics)), rospy.get_param(RECORDED_IN_LOCKSTEP, False)):
            while clock_ns < _ns(played.time_s) and not rospy.is_shutdown():
                clock_ns = self._step(clock_ns, min(clock_ns + CLOCK_STEP_NS, _ns(played.time_s)),
                                      started_s - begin_ns * NS / self._rate)
            if rospy.is_shutdown():
                break
            self._publishers[played.topic].publish(played.message)
            with self._spoken:
                self._pace.played(self._topics[played.topic], _ns(stamp_s_of(played)))
        self._wait_for_followers(clock_ns)
        waited = ", ".join(f"{seconds:.0f} s for {name}" for name, seconds in sorted(self._pace.waited_s.items()))
        return (f"Played {(clock_ns - begin_ns) * NS:.0f} s of the recording in {time.monotonic() - started_s:.0f} s; "
                f"waited {waited or 'for nobody'}.")

    def _step(self, clock_ns: int, until_ns: int, zero_s: float) -> int:
        """Advance the clock, at most to until_ns, when it is due and all nodes have followed; return its time.

        zero_s: steady time of the recording's zero.
        """
        rospy.rostime.wallsleep(max(0.0, zero_s + until_ns * NS / self._rate - time.monotonic()))
        self._wait_for_followers(clock_ns)
        with self._spoken:
            next_ns = self._pace.next_ns(clock_ns, until_ns)
        self._clock.publish(Clock(stamp_of(next_ns)))
        return next_ns

    def _answered(self, message: LocalizedPose) -> None:
        with self._spoken:
            self._pace.answered(message.header.stamp.to_nsec())
            self._spoken.notify_all()

    def _held(self, message: Header) -> None:
        with self._spoken:
            self._pace.held(message.frame_id, message.stamp.to_nsec())
            self._spoken.notify_all()

    def _wait_for_followers(self, clock_ns: int) -> None:
        """Wait until all nodes have finished their work up to now, or have been silent too long."""
        since_s: Dict[str, float] = {}
        with self._spoken:
            while not rospy.is_shutdown():
                name = self._pace.behind(clock_ns)
                if name is None:
                    return
                before_s = time.monotonic()
                self._spoken.wait(1.0)
                now_s = time.monotonic()
                if self._pace.has_waited(name, now_s - before_s, now_s - since_s.setdefault(name, before_s)):
                    rospy.logwarn("Nothing from %s for %.0f s: the recording goes on without it; look into the log of "
                                  "that node, or of the one that publishes it.", name, PATIENCE_S)

    def _advertise(self, bags: List[rosbag.Bag]) -> None:
        found = {topic: about for bag in bags
                 for topic, about in bag.get_type_and_topic_info(list(self._topics)).topics.items()}
        missing = rospy.resolve_name(names.WHEEL_ODOMETRY)
        if missing not in found:
            raise CannotReplay(f"The recording has no {missing}, the odometry of the base; record with the profile "
                               "full, or name its topic (wheel_odometry:=).")
        self._publishers = {topic: rospy.Publisher(topic, roslib.message.get_message_class(about.msg_type),
                                                   queue_size=QUEUE) for topic, about in found.items()}

    def _wait_for_listeners(self) -> None:
        """Wait until the nodes have started and are connected to the played topics."""
        master, end_s = rosgraph.Master(rospy.get_name()), time.monotonic() + START_LIMIT_S
        odometry = rospy.resolve_name(names.WHEEL_ODOMETRY)
        while not rospy.is_shutdown():
            _, listening, _ = master.getSystemState()
            nodes = {topic: set(who) for topic, who in listening}
            late = [node for node in LISTENERS if node not in nodes.get("/clock", set())]
            if odometry in self._publishers and LISTENERS[0] not in nodes.get(odometry, set()):
                late.append(LISTENERS[0])
            if self.recorder is not None and not is_listening(self.recorder):
                late.append(self.recorder)
            unheard = [topic for topic, publisher in self._publishers.items()
                       if publisher.get_num_connections() < len(nodes.get(topic, set()) & set(LISTENERS))]
            if not late and not unheard:
                return
            if time.monotonic() > end_s:
                raise CannotReplay(f"{' and '.join(late or unheard)} did not start within {START_LIMIT_S:.0f} s; look "
                                   "into the log.")
            rospy.rostime.wallsleep(0.1)


def _ns(time_s: float) -> int:
    return round(time_s * 1e9)


def opened_bags(paths: Sequence[pathlib.Path]) -> List[rosbag.Bag]:
    """Return the opened bags, or raise CannotReplay with a sentence."""
    opened: List[rosbag.Bag] = []
    for path in paths:
        try:
            opened.append(rosbag.Bag(str(path)))
        except Exception as error:
            for bag in opened:
                bag.close()
            raise CannotReplay(unreadable(path, error)) from None
    return opened


def recorded(bags: Sequence[rosbag.Bag], topics: Sequence[str]) -> Iterator[Played]:
    """Yield messages of these topics in the order of their recording, from bags in any order."""
    streams = [bag.read_messages(topics=topics) for bag in bags]
    for topic, message, stamp in heapq.merge(*streams, key=lambda read: read.timestamp.to_nsec()):
        yield Played(stamp.to_sec(), topic, message)


def in_time(played: Iterable[Played], by_stamps: bool) -> Iterator[Played]:
    """Yield the recorded messages; with by_stamps each at its own stamp and in this order. A stamp that differs from
    the reception by LATE_LIMIT_S or more does not show the time of sending."""
    if not by_stamps:
        yield from played
        return
    waiting: List[Tuple[float, int, Played]] = []
    for number, one in enumerate(played):
        stamp_s = stamp_s_of(one)
        time_s = stamp_s if abs(one.time_s - stamp_s) < LATE_LIMIT_S else one.time_s
        heapq.heappush(waiting, (time_s, number, one._replace(time_s=time_s)))
        while waiting[0][0] <= one.time_s - LATE_LIMIT_S:
            yield heapq.heappop(waiting)[2]
    yield from (one for _, _, one in sorted(waiting, key=operator.itemgetter(0, 1)))


def stamp_s_of(played: Played) -> float:
    """Return the stamp of the message itself, which a node answers, or the recording time without one."""
    header = getattr(played.message, "header", None)
    return played.time_s if header is None else float(header.stamp.to_sec())
