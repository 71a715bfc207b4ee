"""CAN frames of the honest Car: slow cycles, optional frames on change, and the cause in the same or another
message."""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib
from typing import Any, Dict, Iterator, List, Optional, Tuple

import cantools

from ..frames import Frame
from ..noise import uniform_pair
from ..vehicle import Vehicle
from .extender import EXTENDER_MESSAGE
from .handle import HANDLE_MESSAGE
from .locks import Cause, Locks
from .parameters import BusParameters

DBC_PATH = pathlib.Path(__file__).with_name("mtr_honest_car.dbc")
# Outputs of the test, which the Car never sends.
OF_THE_TEST = (HANDLE_MESSAGE, EXTENDER_MESSAGE)
LOCK_MESSAGE = "LockStatus"
CAUSE_MESSAGE = "LockCauseStatus"
# Delay of the frame that is sent on a change.
ON_CHANGE_NS = 3_000_000
_MS = 1_000_000


class HonestFrames:
    """Yields due frames with the state of the locks."""

    def __init__(self, seed: int, locks: Locks, bus: BusParameters, vehicle: Vehicle):
        self._locks, self._vehicle = locks, vehicle
        self._bus = bus
        self._database = database()
        self._encode = functools.lru_cache(maxsize=4096)(self._encode_once)
        self._ids = {message.name: message.frame_id for message in self._database.messages}
        self._cycles = [(name, cycle_ns, phase_ns(seed, name, cycle_ns)) for name, cycle_ns in self._cycles_ns()]
        self._sent: Dict[str, int] = {}
        self._told_ns: Optional[int] = None

    def due(self, after_ns: int, until_ns: int) -> Iterator[Frame]:
        """Yield the frames after after_ns up to until_ns, in the order of the bus."""
        times = []
        for name, cycle_ns, phase_ns in self._cycles:
            first, last = (after_ns - phase_ns) // cycle_ns, (until_ns - phase_ns) // cycle_ns
            times += [(number * cycle_ns + phase_ns, self._ids[name], name) for number in range(first + 1, last + 1)]
        for time_ns, can_id, name in sorted(times + self._on_change(after_ns, until_ns)):
            yield Frame(can_id, self._encode(name, *self._values(name)), time_ns)

    def _cycles_ns(self) -> Iterator[Tuple[str, int]]:
        own = {LOCK_MESSAGE: self._bus.lock_cycle_ms, CAUSE_MESSAGE: self._bus.cause_cycle_ms}
        own_messages = [message for message in self._database.messages if message.name not in OF_THE_TEST]
        for message in own_messages:
            if message.name != CAUSE_MESSAGE or self._bus.cause_in == "other":
                yield message.name, own.get(message.name, message.cycle_time) * _MS

    def _on_change(self, after_ns: int, until_ns: int) -> List[Tuple[int, int, str]]:
        changed_ns = self._locks.changed_ns
        if not self._bus.sent_on_change or changed_ns is None or changed_ns == self._told_ns:
            return []
        time_ns = changed_ns + ON_CHANGE_NS
        if not after_ns < time_ns <= until_ns:
            return []
        self._told_ns = changed_ns
        names = [name for name, _, _ in self._cycles if name in (LOCK_MESSAGE, CAUSE_MESSAGE)]
        return [(time_ns, self._ids[name], name) for name in names]

    def _values(self, name: str) -> Tuple[float, ...]:
        """Return the values in the order of the message's signals."""
        self._sent[name] = alive = (self._sent.get(name, -1) + 1) % 16
        locks = self._locks
        counter = locks.events % 256 if self._bus.event_counter else 0
        if name == LOCK_MESSAGE:
            cause = locks.cause if self._bus.cause_in == "same" else Cause.NONE
            return (int(locks.state), int(cause), counter, alive)
        if name == CAUSE_MESSAGE:
            return (int(locks.cause), counter, alive)
        vehicle = self._vehicle
        return (vehicle.speed_kmh, 1, alive) if name == "VehicleSpeed" else (vehicle.terminal_state, 12.6)

    def _encode_once(self, name: str, *values: float) -> bytes:
        message = self._database.get_message_by_name(name)
        return bytes(message.encode({signal.name: value for signal, value in zip(message.signals, values)}))


def phase_ns(seed: int, name: str, cycle_ns: int) -> int:
    """Return the time of the first frame of a cyclic message."""
    return round(uniform_pair(seed, f"bus/{name}", 0)[0] * cycle_ns)


@functools.lru_cache(maxsize=1)
def database() -> Any:
    """Return the database of all messages on the honest Car's bus."""
    return cantools.database.load_file(str(DBC_PATH))
