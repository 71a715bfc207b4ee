"""Simulated Car: causes and times of lock changes, and the frames that report them."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass, field
from typing import Callable, List, NamedTuple, Optional, Tuple

LOCK_ID = 0x320
CYCLE_S = 0.02
# LastCommandSource of the demo car's DBC.
SOURCE_NONE, SOURCE_VICINITY, SOURCE_BUTTON = 0, 1, 2
# Time for which LockStateChanged is set.
CHANGED_S = 0.1


class Place(NamedTuple):
    """True place of the Remote key."""

    x: float
    y: float
    height_m: float


class Change(NamedTuple):
    """Movement of the locks. press_id: id of the press that caused it, else 0. by_key: caused by the key's vicinity."""

    time_s: float
    locked: bool
    by_key: bool
    press_id: int
    place: Place


class Order(NamedTuple):
    """Command to the locks, whether they move or not."""

    time_s: float
    locks: bool
    source: int
    by_key: bool = False
    press_id: int = 0


class Frame(NamedTuple):
    """One lock message. time_s: true time at which it is on the bus."""

    time_s: float
    data: bytes


@dataclass
class CarBody:
    """Locks and bus of the Car.

    Attributes:
        spoil: function that replaces a frame on the bus; None: the frame is lost.
        changes: all changes of the locks.
    """

    unlock_m: float
    lock_m: float
    phase_s: float
    spoil: Callable[[Frame], Optional[Frame]] = lambda frame: frame
    foreign: List[Order] = field(default_factory=list)
    changes: List[Change] = field(default_factory=list)
    _orders: List[Order] = field(default_factory=list)
    _near: bool = False
    _count: int = 0
    _states: List[Tuple[float, bool, int, int]] = field(default_factory=lambda: [(-1.0, True, SOURCE_NONE, 0)])

    @property
    def locked(self) -> bool:
        """True if the Car is locked now."""
        return self._states[-1][1]

    def press(self, press_id: int, locks: bool, time_s: float) -> None:
        """Receive a button press of the Remote key; the Car reacts at this time."""
        self._orders.append(Order(time_s, locks, SOURCE_BUTTON, press_id=press_id))

    def step(self, before_s: float, now_s: float, gap_before_m: float, gap_m: float, place: Place) -> None:
        """Process a move of the key from one distance from the Car's outline to another."""
        if not self._near and gap_m < self.unlock_m:
            self._near = True
            self._orders.append(Order(_crossing(before_s, now_s, gap_before_m, gap_m, self.unlock_m), False,
                                      SOURCE_VICINITY, by_key=True))
        elif self._near and gap_m > self.lock_m:
            self._near = False
            self._orders.append(Order(_crossing(before_s, now_s, gap_before_m, gap_m, self.lock_m), True,
                                      SOURCE_VICINITY, by_key=True))
        due = [order for order in self._orders + self.foreign if order.time_s <= now_s]
        for order in sorted(due):
            self._carry_out(order, place)
        if due:
            self._orders = [order for order in self._orders if order.time_s > now_s]
            self.foreign = [order for order in self.foreign if order.time_s > now_s]

    def frames(self, now_s: float) -> List[Frame]:
        """Return the frames up to now that were not returned before."""
        found = []
        while self.phase_s + self._count * CYCLE_S <= now_s:
            frame = self.spoil(self._frame(self.phase_s + self._count * CYCLE_S))
            self._count += 1
            if frame is not None:
                found.append(frame)
        return found

    def _carry_out(self, order: Order, place: Place) -> None:
        _, locked, _, commands = self._states[-1]
        self._states.append((order.time_s, order.locks, order.source, commands + 1))
        if order.locks != locked:
            self.changes.append(Change(order.time_s, order.locks, order.by_key, order.press_id, place))

    def _frame(self, time_s: float) -> Frame:
        _, locked, source, commands = next(state for state in reversed(self._states) if state[0] <= time_s)
        changed = bool(self.changes) and 0.0 <= time_s - self.changes[-1].time_s < CHANGED_S
        return Frame(time_s, lock_data(int(not locked), changed, source, commands, self._count))


def lock_data(state: int, changed: bool, source: int, commands: int, alive: int) -> bytes:
    """Return the data of DoorLockStatus of mtr_demo_car.dbc."""
    return bytes([state | int(changed) << 2 | source << 4, commands % 256, alive % 16, 0])


def _crossing(before_s: float, now_s: float, gap_before_m: float, gap_m: float, at_m: float) -> float:
    moved_m = gap_m - gap_before_m
    # A robot that was carried elsewhere crossed the boundary at once.
    if abs(moved_m) < 1e-9 or not 0.0 <= (at_m - gap_before_m) / moved_m <= 1.0 or abs(moved_m) > 0.1:
        return now_s
    return before_s + (at_m - gap_before_m) / moved_m * (now_s - before_s)
