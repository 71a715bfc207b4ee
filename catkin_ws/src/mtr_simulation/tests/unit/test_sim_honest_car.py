"""The honest Car as a whole: every feature that is switched on has its effect, on the locks and on the bus."""
# SPDX-License-Identifier: Apache-2.0
import csv
import dataclasses

import cantools
import numpy as np
import pytest

from mtr_simulation.car.can_port import MemoryCanPort, SentFrame
from mtr_simulation.car.ecu import Command
from mtr_simulation.car.honest.car import STEP_NS, HonestCar
from mtr_simulation.car.honest.frames import DBC_PATH, ON_CHANGE_NS
from mtr_simulation.car.honest.locks import Cause, LockState
from mtr_simulation.car.honest.parameters import (
    BusParameters,
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
# Without chance in the radio, so that a test sees one feature alone.
CALM = HonestParameters(uhf=UhfParameters(fading_sigma_db=0.0, margin_at_1m_db=80.0),
                        noise=NoiseParameters(sigma_db=0.1, lapse=0.0),
                        key=KeyParameters(pattern_floor_db=0.0, sleep_after_s=0.0, button_needs_db=20.0),
                        passive_entry=PassiveParameters(shadow_sigma_db=0.0), locks=LockParameters(relock_s=0.0))


def calm(**sections):
    """The calm Car with some parameters of its sections changed: calm(key={"battery_v": 2.0})."""
    return dataclasses.replace(CALM, **{name: dataclasses.replace(getattr(CALM, name), **values)
                                        for name, values in sections.items()})


class Bench:
    """A Car with a fake port, and the time."""

    def __init__(self, directory, parameters=CALM, seed=1):
        self.port = MemoryCanPort()
        self.log = TruthLog(directory)
        self.car = HonestCar(seed, parameters, self.port, self.log)
        self.time_ns = START_NS
        self.stays(FAR, 0.3)

    def stays(self, key_xyz, seconds, servo_us=RELEASED):
        """The key at one place for a while; the state of the locks after."""
        for _ in range(round(seconds * 1e9 / STEP_NS)):
            self.car.step(self.time_ns, key_xyz, servo_us)
            self.time_ns += STEP_NS
        return self.car.locks.state

    def presses(self, key_xyz, servo_us):
        """One press of 0.2 s and a second for the locks; the state after."""
        self.stays(key_xyz, 0.2, servo_us)
        return self.stays(key_xyz, 1.0)

    def events(self):
        """Kinds and times in s of the truth's lines so far."""
        with open(self.log.path, newline="", encoding="utf-8") as file:
            return [(row["event"], float(row["robot_time_s"])) for row in csv.DictReader(file)]

    def accepted(self, kind):
        """Whether the Car took each of the attempts of a kind."""
        with open(self.log.path, newline="", encoding="utf-8") as file:
            return [row["accepted"] for row in csv.DictReader(file) if row["event"] == kind]

    def frames(self, name):
        """Time in ns and decoded signals of each frame of a message."""
        message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name(name)
        return [(frame.time_ns, message.decode(frame.data, decode_choices=False))
                for frame in self.port.frames if frame.can_id == message.frame_id]


@pytest.fixture
def bench(tmp_path):
    """Makes a Car with some parameters changed."""
    return lambda **sections: Bench(tmp_path, calm(**sections))


def test_car_is_unknown_while_it_boots_then_locked(tmp_path):
    bench = Bench(tmp_path, calm(locks={"boot_ms": 1000}))
    assert bench.car.locks.state is LockState.UNKNOWN
    assert bench.stays(FAR, 1.0) is LockState.LOCKED
    assert bench.frames("LockStatus")[0][1]["LockState"] == LockState.UNKNOWN


def test_approach_unlocks_and_walking_away_locks_with_their_cause(bench):
    bench = bench()
    assert bench.stays(DOOR, 2.0) is LockState.UNLOCKED
    assert bench.stays(BESIDE, 2.0) is LockState.UNLOCKED  # between the two zones nothing happens
    assert bench.stays(FAR, 2.0) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["unlocked", "locked"]
    assert bench.car.locks.cause is Cause.PASSIVE_ENTRY


@pytest.mark.parametrize(("period_ms", "debounce"), [(100, 1), (300, 2), (700, 1), (700, 3)])
def test_reaction_comes_evenly_within_one_poll_after_the_debounce(tmp_path, period_ms, debounce):
    passive = {"poll_period_ms": period_ms, "debounce_polls": debounce, "response_s": 5.0}
    parameters = calm(passive_entry=passive, locks={"actuator_ms": 0})
    delays_s = []
    for seed in range(150):
        bench = Bench(tmp_path, parameters, seed)
        arrival_s = bench.time_ns * 1e-9
        while bench.car.locks.state is LockState.LOCKED:
            bench.stays(DOOR, 0.02)
        delays_s.append(bench.events()[0][1] - arrival_s)
    # Evenly over (debounce - 1) to debounce periods; the key is seen and the locks are moved at ticks of 20 ms.
    first_s, last_s = (debounce - 1) * period_ms * 1e-3, debounce * period_ms * 1e-3
    assert first_s - 0.021 <= min(delays_s) and max(delays_s) <= last_s + 0.041
    assert np.mean(delays_s) == pytest.approx((first_s + last_s) / 2.0, abs=0.021 + 0.1 * period_ms * 1e-3)
    assert np.std(delays_s) == pytest.approx(period_ms * 1e-3 / np.sqrt(12.0), rel=0.2)


def test_motors_take_their_time(tmp_path):
    times_s = []
    for actuator_ms in (0, 400):
        bench = Bench(tmp_path, calm(locks={"actuator_ms": actuator_ms}))
        bench.stays(DOOR, 2.0)
        times_s.append(bench.events()[0][1])
    assert times_s[1] - times_s[0] == pytest.approx(0.38, abs=0.021)


def test_walk_away_by_delay_locks_so_long_after_the_unlock_zone_was_left(bench):
    bench = bench(passive_entry={"walk_away": "delay", "walk_away_delay_s": 3.0})
    bench.stays(DOOR, 2.0)
    left_s = bench.time_ns * 1e-9
    assert bench.stays(BESIDE, 3.0) is LockState.UNLOCKED
    assert bench.stays(BESIDE, 1.5) is LockState.LOCKED
    assert 3.2 < bench.events()[-1][1] - left_s < 4.2


def test_walk_away_by_delay_is_given_up_when_the_key_comes_back(bench):
    bench = bench(passive_entry={"walk_away": "delay", "walk_away_delay_s": 3.0})
    bench.stays(DOOR, 2.0)
    bench.stays(BESIDE, 2.0)
    assert bench.stays(DOOR, 6.0) is LockState.UNLOCKED
    assert len(bench.events()) == 1


def test_walk_away_off_leaves_the_car_unlocked(bench):
    bench = bench(passive_entry={"walk_away": "off"})
    bench.stays(DOOR, 2.0)
    assert bench.stays(FAR, 5.0) is LockState.UNLOCKED


def test_relock_timer_locks_a_car_that_nobody_opened(bench):
    bench = bench(locks={"relock_s": 10.0})
    bench.presses(FAR, UNLOCK_PRESSED)
    assert bench.car.locks.state is LockState.UNLOCKED
    assert bench.stays(FAR, 11.0) is LockState.LOCKED
    assert bench.car.locks.cause is Cause.RELOCK_TIMER
    (_, unlocked_s), (_, locked_s) = [event for event in bench.events() if event[0] != "press"]
    assert locked_s - unlocked_s == pytest.approx(10.1, abs=0.03)


def test_second_key_inside_forbids_what_the_car_wants_but_not_the_button(bench):
    bench = bench(locks={"second_key_inside": True, "relock_s": 5.0})
    bench.stays(DOOR, 2.0)
    assert bench.stays(FAR, 8.0) is LockState.UNLOCKED
    assert bench.presses(FAR, LOCK_PRESSED) is LockState.LOCKED


def test_drivers_door_alone_at_the_first_press_and_all_at_the_second(bench):
    bench = bench(locks={"unlock_doors": "driver"})
    assert bench.presses(FAR, UNLOCK_PRESSED) is LockState.DRIVER_UNLOCKED
    assert bench.presses(FAR, UNLOCK_PRESSED) is LockState.UNLOCKED
    assert bench.presses(FAR, LOCK_PRESSED) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["press", "unlocked", "press", "press", "locked"]


def test_handle_car_waits_for_a_hand_and_looks_where_the_key_is(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    assert bench.stays(DOOR, 3.0) is LockState.LOCKED
    bench.car.request_handle()
    assert bench.stays(BESIDE, 0.5) is LockState.LOCKED  # too far when the hand comes
    bench.car.request_handle()
    assert bench.stays(DOOR, 0.5) is LockState.UNLOCKED
    assert bench.car.locks.cause is Cause.HANDLE
    bench.car.request_handle(Command.LOCK)
    assert bench.stays(DOOR, 0.5) is LockState.LOCKED
    assert [kind for kind, _ in bench.events()] == ["handle", "handle", "unlocked", "handle", "locked"]
    assert bench.accepted("handle") == ["0", "1", "1"]


def test_actuator_on_the_bus_takes_the_handle_once_each_time(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name("HandleActuator")

    def send(order):
        bench.port.from_host.append(SentFrame(message.frame_id, message.encode({"HandleRequest": order})))
        return bench.stays(DOOR, 0.5)

    assert send("released") is LockState.LOCKED
    assert send("open") is LockState.UNLOCKED and bench.car.locks.cause is Cause.HANDLE
    bench.presses(DOOR, LOCK_PRESSED)
    assert send("open") is LockState.LOCKED  # it was not released
    assert send("released") is LockState.LOCKED
    assert send("open") is LockState.UNLOCKED
    assert send("lock") is LockState.LOCKED


def test_other_and_damaged_frames_of_the_host_take_no_handle(bench):
    bench = bench(passive_entry={"unlock_on": "handle"})
    bench.port.from_host += [SentFrame(1200, b"\x01"), SentFrame(1201, b""), SentFrame(1201, b"\x03")]
    assert bench.stays(DOOR, 0.5) is LockState.LOCKED
    assert not bench.frames("HandleActuator")


def test_extender_brings_the_field_to_a_key_that_is_far_only_while_it_is_on(bench):
    bench = bench(passive_entry={"unlock_on": "handle", "extender_db": 60.0}, noise={"lapse": 0.0})
    message = cantools.database.load_file(str(DBC_PATH)).get_message_by_name("ExtenderSwitch")

    def request(*data):
        bench.port.from_host += [SentFrame(message.frame_id, each) for each in data]
        bench.car.request_handle()
        return bench.stays(BESIDE, 0.5)

    assert request() is LockState.LOCKED
    # A damaged frame changes nothing.
    assert request(b"\x01", b"\x00", b"") is LockState.LOCKED
    assert request(b"\x01", b"") is LockState.UNLOCKED and bench.car.locks.cause is Cause.HANDLE


def test_hand_that_comes_by_itself_unlocks_near_the_door_only(bench):
    bench = bench(passive_entry={"unlock_on": "handle", "handle_period_s": 1.0})
    assert bench.stays(FAR, 3.0) is LockState.LOCKED
    assert bench.stays(DOOR, 1.5) is LockState.UNLOCKED


def test_key_at_rest_falls_asleep_and_a_motion_wakes_it(bench):
    bench = bench(key={"sleep_after_s": 5.0})
    bench.stays(FAR, 6.0)
    assert not bench.car.key.is_awake
    bench.stays(DOOR, 2.0)
    assert bench.car.key.is_awake
    assert bench.car.locks.state is LockState.UNLOCKED
    # Asleep beside the Car it does not answer, and the Car takes it for gone.
    assert bench.stays(DOOR, 5.0) is LockState.LOCKED
    assert bench.stays((DOOR[0] + 0.02, *DOOR[1:]), 2.0) is LockState.UNLOCKED


@pytest.mark.parametrize(("buttons_wake", "state"), [(True, LockState.UNLOCKED), (False, LockState.LOCKED)])
def test_buttons_of_a_sleeping_key_work_where_they_wake_it(bench, buttons_wake, state):
    bench = bench(key={"sleep_after_s": 2.0, "buttons_wake": buttons_wake})
    bench.stays(FAR, 3.0)
    assert bench.presses(FAR, UNLOCK_PRESSED) is state
    assert bench.events()[0][0] == "press"


def test_low_battery_shortens_the_range_and_an_empty_one_silences_the_key(bench):
    edge = (0.0, 128.0, 1.0)
    assert bench().presses(edge, UNLOCK_PRESSED) is LockState.UNLOCKED
    assert bench(key={"battery_v": 2.2}).presses(edge, UNLOCK_PRESSED) is LockState.LOCKED
    assert bench(key={"battery_v": 1.8}).presses(DOOR, UNLOCK_PRESSED) is LockState.LOCKED


def test_attitude_of_the_key_decides_at_the_edge_of_the_range(bench):
    bench = bench(key={"pattern_floor_db": -30.0, "axis_azimuth_deg": 0.0, "axis_elevation_deg": 0.0})
    places = {}
    for yaw_rad in (0.0, np.pi / 2.0):
        for _ in range(10):
            bench.car.step(bench.time_ns, (80.0, 0.1, 1.15), UNLOCK_PRESSED, yaw_rad)
            bench.time_ns += STEP_NS
        places[yaw_rad] = bench.stays((80.0, 0.1, 1.15), 1.0)
    assert list(places.values()) == [LockState.LOCKED, LockState.UNLOCKED]


def test_lapses_lose_presses_at_any_place(bench):
    bench = bench(noise={"lapse": 0.5}, passive_entry={"enabled": False})
    lost = 0
    for number in range(60):
        state = bench.presses((0.0, 3.0, 1.0), LOCK_PRESSED if number % 2 else UNLOCK_PRESSED)
        lost += state is not (LockState.LOCKED if number % 2 else LockState.UNLOCKED)
    assert 5 < lost < 45


@pytest.mark.parametrize("cycle_ms", [20, 200, 800])
def test_lock_message_comes_in_its_cycle_and_counts(bench, cycle_ms):
    bench = bench(bus={"lock_cycle_ms": cycle_ms})
    bench.stays(FAR, 8.0)
    frames = bench.frames("LockStatus")
    times_ns = np.array([time_ns for time_ns, _ in frames])
    assert (np.diff(times_ns) == cycle_ms * 1_000_000).all()
    assert len(frames) == pytest.approx(8300 / cycle_ms, abs=1.1)
    alive = np.array([signals["AliveCounter"] for _, signals in frames])
    assert (np.diff(alive) % 16 == 1).all()
    assert not bench.frames("LockCauseStatus")


def test_cyclic_message_tells_a_change_up_to_a_cycle_late_and_on_change_at_once(tmp_path):
    for on_change, most_ms in ((False, 800), (True, 3)):
        bench = Bench(tmp_path, calm(bus={"lock_cycle_ms": 800, "sent_on_change": on_change}))
        bench.stays(DOOR, 4.0)
        changed_ns = round(bench.events()[0][1] * 1e9)
        first_ns = next(time_ns for time_ns, signals in bench.frames("LockStatus")
                        if signals["LockState"] == LockState.UNLOCKED)
        assert 0 < first_ns - changed_ns <= most_ms * 1_000_000
        assert (first_ns - changed_ns == ON_CHANGE_NS) is on_change


@pytest.mark.parametrize(("cause_in", "in_lock_message", "in_other"), [
    ("same", Cause.KEY_BUTTON, None), ("other", Cause.NONE, Cause.KEY_BUTTON), ("none", Cause.NONE, None)])
def test_cause_stands_where_the_car_tells_it(bench, cause_in, in_lock_message, in_other):
    bench = bench(bus={"cause_in": cause_in, "cause_cycle_ms": 100})
    bench.presses(FAR, UNLOCK_PRESSED)
    assert bench.frames("LockStatus")[-1][1]["LockCause"] == in_lock_message
    other = bench.frames("LockCauseStatus")
    assert (other[-1][1]["LastLockCause"] if other else None) == in_other


@pytest.mark.parametrize("counts", [True, False])
def test_event_counter_counts_changes_where_there_is_one(bench, counts):
    bench = bench(bus={"event_counter": counts, "lock_cycle_ms": 20})
    bench.presses(FAR, UNLOCK_PRESSED)
    bench.presses(FAR, UNLOCK_PRESSED)
    bench.presses(FAR, LOCK_PRESSED)
    counted = [signals["EventCounter"] for _, signals in bench.frames("LockStatus")]
    assert (counted[0], counted[-1]) == (0, 2 if counts else 0)


def test_frames_split_over_steps_come_in_the_order_of_the_bus(bench):
    bench = bench(bus={"cause_in": "other"})
    bench.stays(FAR, 3.0)
    assert bench.port.frames == sorted(bench.port.frames, key=lambda frame: (frame.time_ns, frame.can_id))


def test_bus_is_never_silent_for_half_a_second(bench):
    bench = bench(bus=dataclasses.asdict(BusParameters(lock_cycle_ms=800)))
    bench.stays(FAR, 3.0)
    assert np.diff([frame.time_ns for frame in bench.port.frames]).max() <= 100_000_000
