"""The robot's high-level behaviour as a table: state, event, next state (thesis, figure 4.15, with self-check
and faults)."""
# SPDX-License-Identifier: Apache-2.0
import enum
from typing import Callable, Tuple

from transitions import Machine, MachineError

from mtr_core.errors import RobotError
from mtr_core.states import State


class UnknownEvent(RobotError):
    """The event is not allowed in the state."""


class Event(enum.Enum):
    """Events that change the state."""

    ALL_RUNNING = "all_running"          # every part of the robot has reported that it is ready
    WAYPOINT_GIVEN = "waypoint_given"    # the Operator wants the robot to move
    MAP_ORDERED = "map_ordered"          # the Operator orders to map the Car (again)
    CAR_LOCATED = "car_located"          # the Car locator has located the Car
    CHECK_ORDERED = "check_ordered"      # the Operator orders to check the Car's position
    CHECK_PASSED = "check_passed"        # the Car is at its position
    CHECK_WITHDRAWN = "check_withdrawn"  # the Operator has withdrawn the order to check
    PART_FAILED = "part_failed"          # a part is silent or faulty; the Car was not found or not at its position
    READY_AGAIN = "ready_again"          # end of a fault that started in the state of this name
    MAPPING_AGAIN = "mapping_again"
    FOLLOWING_AGAIN = "following_again"
    CHECKING_AGAIN = "checking_again"


# Row: state, event, next state.
TABLE: Tuple[Tuple[State, Event, State], ...] = (
    (State.STARTING, Event.ALL_RUNNING, State.READY_TO_MAP_CAR),
    (State.READY_TO_MAP_CAR, Event.WAYPOINT_GIVEN, State.MAPPING_CAR),
    (State.READY_TO_MAP_CAR, Event.MAP_ORDERED, State.MAPPING_CAR),
    (State.READY_TO_MAP_CAR, Event.PART_FAILED, State.FAULT),
    (State.MAPPING_CAR, Event.CAR_LOCATED, State.FOLLOWING_WAYPOINT),
    (State.MAPPING_CAR, Event.MAP_ORDERED, State.MAPPING_CAR),
    (State.MAPPING_CAR, Event.PART_FAILED, State.FAULT),
    (State.FOLLOWING_WAYPOINT, Event.MAP_ORDERED, State.MAPPING_CAR),
    (State.FOLLOWING_WAYPOINT, Event.CHECK_ORDERED, State.CHECKING_CAR),
    (State.FOLLOWING_WAYPOINT, Event.PART_FAILED, State.FAULT),
    (State.CHECKING_CAR, Event.CHECK_PASSED, State.FOLLOWING_WAYPOINT),
    (State.CHECKING_CAR, Event.CHECK_WITHDRAWN, State.FOLLOWING_WAYPOINT),
    (State.CHECKING_CAR, Event.CHECK_ORDERED, State.CHECKING_CAR),
    (State.CHECKING_CAR, Event.MAP_ORDERED, State.MAPPING_CAR),
    (State.CHECKING_CAR, Event.PART_FAILED, State.FAULT),
    (State.FAULT, Event.MAP_ORDERED, State.MAPPING_CAR),
    (State.FAULT, Event.CHECK_ORDERED, State.CHECKING_CAR),
    (State.FAULT, Event.READY_AGAIN, State.READY_TO_MAP_CAR),
    (State.FAULT, Event.MAPPING_AGAIN, State.MAPPING_CAR),
    (State.FAULT, Event.FOLLOWING_AGAIN, State.FOLLOWING_WAYPOINT),
    (State.FAULT, Event.CHECKING_AGAIN, State.CHECKING_CAR),
)

AGAIN = {
    State.READY_TO_MAP_CAR: Event.READY_AGAIN,
    State.MAPPING_CAR: Event.MAPPING_AGAIN,
    State.FOLLOWING_WAYPOINT: Event.FOLLOWING_AGAIN,
    State.CHECKING_CAR: Event.CHECKING_AGAIN,
}


class StateTable:
    """The table in operation.

    Attributes:
        state: current state of the robot (set by the library).
        trigger: handles an event by its name (set by the library).
    """

    state: State
    trigger: Callable[[str], bool]

    def __init__(self) -> None:
        rows = [[event.value, state, target] for state, event, target in TABLE]
        Machine(model=self, states=State, transitions=rows, initial=State.STARTING, auto_transitions=False)

    def fire(self, event: Event) -> State:
        """Change to the next state and return it; UnknownEvent if the table has no such row."""
        try:
            self.trigger(event.value)
        except MachineError:
            raise UnknownEvent(f"Event {event.value} has no place in state {self.state.name}.") from None
        return self.state
