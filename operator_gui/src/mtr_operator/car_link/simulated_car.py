"""Small Car inside the application, for a first try without a real one: its locks react to the key's position.

It is not a model of a real Car: its ranges are smooth curves with some random noise. mtr_simulation has realistic ones.
"""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math
import random

from mtr_operator.domain.actions.distance import gap_to_outline
from mtr_operator.domain.assistance import OUTPUT, ExtenderPort, HandlePort
from mtr_operator.domain.distance_feed import DistanceFeed
from mtr_operator.domain.errors import InvalidParameter
from mtr_operator.domain.interfaces.car_bus import CarEquipment
from mtr_operator.domain.limits import Limit
from mtr_operator.domain.ports import CarEvent, CarLink, LockState
from mtr_operator.domain.robot_status import CarDimensions, PressReport, RobotStatus

from .phone.simulated import SimulatedPhone

# Distance from the Car's outline at which a stationary key is detected, and at which it is lost. Distance at which half
# of the handle requests succeed; distance from the Car's centre at which half of the presses succeed.
UNLOCK_M, LOCK_M, HANDLE_M, PRESS_M = 1.5, 2.2, 1.3, 5.2
# Relative amplitudes of these ranges around the Car, by the number of lobes.
_LOBES = ((1, 0.06), (2, 0.05), (3, 0.03))
# Widths of the logistic curves of presses and requests, 1 sigma of a poll's noise, and probability of a random miss.
_PRESS_WIDTH_M, _HANDLE_WIDTH_M, _POLL_NOISE_M, _LAPSE = 0.12, 0.08, 0.02, 0.01
# Polls occur at any time between two Statuses.
_POLL_S, _REACTION_S, _TIME_SIGMA_S = 0.13, 0.02, 0.005
_PRESS_REACTION_S = 0.1
# Rest after which the key sleeps, and the motion that wakes it: the noise of the simulated robot is smaller.
KEY_SLEEP = Limit("rest after which the simulated key sleeps", 0.0, 3600.0, "s")
_WAKE_MOVE_M = 0.03
# Apparent reduction of the key's distance while an extender is on; 0: no effect.
EXTENDER = Limit("reach of the simulated extender", 0.0, 100.0, "m")
_OTHER_STATE = {LockState.LOCKED: LockState.UNLOCKED, LockState.UNLOCKED: LockState.LOCKED}
_NOBODY = CarDimensions(math.nan, math.nan, math.nan, math.nan)


class SimulatedHandle(HandlePort):
    """Output without delay.

    Attributes:
        is_waiting: the handle was pulled, and the Car has not reacted yet.
    """

    by = OUTPUT

    def __init__(self) -> None:
        self.is_waiting = False
        self._is_taken = False

    def request(self, distance_m: float) -> None:
        self.is_waiting = self._is_taken = True

    def is_taken(self) -> bool:
        return self._is_taken

    def release(self) -> None:
        self._is_taken = False


class SimulatedExtender(ExtenderPort):
    """Relay between Car and key that is switched without delay; off at first.

    nearer_m: apparent reduction of the key's distance while it is on.
    """

    by = OUTPUT

    def __init__(self, nearer_m: float):
        self._nearer_m = nearer_m
        self._is_on = self._is_switched = False

    def switch(self, is_on: bool) -> None:
        self._is_on, self._is_switched = is_on, True

    def is_switched(self) -> bool:
        return self._is_switched

    def release(self) -> None:
        self._is_switched = False

    def gap_m(self, gap_m: float) -> float:
        """Return the apparent distance of a key at this distance."""
        return max(gap_m - self._nearer_m, 0.0) if self._is_on else gap_m


class SleepingKey:
    """Key whose motion sensor lets it sleep: asleep, it ignores polls and requests, but a press of its button is sent.

    sleep_s: rest after which it sleeps; 0: never.
    """

    def __init__(self, sleep_s: float):
        self._sleep_s = sleep_s
        self._rest: tuple[float, float] | None = None
        self._moved_s = -math.inf

    def forget(self) -> None:
        """Restart for another clock."""
        self._rest, self._moved_s = None, -math.inf

    def see(self, time_s: float, place: tuple[float, float]) -> None:
        """Update the key's position, in m."""
        if self._rest is None or math.dist(self._rest, place) >= _WAKE_MOVE_M:
            self._rest, self._moved_s = place, time_s

    def is_awake(self, time_s: float) -> bool:
        """Return True if the key answers."""
        return self._sleep_s == 0.0 or time_s - self._moved_s < self._sleep_s


class SimulatedCarLink(CarLink, CarEquipment):
    """Passive entry by the key's position; presses and handle requests by its distance.

    key_sleep_s: rest after which the key sleeps, 0 to 3600 s; 0: never. extender_m: apparent reduction of the key's
    distance while its extender is on, 0 to 100 m; 0: no effect.

    Passive entry is disabled after a button press or handle request, because only one of them can be measured at a
    time. The next test, with a new session, enables it again. car_seed: selects the Car's ranges; seed: of the random
    noise. The same seeds and the same Statuses give the same events.
    A phone that is its key reports its distance with the errors of PhoneModel.
    """

    def __init__(self, seed: int = 1, key_sleep_s: float = 0.0, extender_m: float = 0.0, *, car_seed: int = 1):
        problem = KEY_SLEEP.violation(key_sleep_s) or EXTENDER.violation(extender_m)
        if problem:
            raise InvalidParameter(problem)
        self._key = SleepingKey(key_sleep_s)
        self._chance, car = random.Random(seed), random.Random(car_seed)
        self._lobes = [(count, part, car.uniform(0.0, 2.0 * math.pi)) for count, part in _LOBES]
        # The first random numbers of a seed once defined the Car; skipping them keeps its results unchanged.
        for _ in _LOBES:
            self._chance.random()
        self._handle = SimulatedHandle()
        self._extender = SimulatedExtender(extender_m)
        self._phone = SimulatedPhone(seed)
        self._is_active = False
        self._state = LockState.LOCKED
        self._is_passive = True
        self._session_id = self._robot_session_id = 0
        self._poll_s = self._answered_s = self._stamp_s = -math.inf
        self._agreed = 0
        self._robot: tuple[float, tuple[float, float]] | None = None

    def connect(self) -> None:
        self._is_active = True
        self._phone.connect()

    def observe(self, status: RobotStatus) -> list[CarEvent]:
        if not self._is_active:
            return []
        if status.robot_session_id != self._robot_session_id or status.stamp_s < self._stamp_s:
            self._forget_times(status.robot_session_id)
        if status.session_id != self._session_id and not status.controlled_by_other:
            self._begin_session(status.session_id)
        self._stamp_s = status.stamp_s
        car, before = status.car or _NOBODY, self._robot
        self._robot = (status.stamp_s, status.key_place) if status.pose_valid else None
        if self._robot is not None:
            self._key.see(*self._robot)
        events = self._presses(status) + self._requests(status, car)
        if self._is_passive and status.car is not None and before is not None and self._robot is not None:
            events += self._polls(before, self._robot, car)
        return events

    def _begin_session(self, session_id: int) -> None:
        """Restore passive entry for the next test; a request of the previous one is no longer pending."""
        self._session_id, self._is_passive, self._handle.is_waiting = session_id, True, False

    def _forget_times(self, robot_session_id: int) -> None:
        """Discard all times and the session of the robot's previous clock: the new one starts below them."""
        self._robot_session_id = robot_session_id
        self._begin_session(0)
        self._poll_s = self._answered_s = -math.inf
        self._agreed, self._robot = 0, None
        self._key.forget()

    def _presses(self, status: RobotStatus) -> list[CarEvent]:
        new = [press for press in sorted(status.presses, key=lambda press: press.start_s)
               if press.start_s > self._answered_s and not press.error]
        return [event for press in new for event in self._press(press)]

    def _press(self, press: PressReport) -> list[CarEvent]:
        self._answered_s, self._is_passive = press.start_s, False
        if self._robot is None:
            return []
        place = self._robot[1]
        border_m = PRESS_M * self._part(place)
        if not self._works(math.hypot(*place), border_m, _PRESS_WIDTH_M):
            return []
        return [self._change(min(press.start_s + _PRESS_REACTION_S, press.end_s))]

    def _requests(self, status: RobotStatus, car: CarDimensions) -> list[CarEvent]:
        """Return the reaction to a handle request since the last Status."""
        if not self._handle.is_waiting:
            return []
        self._handle.is_waiting, self._is_passive = False, False
        if self._robot is None or self._state is LockState.UNLOCKED or not self._key.is_awake(status.stamp_s):
            return []
        place = self._robot[1]
        gap_m = self._extender.gap_m(gap_to_outline(place, car))
        if not self._works(gap_m, HANDLE_M * self._part(place), _HANDLE_WIDTH_M):
            return []
        # Later than the previous observation, and not in the future.
        self._answered_s = max(self._answered_s, status.stamp_s)
        return [self._change(status.stamp_s)]

    def _polls(self, before: tuple[float, tuple[float, float]], now: tuple[float, tuple[float, float]],
               car: CarDimensions) -> list[CarEvent]:
        """Return the reactions to the Car's polls of its key; two consecutive polls must agree."""
        events = []
        (start_s, start), (end_s, end) = before, now
        self._poll_s = max(self._poll_s + _POLL_S, start_s)
        while self._poll_s <= end_s - _REACTION_S:
            part = (self._poll_s - start_s) / max(end_s - start_s, 1e-9)
            place = (start[0] + part * (end[0] - start[0]), start[1] + part * (end[1] - start[1]))
            # A sleeping key is absent for the Car.
            gap_m = self._extender.gap_m(gap_to_outline(place, car)) + self._chance.gauss(0.0, _POLL_NOISE_M) \
                if self._key.is_awake(self._poll_s) else math.inf
            is_other = gap_m < UNLOCK_M * self._part(place) if self._state is LockState.LOCKED else \
                gap_m > LOCK_M * self._part(place)
            self._agreed = self._agreed + 1 if is_other else 0
            if self._agreed > 1:
                self._agreed = 0
                events.append(self._change(self._poll_s + _REACTION_S))
            self._poll_s += _POLL_S
        self._poll_s -= _POLL_S
        return events

    def _part(self, place: tuple[float, float]) -> float:
        """Return the relative change of the ranges in a direction."""
        bearing = math.atan2(place[1], place[0])
        return 1.0 + sum(part * math.cos(count * bearing + phase) for count, part, phase in self._lobes)

    def _works(self, distance_m: float, border_m: float, width_m: float) -> bool:
        share = (1.0 - _LAPSE) / (1.0 + math.exp(min((distance_m - border_m) / width_m, 50.0)))
        return self._chance.random() < share

    def _change(self, time_s: float) -> CarEvent:
        self._state = _OTHER_STATE[self._state]
        return CarEvent(time_s, _TIME_SIGMA_S, self._state)

    @property
    def lock_state(self) -> LockState:
        return self._state if self._is_active else LockState.UNKNOWN

    @property
    def handle(self) -> HandlePort | None:
        return self._handle

    @property
    def extender(self) -> ExtenderPort | None:
        return self._extender

    @property
    def distance_feed(self) -> DistanceFeed | None:
        return self._phone

    @property
    def problem(self) -> str:
        return "" if self._is_active else "The Car's substitute is not connected."

    def close(self) -> None:
        self._is_active = False
        self._phone.close()
