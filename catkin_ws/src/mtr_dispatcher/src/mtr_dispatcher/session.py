"""Control of the robot by one application: accepted Commands and the desired state."""
# SPDX-License-Identifier: Apache-2.0
import enum
import math
from dataclasses import dataclass
from typing import Dict, Optional, Tuple

from mtr_core.liveness import NS, is_fresh
from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_PRESS, NO_WAYPOINT, DesiredState
from mtr_core.schedule import DISPATCHER

from . import problems
from .command import Command, problem_of
from .order_numbers import OrderNumbers
from .parameters import Parameters

# An application that has lost control may still send, and earlier messages may still arrive. A forgotten window does so
# for days, while each test of another laptop opens two sessions.
REMEMBERED_SESSIONS = 1000
# An id counts content changes, at most a few per second. Fewer than MAX_ID_STEP occur during an interruption of the
# link, and no application starts with an id above MAX_FIRST_ID.
MAX_ID_STEP = 1000
MAX_FIRST_ID = 10 ** 9


class CommandResult(enum.Enum):
    """Result of a received Command."""

    TAKEN = "taken"            # new content
    REPEATED = "repeated"      # keeps the link alive
    OUTDATED = "outdated"      # older than the newest accepted Command, or of a former session
    EXPIRED = "expired"        # answers a Status that is too old or unknown, or its id is out of sequence
    FOREIGN = "foreign"        # another application controls the robot
    REFUSED = "refused"        # unacceptable content; the robot stops
    ENDED = "ended"            # end of the session
    FORBIDDEN = "forbidden"    # the sender lacks permission
    WATCHED = "watched"        # no claim to control; the Operator's stop can reach the robot


# Commands without effect that are counted as rejected.
REJECTIONS = (CommandResult.EXPIRED, CommandResult.FOREIGN, CommandResult.REFUSED)


@dataclass(frozen=True)
class SessionState:
    """Desired state. stop_reason is empty if the robot may move; without a session, only by manual control.

    speed_limit_mps: limit while the link is silent for a while, otherwise infinite.
    service: cause for which wheels, lift and servos are disabled; no problem outside service mode.
    """

    session_id: int
    command: Command
    map_order: int
    check_order: int
    link_alive: bool
    stop_reason: Problem
    speed_limit_mps: float = math.inf
    service: Problem = NO_PROBLEM


class ControlSession:
    """Lets one application control the robot; one that has lost control needs a new session to regain it.

    Attributes:
        session_id: session of the application in control, 0 for none.
        owner: key that opened its session; empty on a link without keys.
        command: newest accepted Command.
        refusal: why the newest Command was refused; no problem if it was accepted.
        answered_status_id: newest Status answered by the application in control, or without one by a watching one.
        map_orders: numbers of the orders to map the Car.
        check_orders: numbers of the orders to check the Car.
    """

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self.session_id = 0
        self.owner = ""
        self.command = Command()
        self.refusal = NO_PROBLEM
        self.answered_status_id = 0
        self._is_fast = False
        self.map_orders, self.check_orders = OrderNumbers(), OrderNumbers()
        self._newest_id = 0
        self._seen_s = self._watched_s = -math.inf
        self._former: Dict[int, str] = {}

    def owner_of(self, session_id: int) -> Optional[str]:
        """Return the key that opened a current or former session, or None if the session is unknown."""
        return self.owner if session_id == self.session_id else self._former.get(session_id)

    def take(self, command: Command, now_s: float, answered_s: Optional[float], key: str = "") -> CommandResult:
        """Judge a Command that arrived at now_s; answered_s is the send time of the Status that it answers, or None.

        Both are times of the steady clock. key: of the sender, who owns the Command's session unless it is new; empty
        on a link without keys.
        """
        if command.watches and command.session_id != self.session_id:
            return self._watch(command, now_s, answered_s)
        return self._judge(command, now_s, answered_s, key)

    def _judge(self, command: Command, now_s: float, answered_s: Optional[float], key: str) -> CommandResult:
        if command.session_id in self._former:
            return CommandResult.OUTDATED
        if command.id - self._newest_id_of(command) > MAX_ID_STEP:
            return CommandResult.EXPIRED
        if command.end_session:
            return self._end(command, answered_s)
        if answered_s is None or not is_fresh(now_s - answered_s, self._parameters.command_lifetime_s):
            return self._take_late(command)
        if command.session_id != self.session_id and not self._hand_over(command.session_id, key, now_s):
            return CommandResult.FOREIGN
        return self._take_in_time(command, answered_s)

    def link_alive(self, now_s: float) -> bool:
        """Return True if the newest Status that the application in control has seen is younger than the time-out.

        The time-out is reduced by one period, because it is not checked between two ticks.
        """
        return bool(self.session_id) and self._is_recent(now_s, self._seen_s, self._timeout_s)

    def note_speed(self, planned_mps: float, now_s: float) -> None:
        """Note the planner's speed. A link that exceeded the shorter time-out stays dead while the robot brakes."""
        is_fast = not planned_mps <= self._parameters.fast_mps
        if is_fast or self.link_alive(now_s):
            self._is_fast = is_fast

    @property
    def _timeout_s(self) -> float:
        timeout_s = self._parameters.link_timeout_s
        return min(timeout_s, self._parameters.fast_link_timeout_s) if self._is_fast else timeout_s

    def is_watched(self, now_s: float) -> bool:
        """Return True while an application watches. Manual control is allowed then, because its Stop takes control."""
        return self._is_recent(now_s, self._watched_s, self._parameters.link_timeout_s)

    @staticmethod
    def _is_recent(now_s: float, seen_s: float, timeout_s: float) -> bool:
        return is_fresh(now_s - seen_s, timeout_s - DISPATCHER.period_ns * NS)

    def desired(self, now_s: float) -> SessionState:
        """Return the desired state at now_s."""
        alive = self.link_alive(now_s)
        map_order = self.map_orders.number_of(self.session_id, self.command.map_car_id)
        check_order = self.check_orders.number_of(self.session_id, self.command.check_car_id)
        return SessionState(self.session_id, self.command, map_order, check_order, alive,
                            self._stop_reason(alive, now_s), self._speed_limit_mps(now_s))

    def _speed_limit_mps(self, now_s: float) -> float:
        is_slow = not is_fresh(now_s - self._seen_s, self._parameters.slow_after_s)
        return self._parameters.slow_link_mps if self.session_id and is_slow else math.inf

    def _stop_reason(self, alive: bool, now_s: float) -> Problem:
        if not self.session_id:
            return NO_PROBLEM if self.is_watched(now_s) else problems.NO_APPLICATION()
        if not alive:
            return problems.APPLICATION_SILENT(limit_s=self._timeout_s)
        if self.refusal:
            return problems.COMMAND_REFUSED(cause=self.refusal)
        return problems.STOPPED_BY_OPERATOR() if self.command.stop else NO_PROBLEM

    def _take_in_time(self, command: Command, answered_s: float) -> CommandResult:
        self.answered_status_id = max(self.answered_status_id, command.seen_status_id)
        if command.id < self._newest_id:
            return CommandResult.OUTDATED
        # The application has seen the robot's state of that time, not of the arrival time.
        self._seen_s = max(self._seen_s, answered_s)
        return self._accept(command)

    def _accept(self, command: Command) -> CommandResult:
        if command.id == self._newest_id:
            return CommandResult.REFUSED if self.refusal else CommandResult.REPEATED
        self._newest_id = command.id
        self.refusal = problem_of(command, self._parameters.platform_speed_mps)
        if self.refusal:
            return CommandResult.REFUSED
        self.command = command
        return CommandResult.TAKEN

    def _watch(self, command: Command, now_s: float, answered_s: Optional[float]) -> CommandResult:
        if answered_s is None or not is_fresh(now_s - answered_s, self._parameters.command_lifetime_s):
            return CommandResult.OUTDATED
        self._watched_s = max(self._watched_s, answered_s)
        if not self.session_id:
            self.answered_status_id = max(self.answered_status_id, command.seen_status_id)
        return CommandResult.WATCHED

    def _take_late(self, command: Command) -> CommandResult:
        """Reject a late Command; a late stop of the session in control still stops the robot."""
        if command.stop and command.session_id == self.session_id and command.id > self._newest_id:
            self._accept(command)
        return CommandResult.EXPIRED

    def _hand_over(self, session_id: int, key: str, now_s: float) -> bool:
        silent = now_s - self._seen_s > self._parameters.takeover_after_s
        if self.session_id and not silent:
            return False
        self._become_former()
        self.session_id, self.owner, self.command, self.refusal = session_id, key, Command(), NO_PROBLEM
        self._newest_id = self.answered_status_id = 0
        self._seen_s = -math.inf
        return True

    def _end(self, command: Command, answered_s: Optional[float]) -> CommandResult:
        # A goodbye only stops the robot, so it may answer any Status whose send time is stored.
        if answered_s is None:
            return CommandResult.EXPIRED
        if command.session_id != self.session_id or command.id < self._newest_id:
            return CommandResult.OUTDATED
        self.answered_status_id = max(self.answered_status_id, command.seen_status_id)
        self._become_former()
        self.session_id, self.owner, self.command, self.refusal, self._newest_id = 0, "", Command(), NO_PROBLEM, 0
        return CommandResult.ENDED

    def _newest_id_of(self, command: Command) -> int:
        """Return the newest id of the Command's session, or the highest allowed first id if it is not in control."""
        return self._newest_id if command.session_id == self.session_id else MAX_FIRST_ID

    def _become_former(self) -> None:
        if self.session_id:
            self._former[self.session_id] = self.owner
            if len(self._former) > REMEMBERED_SESSIONS:
                del self._former[next(iter(self._former))]


def desired_state(desired: SessionState, default_speed_mps: float, area_problem: Problem = NO_PROBLEM
                  ) -> DesiredState:
    """Return the desired state for the other nodes, with defaults for the choices left open by the Command."""
    command = desired.command
    speed_mps = default_speed_mps if command.max_speed_mps is None else command.max_speed_mps
    return DesiredState(
        session_id=desired.session_id, command_id=command.id, link_alive=desired.link_alive,
        stop=bool(desired.stop_reason or desired.service) or not desired.link_alive,
        waypoint=command.waypoint or NO_WAYPOINT,
        max_speed_mps=min(speed_mps, desired.speed_limit_mps),
        key_height_m=math.nan if command.key_height_m is None else command.key_height_m,
        press=command.press or NO_PRESS, map_car_id=desired.map_order, check_car_id=desired.check_order,
        resume_hold_id=command.resume_hold_id, area_problem=area_problem)


def is_same(one: Optional[SessionState], other: SessionState) -> bool:
    """Return True if both states request the same; a repeated Command changes nothing."""
    return one is not None and _order(one) == _order(other)


def _order(state: SessionState) -> Tuple[int, bool, Problem, int, float, Problem]:
    return (state.session_id, state.link_alive, state.stop_reason, state.command.id, state.speed_limit_mps,
            state.service)
