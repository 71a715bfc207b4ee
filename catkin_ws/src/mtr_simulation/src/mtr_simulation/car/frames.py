"""CAN frames of the simulated Car, encoded with its DBC.

Frames repeat, so each distinct one is encoded by cantools once and then read from a cache.
"""
# SPDX-License-Identifier: Apache-2.0
import functools
import pathlib
from typing import Any, Iterator, NamedTuple, Optional, Tuple

import cantools

from .ecu import BodyEcu
from .vehicle import Vehicle

DBC_PATH = pathlib.Path(__file__).with_name("mtr_demo_car.dbc")
LOCK_MESSAGE = "DoorLockStatus"

# The bus is not in phase with the robot's 20 ms tick, because the ECU has its own clock: no stamp coincides with a
# tick.
PERIOD_NS = 20_000_000
PHASE_NS = 7_000_000


class Frame(NamedTuple):
    """One data frame; time_ns is its time on the bus."""

    can_id: int
    data: bytes
    time_ns: int


class CarFrames:
    """Yields due frames with the state of the ECU."""

    def __init__(self, ecu: BodyEcu, vehicle: Optional[Vehicle] = None):
        """vehicle: None for a stopped Car with the ignition off."""
        self._ecu, self._vehicle = ecu, vehicle or Vehicle()
        self._database: Any = cantools.database.load_file(str(DBC_PATH))
        self._encode = functools.lru_cache(maxsize=4096)(self._encode_once)
        messages = self._database.messages
        self._every = sorted((m.frame_id, m.name, m.cycle_time * 1_000_000 // PERIOD_NS) for m in messages)

    def due(self, after_ns: int, until_ns: int) -> Iterator[Frame]:
        """Yield the frames after after_ns up to until_ns, in the order of the bus."""
        first = (after_ns - PHASE_NS) // PERIOD_NS + 1
        last = (until_ns - PHASE_NS) // PERIOD_NS
        for number in range(first, last + 1):
            time_ns = number * PERIOD_NS + PHASE_NS
            for can_id, name, every in self._every:
                if number % every == 0:
                    yield Frame(can_id, self._encode(name, *self._values(name, number // every, time_ns)), time_ns)

    def _values(self, name: str, count: int, time_ns: int) -> Tuple[float, ...]:
        if name == LOCK_MESSAGE:
            ecu = self._ecu
            changed = int(ecu.has_just_changed(time_ns))
            return (int(ecu.lock_state), changed, int(ecu.last_source), ecu.command_counter % 256, count % 16)
        if name == "VehicleSpeed":
            return (self._vehicle.speed_kmh, 1, count % 16)
        return (self._vehicle.terminal_state, 12.6)

    def _encode_once(self, name: str, *values: float) -> bytes:
        message = self._database.get_message_by_name(name)
        return bytes(message.encode({signal.name: value for signal, value in zip(message.signals, values)}))
