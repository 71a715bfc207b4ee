"""Simulated firmware: lift, presses, silence of the host, wrapping clock."""
# SPDX-License-Identifier: Apache-2.0
import math
import struct

import pytest

from mtr_simulation.firmware.simulated import CLOCK_START_US, SimulatedFirmware

MS = 1_000_000
START_NS = 1000 * MS
NONE, PRESSING, DONE, REFUSED = range(4)


class Bench:
    """A powered firmware, a host that sends a command every 100 ms, and the simulation time."""

    def __init__(self, **arguments):
        self.firmware = SimulatedFirmware(**arguments)
        self.time_ns = START_NS
        self.heights = []
        self.pulses = []
        self.firmware.step(self.time_ns)

    def run(self, milliseconds, height_m=math.nan, silent=False):
        """Advance the simulation; the host sends nothing if `silent`."""
        for _ in range(milliseconds // 20):
            if not silent and self.time_ns % (100 * MS) == 0:
                self.firmware.command(height_m, 2)
            self.time_ns += 20 * MS
            self.firmware.step(self.time_ns)
            self.heights.append(self.firmware.lift_height_m)
            self.pulses.append(self.firmware.servo_us)

    @property
    def state(self):
        """State that the firmware reports now."""
        return self.firmware.state()


@pytest.fixture
def bench():
    """A bench with newly started firmware."""
    return Bench()


def test_lift_reaches_the_height_without_overshoot_within_speed_and_acceleration(bench):
    bench.run(10_000, height_m=0.9)
    assert bench.state.lift_height_m == pytest.approx(0.9, abs=1e-6)
    assert max(bench.heights) <= 0.9 + 1e-9
    speeds = [(b - a) / 0.02 for a, b in zip(bench.heights, bench.heights[1:])]
    assert max(speeds) == pytest.approx(0.15)
    assert max(abs(b - a) / 0.02 for a, b in zip(speeds, speeds[1:])) <= 0.3 + 1e-6
    assert bench.heights.index(next(h for h in bench.heights if h > 0.899)) * 0.02 == pytest.approx(6.5, abs=0.2)


def test_lift_turns_round_smoothly_and_comes_down(bench):
    bench.run(2_000, height_m=1.0)
    bench.run(4_000, height_m=0.05)
    assert bench.state.lift_height_m == pytest.approx(0.05, abs=1e-6)


def test_lift_brakes_and_holds_still_on_nan(bench):
    bench.run(3_000, height_m=1.0)
    bench.run(1_000)
    held = bench.state.lift_height_m
    bench.run(1_000)
    assert bench.state.lift_height_m == held
    assert 0.3 < held < 0.6


@pytest.mark.parametrize("height_m", [-0.01, 1.21, math.inf, -math.inf])
def test_height_out_of_range_is_refused_and_the_order_before_stays(bench, height_m):
    bench.run(1_000, height_m=0.5)
    bench.run(5_000, height_m=height_m)
    assert bench.state.lift_height_m == pytest.approx(0.5, abs=1e-6)
    assert bench.firmware.refused_commands > 0


def test_upper_limit_rounded_to_float32_is_accepted(bench):
    (height_m,) = struct.unpack("<f", struct.pack("<f", 1.2))
    assert height_m > 1.2
    bench.run(10_000, height_m=height_m)
    assert bench.state.lift_height_m == pytest.approx(1.2)


def test_press_travels_holds_and_releases_by_itself_with_exact_times(bench):
    bench.firmware.press(7, 2, 0.8, 250)
    assert (bench.state.press_id, bench.state.press_state) == (7, PRESSING)
    bench.run(600)
    assert bench.state[3:5] == (7, DONE)
    assert bench.state.press_start_us == CLOCK_START_US + 100_000
    assert bench.state.press_end_us == CLOCK_START_US + 350_000
    unlock = [round(pulse) for _, pulse in bench.pulses]
    assert unlock[:5] == [1160, 1320, 1480, 1640, 1800]
    assert unlock[5:17] == [1800] * 12
    assert unlock[-5:] == [1000] * 5
    assert {lock for lock, _ in bench.pulses} == {1000}


def test_both_servos_press_together(bench):
    bench.firmware.press(1, 3, 1.0, 200)
    bench.run(200)
    assert bench.state.servo_us == (2000, 2000)


def test_repeated_id_never_presses_twice(bench):
    bench.firmware.press(7, 1, 1.0, 100)
    bench.run(600)
    before = bench.state
    for _ in range(3):
        bench.firmware.press(7, 1, 1.0, 100)
        bench.run(100)
    assert bench.state.press_end_us == before.press_end_us
    assert bench.state.servo_us == (1000, 1000)


def test_press_while_busy_is_refused_and_the_first_one_completes(bench):
    bench.firmware.press(1, 1, 1.0, 300)
    bench.run(100)
    bench.firmware.press(2, 2, 1.0, 100)
    assert bench.state[3:5] == (2, REFUSED)
    bench.run(400)
    assert bench.state[3:5] == (1, DONE)
    bench.firmware.press(2, 2, 1.0, 100)
    bench.run(100)
    assert bench.state.servo_us == (1000, 1000)


@pytest.mark.parametrize(
    ("servos", "strength", "hold_ms"),
    [(0, 1.0, 100), (4, 1.0, 100), (1, -0.1, 100), (1, 1.1, 100), (1, math.nan, 100), (1, 1.0, 0), (1, 1.0, 60_000)],
)
def test_invalid_press_is_refused_and_moves_nothing(bench, servos, strength, hold_ms):
    bench.firmware.press(5, servos, strength, hold_ms)
    assert bench.state[3:7] == (5, REFUSED, 0, 0)
    bench.run(200)
    assert set(bench.pulses) == {(1000, 1000)}


@pytest.mark.parametrize("early_us, pressed", [(1000, True), (0, True), (-1, False), (-3_600_000_000, False)])
def test_order_is_obeyed_up_to_its_time_and_not_later(bench, early_us, pressed):  # B8
    latest_us = (bench.state.time_us + early_us) % 2 ** 32
    bench.firmware.press(1, 1, 1.0, 100, latest_us)
    bench.firmware.command(0.5, 2, latest_us=latest_us)
    assert bench.state.press_state == (PRESSING if pressed else REFUSED)
    bench.run(400, silent=True)
    assert (bench.state.lift_height_m > 0.0) is pressed


def test_stop_holds_the_lift_releases_the_servos_and_lets_no_press_begin(bench):  # A3
    bench.run(2_000, height_m=1.0)
    bench.firmware.press(1, 1, 1.0, 5_000)
    bench.run(200, height_m=1.0)
    bench.firmware.command(1.0, 2, stop=True)
    bench.firmware.press(2, 1, 1.0, 100)
    bench.run(600, silent=True)
    held_m = bench.state.lift_height_m
    bench.run(200, silent=True)
    assert bench.state.lift_height_m == held_m < 0.5
    assert (bench.state.press_id, bench.state.press_state, bench.state.servo_us) == (2, REFUSED, (1000, 1000))


def test_press_id_0_is_no_press(bench):
    bench.firmware.press(0, 1, 1.0, 100)
    assert bench.state[3:5] == (0, NONE)


def test_silence_stops_lift_releases_servos_and_says_so(bench):
    bench.run(1_000, height_m=1.0)
    bench.firmware.press(3, 1, 1.0, 5_000)
    bench.run(900, silent=True)
    assert (bench.state.fault, bench.state.press_state, bench.state.servo_us) == (0, PRESSING, (2000, 1000))
    bench.run(700, silent=True)
    assert (bench.state.fault, bench.state.led_pattern) == (3, 8)
    assert (bench.state.press_state, bench.state.servo_us) == (DONE, (1000, 1000))
    held = bench.state.lift_height_m
    bench.run(1_000, silent=True)
    assert bench.state.lift_height_m == held < 0.5


def test_host_that_comes_back_ends_the_fault_and_the_lift_goes_on(bench):
    bench.run(2_000, silent=True)
    assert bench.state.fault == 3
    bench.run(3_000, height_m=0.2)
    assert (bench.state.fault, bench.state.led_pattern) == (0, 2)
    assert bench.state.lift_height_m == pytest.approx(0.2, abs=1e-6)


def test_clock_wraps_at_2_to_the_32(bench):
    bench.run(119_900)
    bench.firmware.press(1, 1, 1.0, 100)
    bench.run(200)
    assert bench.state.time_us == 100_000
    assert bench.state.press_start_us == 0
    assert bench.state.press_end_us == 100_000


def test_board_without_power_hears_nothing():
    firmware = SimulatedFirmware()
    firmware.press(1, 1, 1.0, 100)
    firmware.command(0.5, 2)
    firmware.step(START_NS)
    assert (firmware.state().press_id, firmware.state().led_pattern) == (0, 0)


def test_state_has_the_fields_of_the_message():
    messages = pytest.importorskip("mtr_msgs.msg")
    assert SimulatedFirmware().state()._fields == tuple(messages.FirmwareState.__slots__)[:-1]


def test_lift_that_is_stuck_stays_where_it_is_and_says_so(bench):
    bench.run(1000, 0.5)
    stuck_m = bench.firmware.lift_height_m
    bench.firmware.lift_is_stuck = True
    bench.run(1000, 0.5)
    assert 0.0 < bench.firmware.lift_height_m == stuck_m == bench.state.lift_height_m
    bench.firmware.lift_is_stuck = False
    bench.run(1000, 0.5)
    assert bench.firmware.lift_height_m > stuck_m


def test_servos_that_are_dead_press_nothing_and_nobody_says_so(bench):
    bench.firmware.servos_are_dead = True
    bench.firmware.press(7, 1, 1.0, 200)
    bench.run(1000)
    assert set(bench.pulses) == {(1000, 1000)} and bench.state.press_state == DONE


def test_clock_goes_on_while_the_world_stands_still():
    firmware = SimulatedFirmware()
    firmware.start(1_000_000_000)
    before = firmware.state().time_us
    firmware.stand(300_000_000)
    firmware.step(1_020_000_000)
    assert firmware.state().time_us - before == 320_000
