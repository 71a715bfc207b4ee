"""The state machine without ROS: an observation in, mode and goal out."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Hashable, Optional, Tuple

from mtr_core.problems import NO_PROBLEM, Problem
from mtr_core.requests import NO_GOAL, Goal, Waypoint
from mtr_core.states import CarState, Check, Result, State

from . import problems
from .goals import Goals, WaypointResult
from .hold import Hold, is_ordered
from .motion_signal import MotionSignal
from .observation import Observation, Part
from .parameters import Parameters
from .table import AGAIN, Event, StateTable

# More state changes in one tick than this would mean that two rows undo each other.
MAX_EVENTS_PER_TICK = 4
UNWELCOME = (Result.REFUSED, Result.BLOCKED)
LOCKED_STATES = (State.STARTING, State.FAULT)
# A lost position stops the robot like any fault, but it can only be recovered by motion. So manual driving is allowed
# after this time, in which the robot has come to rest; without a goal no other source drives it.
STANDS_AFTER_S = 1.0
# A map ordered while the position is lost provides a new position, once the order has reached Car locator and
# localization; until then the robot remains at rest.
POSITION_AWAITED_S = 3.0
# States that depend on the Car's frame.
FRAME_STATES = (State.FOLLOWING_WAYPOINT, State.CHECKING_CAR)


@dataclass(frozen=True)
class Decision:
    """Result of an observation; lock_reason is empty if the robot may move."""

    state: State
    goal: Goal
    max_speed_mps: float
    mapping: bool
    map_car_id: int
    session_id: int
    waypoint_id: int
    waypoint_result: Result
    message: Problem
    lock_reason: Problem
    check_car_id: int = 0
    hold_id: int = 0
    sets_off: bool = False


class StateMachine:
    """Decides at each tick; stores the state, the active orders to map and to check, and the goal."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._table = StateTable()
        self._goals = Goals()
        self._waypoint = WaypointResult()
        self._hold = Hold(parameters)
        self._signal = MotionSignal(parameters.signal_s, parameters.signal_after_rest_s)
        self._map_car_id = 0
        self._check_car_id = 0
        self._map_revision = 0
        self._before_fault = State.READY_TO_MAP_CAR
        self._fault = NO_PROBLEM
        # Order in the last message of a dispatcher that died; the application repeats the order to the next dispatcher.
        self._was_ordered = False
        self._is_map_lost = False
        self._failed_waypoint = (0, 0)
        self._lost_since_s: Optional[float] = None
        self._awaits_position_since_s: Optional[float] = None
        self._failure_is_old = False

    @property
    def state(self) -> State:
        """Current state of the robot."""
        return self._table.state

    def step(self, seen: Observation) -> Decision:
        """Decide at one tick."""
        self._failure_is_old = self._failure_is_old and seen.car.state is CarState.FAILED
        if not self._awaits_position(seen):
            self._awaits_position_since_s = None
        problem = self._problem(seen)
        for _ in range(MAX_EVENTS_PER_TICK):
            event = self._event(seen, problem)
            if event is None:
                break
            self._fire(event, seen)
            problem = self._problem(seen)
        if self.state is State.FAULT:
            self._keep_fault(seen, problem)
        self._note_lost(seen)
        self._hold.update(seen, self._goals.goal)
        self._pursue(seen)
        return self._decision(seen, problem)

    def _problem(self, seen: Observation) -> Problem:
        if seen.intrusion:
            return seen.intrusion
        for part in Part:
            found = seen.part_problem(part, self._parameters.noticed_after_s)
            if found and not (part is Part.LOCALIZATION and self._awaits_position(seen)):
                return found
        return self._car_problem(seen)

    def _only_position_is_lost(self, seen: Observation) -> bool:
        return seen.only_position_is_lost(self._parameters.noticed_after_s)

    def _awaits_position(self, seen: Observation) -> bool:
        """Return True if a map was ordered while the position was lost, and has not started yet."""
        since_s = self._awaits_position_since_s
        return (since_s is not None and self.state is State.MAPPING_CAR and self._only_position_is_lost(seen)
                and seen.now_s - since_s < POSITION_AWAITED_S)

    def _car_problem(self, seen: Observation) -> Problem:
        state = self._before_fault if self.state is State.FAULT else self.state
        failed = seen.car.state is CarState.FAILED and seen.car.map_car_id == self._map_car_id
        if state is State.MAPPING_CAR and failed and not self._failure_is_old:
            return seen.car.message or problems.CAR_NOT_FOUND()
        return self._frame_problem(state, seen) if state in FRAME_STATES else NO_PROBLEM

    def _frame_problem(self, state: State, seen: Observation) -> Problem:
        if seen.car.state is not CarState.LOCATED:
            failed = seen.car.state is CarState.FAILED
            return seen.car.message if failed and seen.car.message else problems.CAR_LOST()
        # A restarted localization may reuse the number, so a lost map stays lost.
        self._is_map_lost = self._is_map_lost or seen.map_revision != self._map_revision
        if self._is_map_lost:
            return problems.OTHER_MAP(cause=problems.CAR_LOST())
        if state is State.CHECKING_CAR and self._check_is(Check.FAILED, seen):
            return seen.check.message or problems.CAR_ELSEWHERE()
        return NO_PROBLEM

    def _event(self, seen: Observation, problem: Problem) -> Optional[Event]:
        if self.state is State.STARTING:
            return None if problem else Event.ALL_RUNNING
        may_order = not problem or self._car_problem(seen) == problem
        if (may_order or self._only_position_is_lost(seen)) and self._is_map_ordered(seen):
            return Event.MAP_ORDERED
        if may_order and self._is_check_ordered(seen):
            return Event.CHECK_ORDERED
        if self.state is State.FAULT:
            over = not problem or self._is_new_attempt(seen, problem)
            return AGAIN[self._before_fault] if over else None
        return Event.PART_FAILED if problem else self._progress(seen)

    def _progress(self, seen: Observation) -> Optional[Event]:
        if self.state is State.READY_TO_MAP_CAR and self._may_move(seen) and seen.desired.waypoint.id:
            return Event.WAYPOINT_GIVEN
        if self.state is State.MAPPING_CAR and self._is_located(seen):
            return Event.CAR_LOCATED
        if self.state is State.CHECKING_CAR:
            if self._check_is(Check.PASSED, seen):
                return Event.CHECK_PASSED
            if seen.desired.link_alive and not seen.desired.check_car_id:
                return Event.CHECK_WITHDRAWN
        return None

    def _fire(self, event: Event, seen: Observation) -> None:
        if event is Event.ALL_RUNNING:
            self._hold.begin(problems.HELD_START(), seen)
        if self.state is State.FAULT and self._fault:
            self._hold.begin(problems.HELD_FAULT(cause=self._fault), seen, self._was_ordered)
            self._fault, self._was_ordered = NO_PROBLEM, False
        if event is Event.PART_FAILED:
            self._before_fault = self.state
            self._failed_waypoint = _waypoint_key(seen)
        if event is Event.MAPPING_AGAIN:
            self._failure_is_old = seen.car.state is CarState.FAILED
        if event is Event.MAP_ORDERED:
            self._map_car_id = seen.desired.map_car_id
        if event in (Event.MAP_ORDERED, Event.MAPPING_AGAIN):
            self._awaits_position_since_s = seen.now_s if self._only_position_is_lost(seen) else None
        if event is Event.CAR_LOCATED:
            self._map_revision, self._is_map_lost = seen.map_revision, False
        if event is Event.CHECK_ORDERED:
            self._check_car_id = seen.desired.check_car_id
            self._waypoint.reopen()
        self._table.fire(event)

    def _is_map_ordered(self, seen: Observation) -> bool:
        is_new = seen.desired.link_alive and seen.desired.map_car_id not in (0, self._map_car_id)
        return is_new and not seen.desired.area_problem

    def _is_check_ordered(self, seen: Observation) -> bool:
        state = self._before_fault if self.state is State.FAULT else self.state
        is_new = seen.desired.link_alive and seen.desired.check_car_id not in (0, self._check_car_id)
        return is_new and state in FRAME_STATES and seen.car.state is CarState.LOCATED

    def _check_is(self, state: Check, seen: Observation) -> bool:
        return seen.check.id == self._check_car_id and seen.check.state is state

    def _is_new_attempt(self, seen: Observation, problem: Problem) -> bool:
        """Return True for a waypoint other than the one during which mapping failed; it tries again."""
        of_car = self._car_problem(seen)
        # An unusable map also leaves the robot without a position.
        failed = self._before_fault is State.MAPPING_CAR and of_car and (problem == of_car
                                                                        or self._only_position_is_lost(seen))
        new = seen.desired.waypoint.id and _waypoint_key(seen) != self._failed_waypoint
        return bool(failed and new and self._may_move(seen))

    def _is_located(self, seen: Observation) -> bool:
        return seen.car.state is CarState.LOCATED and seen.car.map_car_id == self._map_car_id

    @staticmethod
    def _may_move(seen: Observation) -> bool:
        return seen.desired.link_alive and not seen.desired.stop and not seen.desired.area_problem

    def _pursue(self, seen: Observation) -> None:
        desired = seen.desired
        if desired.link_alive:
            self._waypoint.expect(desired.session_id, desired.waypoint.id)
        wanted = self._wanted(seen) if self._may_move(seen) and not self._hold.id else None
        self._signal.update(seen, begins=wanted is not None and self._goals.is_new(*wanted))
        if wanted and not self._signal.is_due:
            self._goals.pursue(*wanted, seen.now_s)
        else:
            self._goals.pause()
        following = self.state is State.FOLLOWING_WAYPOINT
        self._waypoint.update(self._goals.goal if following else NO_GOAL, seen.motion)

    def _wanted(self, seen: Observation) -> Optional[Tuple[Waypoint, Hashable]]:
        """Return the wanted waypoint and its purpose; None to stop."""
        desired, of_locator = seen.desired, seen.car.next_waypoint
        if self.state is State.FOLLOWING_WAYPOINT and desired.waypoint.id:
            return desired.waypoint, desired.session_id
        if not of_locator.id or self._awaits_position(seen):
            return None
        if self.state is State.MAPPING_CAR and seen.car.state is CarState.COLLECTING:
            ordered = desired.waypoint.id or desired.map_car_id
            return (of_locator, ("mapping", self._map_car_id)) if ordered else None
        if self.state is State.CHECKING_CAR and desired.check_car_id == self._check_car_id:
            return of_locator, ("checking", self._check_car_id)
        return None

    def _decision(self, seen: Observation, problem: Problem) -> Decision:
        message = problem if self.state in LOCKED_STATES else self._message(seen)
        locked = self.state in LOCKED_STATES and not self._may_be_driven(seen)
        return Decision(self.state, self._goals.goal, seen.desired.max_speed_mps, self.state is State.MAPPING_CAR,
                        self._map_car_id, self._waypoint.session_id, self._waypoint.waypoint_id,
                        self._waypoint.result, message, message if locked else NO_PROBLEM, self._check_car_id,
                        self._hold.id, self._signal.is_due)

    def _note_lost(self, seen: Observation) -> None:
        is_lost = self.state is State.FAULT and self._only_position_is_lost(seen)
        self._lost_since_s = (seen.now_s if self._lost_since_s is None else self._lost_since_s) if is_lost else None

    def _may_be_driven(self, seen: Observation) -> bool:
        return self._lost_since_s is not None and seen.now_s - self._lost_since_s >= STANDS_AFTER_S

    def _keep_fault(self, seen: Observation, problem: Problem) -> None:
        """Store a part's fault as the reason for a hold, because a person may approach; a Car not found is none."""
        if problem and problem != self._car_problem(seen):
            self._fault = problem
        if seen.is_silent(Part.DISPATCHER, self._parameters.noticed_after_s):
            self._was_ordered = is_ordered(seen)

    def _message(self, seen: Observation) -> Problem:
        waits_for = self._hold.reason or seen.desired.area_problem or self._signal.problem(seen.now_s)
        if waits_for:
            return waits_for
        if self.state is State.READY_TO_MAP_CAR:
            return problems.WAITS_FOR_WAYPOINT()
        if self.state is State.FOLLOWING_WAYPOINT:
            return self._waypoint.message if self._waypoint.result in UNWELCOME else NO_PROBLEM
        if seen.motion.is_about(self._goals.goal) and seen.motion.result in UNWELCOME:
            return seen.motion.message
        if self.state is State.CHECKING_CAR:
            return seen.check.message if seen.check.id == self._check_car_id else problems.CHECKS_CAR()
        return seen.car.message


def _waypoint_key(seen: Observation) -> Tuple[int, int]:
    return seen.desired.session_id, seen.desired.waypoint.id
