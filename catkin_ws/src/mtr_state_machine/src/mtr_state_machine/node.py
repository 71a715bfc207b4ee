"""The state machine's node: wires the topics to the core."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from typing import Optional, Tuple

import rospy

from mtr_core import names, schedule
from mtr_core.liveness import NS
from mtr_core.lockstep import ANY_NODE, PublisherWatch, Ticker, TickInput, clock, publisher, run_node
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_GOAL_ID, Goal, GoalId
from mtr_core.states import State
from mtr_msgs.msg import (
    CarCheck,
    CarEstimate,
    DesiredState,
    DriveStatus,
    LocalizedPose,
    MotionLock,
    MotionStatus,
    PeripheralsState,
    RobotMode,
)

from . import problems
from .conversions import lock_message, mode_message, observation
from .core import Decision, StateMachine
from .emergency import EmergencyWatch
from .observation import Part
from .parameters import Parameters

# Queue of motion locks; each owner publishes ten times a second.
LOCKS_QUEUED = 50


class StateMachineNode:
    """Decides at each tick of its slot."""

    def __init__(self, parameters: Parameters):
        self._core = StateMachine(parameters)
        self._logged: Tuple[Optional[State], Tuple[str, ...], GoalId] = (None, (), NO_GOAL_ID)
        self._inputs = {
            Part.DISPATCHER: TickInput(names.DESIRED_STATE, DesiredState, schedule.DISPATCHER),
            Part.LOCALIZATION: TickInput(names.LOCALIZED_POSE, LocalizedPose, schedule.LOCALIZATION, lag_ns=0),
            Part.CAR_LOCATOR: TickInput(names.CAR_ESTIMATE, CarEstimate, schedule.CAR_LOCATOR),
            Part.MOTION_PLANNER: TickInput(names.MOTION_STATUS, MotionStatus, schedule.MOTION_PLANNER),
            Part.DRIVE_CONTROL: TickInput(names.DRIVE_STATUS, DriveStatus, schedule.DRIVE_CONTROL),
            Part.PERIPHERALS: TickInput(names.PERIPHERALS_STATE, PeripheralsState, schedule.PERIPHERALS),
        }
        self._check = TickInput(names.CAR_CHECK, CarCheck, schedule.CAR_LOCATOR)
        self._emergency = EmergencyWatch()
        self._locks = rospy.Subscriber(names.MOTION_LOCK, MotionLock, self._take_lock, queue_size=LOCKS_QUEUED,
                                       tcp_nodelay=True)
        self._mode = publisher(names.ROBOT_MODE, RobotMode)
        self._lock = publisher(names.MOTION_LOCK, MotionLock)
        self._watch = PublisherWatch({**dict.fromkeys((*names.MOTION_INPUTS, *names.MOTION_STATES), ANY_NODE),
                                      names.ROBOT_MODE: rospy.get_name(),
                                      # Without a stop chain the topic has no publisher; the first would be accepted.
                                      names.STOP_INPUT: "peripherals"})
        self._ticker = Ticker(schedule.STATE_MACHINE, lambda text: rospy.logerr("%s", text))

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            self._step(self._ticker.sleep())

    def _step(self, tick: int) -> None:
        messages = {part: topic.at(tick) for part, topic in self._inputs.items()}
        ages_s = {part: topic.age_s(tick) for part, topic in self._inputs.items()}
        seen = observation(messages, self._check.at(tick), ages_s, clock.steady_at(tick) * NS, self._emergency.now())
        decision = self._core.step(replace(seen, intrusion=self._intrusion()))
        stamp = clock.stamp_of(tick)
        self._lock.publish(lock_message(decision, stamp))
        self._mode.publish(mode_message(decision, stamp))
        self._log(decision)

    def _intrusion(self) -> Problem:
        intruder = self._watch.intruder
        return problems.SECOND_PUBLISHER(**intruder._asdict()) if intruder else NO_PROBLEM

    def _take_lock(self, message: MotionLock) -> None:
        if message.emergency:
            self._emergency.take(message.owner, message.engaged)

    def _log(self, decision: Decision) -> None:
        now = (decision.state, decision.lock_reason.kind, decision.goal.id)
        if now[:2] != self._logged[:2]:
            log = rospy.logwarn if decision.state is State.FAULT else rospy.loginfo
            log("%s. %s", decision.state.name, decision.message)
        elif now != self._logged:
            self._log_goal(decision.goal)
        self._logged = now

    @staticmethod
    def _log_goal(goal: Goal) -> None:
        waypoint, pose = goal.waypoint, goal.waypoint.pose
        rospy.loginfo("Goal %d of %s: %.2f %.2f %.2f in %s", waypoint.id, waypoint.requester or "nobody", pose.x,
                      pose.y, pose.heading, waypoint.frame)


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("state_machine", Parameters, StateMachineNode)
