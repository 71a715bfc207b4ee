"""Test of the whole simulated Car: a moving key and button presses produce the right CAN frames and true events."""
# SPDX-License-Identifier: Apache-2.0
import csv

import cantools
import pytest

from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.car import SimulatedCar
from mtr_simulation.car.ecu import LockState
from mtr_simulation.car.frames import DBC_PATH
from mtr_simulation.car.parameters import CarParameters, PassiveEntryParameters
from mtr_simulation.truth.log import TruthLog

STEP_NS = 20_000_000
START_NS = 1_000_000_000
RELEASED = (1000, 1000)
UNLOCK_PRESSED = (1000, 2000)
LOCK_PRESSED = (2000, 1000)
FAR = (0.0, 9.0, 1.0)


class Bench:
    """A Car with an in-memory CAN port, a truth log and the simulation time."""

    def __init__(self, directory, seed=1, parameters=None):
        self.port = MemoryCanPort()
        self.log = TruthLog(directory)
        self.car = SimulatedCar(seed, parameters or CarParameters(), self.port, self.log)
        self.time_ns = START_NS
        self.run(FAR, RELEASED, 15)

    def run(self, key_xyz, servo_us, steps):
        """Keep the key in one place for some steps."""
        for _ in range(steps):
            self.car.step(self.time_ns, key_xyz, servo_us)
            self.time_ns += STEP_NS

    def drive(self, from_y, to_y, speed_mps=0.3):
        """Move the key perpendicular to the left side, through its centre."""
        steps = round(abs(to_y - from_y) / (speed_mps * 0.02))
        for step in range(steps + 1):
            self.run((0.0, from_y + (to_y - from_y) * step / steps, 1.0), RELEASED, 1)

    def events(self):
        """Lines of the truth log so far."""
        with open(self.log.path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))


@pytest.fixture
def bench(tmp_path):
    """A booted Car and a key far away."""
    return Bench(tmp_path)


def test_approach_and_retreat_give_one_unlock_near_and_one_lock_farther(bench):
    bench.drive(4.9, 1.4)
    bench.drive(1.4, 4.9)
    unlocked, locked = bench.events()
    assert (unlocked["event"], locked["event"]) == ("unlocked", "locked")
    assert 0.9 < float(unlocked["key_y_m"]) - 0.9 < 2.0
    assert 1.7 < float(locked["key_y_m"]) - 0.9 < 2.9


def test_first_frame_after_the_true_event_carries_the_new_state_7_ms_later(bench):
    bench.drive(4.9, 1.4)
    event_ns = round(float(bench.events()[0]["robot_time_s"]) * 1e9)
    database = cantools.database.load_file(str(DBC_PATH))
    states = [
        (frame.time_ns, str(database.decode_message(frame.can_id, frame.data)["LockState"]))
        for frame in bench.port.frames
        if frame.can_id == 800
    ]
    assert next(time_ns for time_ns, state in states if state == "unlocked") == event_ns + 7_000_000
    assert [state for _, state in states[:12]] == ["unknown"] * 11 + ["locked"]


def test_same_seed_gives_the_same_frames_and_truth_and_another_seed_another(tmp_path):
    benches = [Bench(tmp_path / name, seed) for name, seed in (("a", 3), ("b", 3), ("c", 4))]
    for bench in benches:
        bench.drive(4.9, 1.4, speed_mps=0.05)
    first, again, other = benches
    assert first.port.frames == again.port.frames
    assert first.events() == again.events()
    assert first.events() != other.events()


def test_press_within_range_unlocks_and_stays_unlocked_far_from_the_antennas(bench):
    key = (0.0, 3.0, 1.0)
    bench.run(key, RELEASED, 20)
    bench.run(key, UNLOCK_PRESSED, 10)
    bench.run(key, RELEASED, 100)
    assert bench.car.ecu.lock_state is LockState.UNLOCKED
    unlocked, press = sorted(bench.events(), key=lambda event: event["event"], reverse=True)
    assert (press["event"], press["accepted"]) == ("press", "1")
    assert (unlocked["event"], unlocked["accepted"]) == ("unlocked", "")
    assert float(unlocked["robot_time_s"]) - float(press["robot_time_s"]) == pytest.approx(0.08)
    bench.run(key, LOCK_PRESSED, 10)
    assert bench.car.ecu.lock_state is LockState.LOCKED


def test_press_out_of_range_is_logged_as_not_accepted_and_changes_nothing(bench):
    bench.run((0.0, 7.0, 1.0), UNLOCK_PRESSED, 10)
    assert [(event["event"], event["accepted"]) for event in bench.events()] == [("press", "0")]
    assert bench.car.ecu.lock_state is LockState.LOCKED


def test_press_that_is_too_weak_is_no_press(bench):
    bench.run((0.0, 3.0, 1.0), (1000, 1500), 30)
    assert bench.events() == []


def test_press_that_is_too_short_is_not_accepted(bench):
    bench.run((0.0, 3.0, 1.0), UNLOCK_PRESSED, 3)
    bench.run((0.0, 3.0, 1.0), RELEASED, 3)
    assert [(event["event"], event["accepted"]) for event in bench.events()] == [("press", "0")]


def test_press_of_a_low_key_fails_where_a_high_one_succeeds(bench):
    bench.run((0.0, 3.0, 0.2), UNLOCK_PRESSED, 10)
    bench.run((0.0, 3.0, 0.2), RELEASED, 10)
    bench.run((0.0, 3.0, 1.0), UNLOCK_PRESSED, 10)
    assert [event["accepted"] for event in bench.events() if event["event"] == "press"] == ["0", "1"]


def test_car_without_passive_entry_does_not_react_to_the_key(tmp_path):
    parameters = CarParameters(passive_entry=PassiveEntryParameters(enabled=False))
    bench = Bench(tmp_path, parameters=parameters)
    bench.drive(4.9, 1.4)
    assert bench.events() == []
