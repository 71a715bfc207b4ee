"""Service mode without ROS: who enters it, and the two agreements that end it."""
# SPDX-License-Identifier: Apache-2.0
import math
import secrets
import threading
from dataclasses import dataclass
from typing import Callable, Tuple

from mtr_core.problems import NO_PROBLEM, Problem

from .. import problems

Remember = Callable[[bool], None]


def random_id() -> int:
    """A number that no earlier agreement has had, not even one from before a restart."""
    return secrets.randbits(63) | 1


@dataclass(frozen=True)
class ServiceState:
    """Service mode at one time.

    Attributes:
        id: of the agreement that the Operator can give now; 0 outside service mode.
        robot_agrees_s, operator_agrees_s: s for which an agreement still counts, NaN without one.
        problem: why wheels, lift and servos are disabled; no problem outside service mode.
    """

    id: int = 0
    robot_agrees_s: float = math.nan
    operator_agrees_s: float = math.nan
    problem: Problem = NO_PROBLEM

    @property
    def is_active(self) -> bool:
        """True in service mode."""
        return bool(self.problem)


NOT_IN_SERVICE = ServiceState()


class ServiceMode:
    """Ends only when robot and Operator agree after it was entered, each not longer ago than the limit.

    An agreement ends when its time is over, when the mode is entered again, and when its condition no longer holds: the
    Operator's while another application controls the robot or the link is silent, the robot's while a stop is engaged.
    Threads may share one.
    """

    def __init__(self, release_s: float, recalled: Problem = NO_PROBLEM, remember: Remember = lambda is_active: None,
                 new_id: Callable[[], int] = random_id):
        """release_s: time for which an agreement counts. recalled: why the robot starts in service mode, no problem
        when it does not. remember: stores whether the mode is active; raises OSError.
        """
        self._release_s, self._remember, self._new_id = release_s, remember, new_id
        self._guard = threading.Lock()
        self._cause = recalled
        self._not_stored = NO_PROBLEM
        self._is_stored = True
        self._id = new_id() if recalled else 0
        self._session_id = 0
        self._robot_until_s = self._operator_until_s = math.nan
        self._is_stop_engaged = True

    @property
    def problem(self) -> Problem:
        """Why wheels, lift and servos are disabled; no problem outside service mode."""
        if not self._cause:
            return NO_PROBLEM
        return problems.SERVICE_MODE(cause=self._not_stored or self._cause)

    @property
    def agreements(self) -> Tuple[int, bool]:
        """Id of the Operator's agreement, and whether the robot's was given; a Status is due when they change."""
        return self._id, not math.isnan(self._robot_until_s)

    def state_at(self, now_s: float) -> ServiceState:
        """What applications and the robot's commands show at a time of the steady clock."""
        with self._guard:
            return ServiceState(self._id, self._robot_until_s - now_s, self._operator_until_s - now_s, self.problem)

    def enter(self, cause: Problem) -> None:
        """Disable wheels, lift and servos from now on; agreements that were given before no longer count."""
        with self._guard:
            if not self._cause:
                self._cause, self._is_stored = cause, False
                self._id = self._new_id()
            elif not math.isnan(self._robot_until_s) or not math.isnan(self._operator_until_s):
                self._withdraw_all()

    def agree_at_robot(self, now_s: float) -> Problem:
        """A person at the robot releases it; why this is refused, no problem when it counts."""
        with self._guard:
            if not self._cause:
                return problems.SERVICE_NOT_ACTIVE()
            if self._is_stop_engaged:
                return problems.SERVICE_STOP_ENGAGED()
            self._robot_until_s = now_s + self._release_s
            return NO_PROBLEM

    def agree_by_operator(self, session_id: int, mode_id: int, now_s: float) -> None:
        """The application in control repeats its Operator's agreement; only the first one with an id counts."""
        with self._guard:
            if self._cause and mode_id == self._id and math.isnan(self._operator_until_s):
                self._session_id, self._operator_until_s = session_id, now_s + self._release_s

    def update(self, now_s: float, session_id: int, is_stop_engaged: bool) -> None:
        """Withdraw agreements that no longer count, and end the mode when both do.

        session_id: application in control whose link is alive, 0 for none. is_stop_engaged: an emergency stop is.
        """
        with self._guard:
            self._is_stop_engaged = is_stop_engaged
            if is_stop_engaged or not now_s < self._robot_until_s:
                self._robot_until_s = math.nan
            if not math.isnan(self._operator_until_s) and (
                    session_id != self._session_id or not now_s < self._operator_until_s):
                self._withdraw_operator()
            if self._cause and now_s < self._robot_until_s and now_s < self._operator_until_s:
                self._leave()

    def store(self) -> None:
        """Store an entry that is not stored yet; the mode is in force meanwhile."""
        with self._guard:
            if self._cause and not self._is_stored:
                try:
                    self._remember(True)
                except OSError as error:
                    self._not_stored = problems.SERVICE_NOT_STORED(why=_reason(error))
                else:
                    self._is_stored, self._not_stored = True, NO_PROBLEM

    def _leave(self) -> None:
        """What cannot be stored does not end: after a restart nobody would know of the agreements."""
        try:
            self._remember(False)
        except OSError as error:
            self._withdraw_all()
            self._not_stored = problems.SERVICE_END_NOT_STORED(why=_reason(error))
            return
        self._cause = self._not_stored = NO_PROBLEM
        self._withdraw_all()
        self._id, self._is_stored = 0, True

    def _withdraw_all(self) -> None:
        self._robot_until_s = math.nan
        self._withdraw_operator()

    def _withdraw_operator(self) -> None:
        """The application repeats the old id, which no longer counts."""
        self._operator_until_s, self._session_id = math.nan, 0
        self._id = self._new_id()


def _reason(error: OSError) -> str:
    return (error.strerror or str(error)).rstrip(".")
