"""Plays the inputs of a recording, and waits for the nodes that decide anew.

A robot's messages are played when the recorder received them. A simulated clock in lock-step waits for the robot's
nodes and not for the recorder, which on a busy machine receives late, one topic more than another: then each message is
played at its own stamp.
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

from mtr_core import names
from mtr_core.liveness import NS
from mtr_core.schedule import CAR_LOCATOR, STATE_MACHINE
from mtr_msgs.msg import CarEstimate, LocalizedPose, RobotMode

from .listening import is_listening
from .pace import Follower, Pace
from .profiles import REPLAYED, CannotReplay

# Between one and two, see Follower.
LAG_PERIODS = 1.5
# Localization answers each odometry message; the other two speak at their ticks.
FOLLOWERS = {LocalizedPose: Follower(names.LOCALIZED_POSE, 0.1, names.WHEEL_ODOMETRY),
             CarEstimate: Follower(names.CAR_ESTIMATE, LAG_PERIODS * CAR_LOCATOR.period_ns * NS),
             RobotMode: Follower(names.ROBOT_MODE, LAG_PERIODS * STATE_MACHINE.period_ns * NS)}
LISTENERS = ("/localization", "/car_locator", "/state_machine")
# Steady time after which a silent node is left behind, and within which all of them have to have started.
PATIENCE_S, START_LIMIT_S = 10.0, 60.0
CLOCK_STEP_S = 0.01
# Recorded time before the first message, in which the nodes' ticks begin.
LEAD_S = 1.0
QUEUE = 100
# Written by the recorder beside the bag: its clock did not wait for it.
RECORDED_IN_LOCKSTEP = "/recorded_in_lockstep"
# The recorder is seldom so late; what it holds back for the order of the stamps fits into memory.
LATE_LIMIT_S = 5.0


class Played(NamedTuple):
    """A message of the recording. time_s: when it is played, in recorded time."""

    time_s: float
    topic: str
    message: Any


class Player:
    """Publishes /clock and the messages of the bags, at most `rate` times as fast as they were recorded.

    Attributes:
        recorder: node that is waited for, too, so that it misses nothing; None: nobody records.
    """

    def __init__(self, bags: Sequence[pathlib.Path], rate: float, recorder: Optional[str] = None):
        self._bags, self._rate, self.recorder = bags, rate, recorder
        self._topics = {rospy.resolve_name(name): name for name in REPLAYED}
        self._pace = Pace(list(FOLLOWERS.values()), PATIENCE_S)
        self._spoken = threading.Condition()
        self._clock = rospy.Publisher("/clock", Clock, queue_size=QUEUE)
        self._publishers: Dict[str, rospy.Publisher] = {}
        self._answers = [rospy.Subscriber(follower.topic, kind, self._answered, follower.topic, queue_size=QUEUE)
                         for kind, follower in FOLLOWERS.items()]

    def play(self) -> str:
        """Play to the end; a sentence about it. CannotReplay when it cannot begin."""
        opened = opened_bags(self._bags)
        try:
            self._advertise(opened)
            self._wait_for_listeners()
            return self._run(opened)
        finally:
            for bag in opened:
                bag.close()

    def _run(self, bags: List[rosbag.Bag]) -> str:
        begin_s = clock_s = min(bag.get_start_time() for bag in bags) - LEAD_S
        # A node that hears the clock late in the lead has no tick left in a lag; it begins with the next one.
        self._pace.begin(begin_s + LEAD_S)
        started_s = time.monotonic()
        for played in in_time(recorded(bags, list(self._topics)), rospy.get_param(RECORDED_IN_LOCKSTEP, False)):
            while clock_s < played.time_s and not rospy.is_shutdown():
                clock_s = min(clock_s + CLOCK_STEP_S, played.time_s)
                rospy.rostime.wallsleep(max(0.0, started_s + (clock_s - begin_s) / self._rate - time.monotonic()))
                self._wait_for_followers(clock_s)
                self._clock.publish(Clock(rospy.Time.from_sec(clock_s)))
            if rospy.is_shutdown():
                break
            self._publishers[played.topic].publish(played.message)
            with self._spoken:
                self._pace.played(self._topics[played.topic], stamp_s_of(played))
        self._wait_for_followers(clock_s)
        waited = ", ".join(f"{seconds:.0f} s for {topic}" for topic, seconds in sorted(self._pace.waited_s.items()))
        return (f"Played {clock_s - begin_s:.0f} s of the recording in {time.monotonic() - started_s:.0f} s; "
                f"waited {waited or 'for nobody'}.")

    def _answered(self, message: Any, topic: str) -> None:
        with self._spoken:
            self._pace.answered(topic, message.header.stamp.to_sec())
            self._spoken.notify_all()

    def _wait_for_followers(self, clock_s: float) -> None:
        """Until nobody is behind, or who is has been silent too long."""
        since_s: Dict[str, float] = {}
        with self._spoken:
            while not rospy.is_shutdown():
                topic = self._pace.behind(clock_s)
                if topic is None:
                    return
                before_s = time.monotonic()
                self._spoken.wait(PATIENCE_S / 10.0)
                now_s = time.monotonic()
                if self._pace.has_waited(topic, now_s - before_s, now_s - since_s.setdefault(topic, before_s)):
                    rospy.logwarn("Nothing on %s for %.0f s: the recording goes on without it; look into the log of "
                                  "the node that publishes it.", topic, PATIENCE_S)

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
        """Until the nodes have started and are connected with what is played."""
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


def opened_bags(paths: Sequence[pathlib.Path]) -> List[rosbag.Bag]:
    """The bags, or CannotReplay with a sentence."""
    opened: List[rosbag.Bag] = []
    for path in paths:
        try:
            opened.append(rosbag.Bag(str(path)))
        except (rosbag.ROSBagException, OSError) as error:
            for bag in opened:
                bag.close()
            raise CannotReplay(f"{path} cannot be read: {error}.") from None
    return opened


def recorded(bags: Sequence[rosbag.Bag], topics: Sequence[str]) -> Iterator[Played]:
    """Messages of these topics in the order of their recording, from bags in any order."""
    streams = [bag.read_messages(topics=topics) for bag in bags]
    for topic, message, stamp in heapq.merge(*streams, key=lambda read: read.timestamp.to_nsec()):
        yield Played(stamp.to_sec(), topic, message)


def in_time(played: Iterable[Played], by_stamps: bool) -> Iterator[Played]:
    """What was recorded, each at its own stamp and in this order when by_stamps; a stamp that lies
    LATE_LIMIT_S and more from its receipt says nothing about when it was sent."""
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
    """Of the message itself, which a node answers; of the recording where it has none."""
    header = getattr(played.message, "header", None)
    return played.time_s if header is None else float(header.stamp.to_sec())
