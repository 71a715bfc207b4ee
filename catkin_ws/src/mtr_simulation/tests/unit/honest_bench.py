"""Test bench of an honest Car: deterministic radio, in-memory CAN port, and a key that the test moves."""
# SPDX-License-Identifier: Apache-2.0
import csv
import dataclasses

import cantools

from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.honest.car import STEP_NS, HonestCar
from mtr_simulation.car.honest.frames import DBC_PATH
from mtr_simulation.car.honest.parameters import (
    HonestParameters,
    KeyParameters,
    LockParameters,
    NoiseParameters,
    PassiveParameters,
    UhfParameters,
)
from mtr_simulation.truth.log import TruthLog

START_NS = 1_000_000_000
RELEASED, LOCK_PRESSED, UNLOCK_PRESSED = (1000.0, 1000.0), (2000.0, 1000.0), (1000.0, 2000.0)
DOOR, BESIDE, FAR = (0.05, 1.2, 1.0), (0.05, 3.0, 1.0), (0.05, 9.0, 1.0)
# The radio has no random effects, so that each test sees one feature alone.
CALM = HonestParameters(uhf=UhfParameters(fading_sigma_db=0.0, margin_at_1m_db=80.0),
                        noise=NoiseParameters(sigma_db=0.1, lapse=0.0),
                        key=KeyParameters(pattern_floor_db=0.0, sleep_after_s=0.0, button_needs_db=20.0),
                        passive_entry=PassiveParameters(shadow_sigma_db=0.0), locks=LockParameters(relock_s=0.0))


def calm(**sections):
    """Deterministic Car with some parameters of its sections changed, e.g. calm(key={"battery_v": 2.0})."""
    return dataclasses.replace(CALM, **{name: dataclasses.replace(getattr(CALM, name), **values)
                                        for name, values in sections.items()})


class Bench:
    """An honest Car with an in-memory CAN port, a truth log and the simulation time."""

    def __init__(self, directory, parameters=CALM, seed=1):
        self.port = MemoryCanPort()
        self.log = TruthLog(directory)
        self.car = HonestCar(seed, parameters, self.port, self.log)
        self.time_ns = START_NS
        self.stays(FAR, 0.3)

    def stays(self, key_xyz, seconds, servo_us=RELEASED):
        """Keep the key at one place for a while and return the resulting state of the locks."""
        for _ in range(round(seconds * 1e9 / STEP_NS)):
            self.car.step(self.time_ns, key_xyz, servo_us)
            self.time_ns += STEP_NS
        return self.car.locks.state

    def presses(self, key_xyz, servo_us):
        """Press for 0.2 s, wait one second for the locks, and return their state."""
        self.stays(key_xyz, 0.2, servo_us)
        return self.stays(key_xyz, 1.0)

    def events(self):
        """Kinds and times in s of the true events so far."""
        with open(self.log.path, newline="", encoding="utf-8") as file:
            return [(row["event"], float(row["robot_time_s"])) for row in csv.DictReader(file)]

    def accepted(self, kind):
        """Column `accepted` of each attempt of one kind."""
        with open(self.log.path, newline="", encoding="utf-8") as file:
            return [row["accepted"] for row in csv.DictReader(file) if row["event"] == kind]

    def frames(self, name):
        """Time in ns and decoded signals of each frame of a message."""
        message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name(name)
        return [(frame.time_ns, message.decode(frame.data, decode_choices=False))
                for frame in self.port.frames if frame.can_id == message.frame_id]
