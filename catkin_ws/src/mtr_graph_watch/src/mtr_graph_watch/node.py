"""Node that watches the graph: it does not start in an open one, and locks motion if one is opened later."""
# SPDX-License-Identifier: Apache-2.0
import os
import threading
import time
from typing import List

import rospy

from mtr_core import names
from mtr_core.errors import RobotError
from mtr_core.lockstep import Ticker, clock, publisher, run_node
from mtr_core.problems import NO_PROBLEM, Problem, ProblemError, messages_of
from mtr_core.schedule import slot
from mtr_msgs import msg

from .judge import Verdict
from .look import CannotLook, Master, seen
from .parameters import Parameters

OWNER = "graph_watch"
# Slot between the state machine and the next tick of the dispatcher; in lock-step no node waits for it.
GRAPH_WATCH = slot(100, 80)


class GraphWatchNode:
    """Publisher of a motion lock at each tick, from the result of another thread: a slow master does not delay the
    lock."""

    def __init__(self, parameters: Parameters):
        """Check once; ProblemError if the graph is open without permission, RobotError if it cannot be checked."""
        self._parameters = parameters
        self._master = Master(os.environ["ROS_MASTER_URI"])
        self._verdict = Verdict(time.monotonic())
        self._said: List[Problem] = []
        self._locked = NO_PROBLEM
        try:
            self._look()
        except CannotLook as error:
            raise RobotError(str(error)) from error
        if self._verdict.openings and not parameters.open_graph:
            raise ProblemError(self._verdict.openings[0])
        self._lock = publisher(names.MOTION_LOCK, msg.MotionLock)
        self._ticker = Ticker(GRAPH_WATCH)
        threading.Thread(target=self._run, name="graph watch", daemon=True).start()

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._publish(self._ticker.sleep())

    def _publish(self, tick: int) -> None:
        why = NO_PROBLEM if self._parameters.open_graph else self._verdict.problem(time.monotonic())
        lock = msg.MotionLock(owner=OWNER, engaged=bool(why), reason=why.text, problems=messages_of(why, msg.Problem))
        lock.header.stamp = clock.stamp_of(tick)
        self._lock.publish(lock)
        if why.kind != self._locked.kind:
            rospy.loginfo("Motion %s", f"locked: {why}" if why else "allowed by the watch of the ROS graph.")
            self._locked = why

    def _run(self) -> None:
        while not rospy.is_shutdown():
            time.sleep(self._parameters.look_period_s)
            try:
                self._look()
            except CannotLook as error:
                rospy.logwarn_throttle(30.0, str(error))
            except Exception as error:  # A thread that ended would leave an outdated verdict.
                rospy.logerr_throttle(30.0, f"The ROS graph cannot be looked at: {error!r}.")

    def _look(self) -> None:
        self._verdict.saw(seen(self._master), time.monotonic())
        found = self._verdict.openings
        for each in found:
            if each not in self._said:
                rospy.logerr("%s%s", each, " It was chosen (open_graph)." if self._parameters.open_graph else "")
        if self._said and not found:
            rospy.loginfo("The ROS graph is closed again.")
        self._said = list(found)


def main() -> int:
    """Run the node; return its exit status."""
    return run_node(OWNER, Parameters, GraphWatchNode)
