"""Maps from the clocks that stamp CAN frames to the robot's, with delays like those of real and simulated links."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
import statistics

import pytest

from mtr_operator.car_link.clocks.adapter_clock import AdapterClockMap, StampUnwrapper
from mtr_operator.car_link.clocks.arrival_clock import ArrivalClockMap

SEEDS = range(10)
STEP_S = 0.02
STATUS_STEPS = 5
PHASE_S = 0.007
OFFSET_S = 1234.567


def bursty_simulation(seed, duration_s, status_delay_s=0.0005, frame_delay_s=0.0003):
    """Arrivals of a simulation at about eight times real time, in order: (arrival, kind, stamp on its own clock).

    Each 20 ms step takes 1 to 4 ms of wall time; a tick of the dispatcher (each 100 ms) holds the simulator until the
    Status is sent. The frame of a step is up to 13 ms old when it is written. Delays are exponential.
    """
    chance = random.Random(seed)
    events, wall_s = [], 50.0
    for step in range(1, round(duration_s / STEP_S) + 1):
        time_s = step * STEP_S
        wall_s += chance.uniform(0.001, 0.004)
        frame_s = time_s - STEP_S + PHASE_S
        events.append((wall_s + chance.expovariate(1 / frame_delay_s), "frame", frame_s - OFFSET_S))
        if step % STATUS_STEPS == 0:
            wall_s += chance.uniform(0.001, 0.003)
            events.append((wall_s + chance.expovariate(1 / status_delay_s), "status", time_s))
    return sorted(events)


def robot_in_real_time(seed, duration_s, rate=1.0, adapter_ppm=0.0):
    """Arrivals of a real robot over Wi-Fi, or of one on a clock that runs evenly at another rate."""
    chance = random.Random(seed)
    events = []
    for index in range(round(duration_s / STEP_S)):
        time_s = index * STEP_S + PHASE_S
        stamp_s = (time_s - OFFSET_S) * (1.0 + adapter_ppm * 1e-6)
        events.append((time_s / rate + chance.expovariate(1 / 0.0005), "frame", stamp_s))
    for index in range(round(duration_s * 10)):
        # Status is not in phase with the frames on two independent machines.
        time_s = index * 0.1 + chance.uniform(0.0, 0.02)
        events.append((time_s / rate + 0.001 + chance.expovariate(1 / 0.004), "status", time_s))
    return sorted(events)


def fed(clock, events):
    """The map after these arrivals."""
    for arrival_s, kind, stamp_s in events:
        if kind == "status":
            clock.status(stamp_s, arrival_s)
        else:
            clock.frame(stamp_s)
    return clock


def offset_error(clock):
    """Error of the adapter's offset in s."""
    return clock.to_robot(0.0) - OFFSET_S


@pytest.mark.parametrize("seed", SEEDS)
def test_adapter_offset_is_within_5_ms_after_5_s_of_bursty_simulation(seed):
    clock = fed(AdapterClockMap(), bursty_simulation(seed, 5.0))
    assert abs(offset_error(clock)) < 0.005
    assert 0.002 < clock.sigma_s < 0.02


@pytest.mark.parametrize("seed", SEEDS)
def test_adapter_offset_is_within_5_ms_after_5_s_of_real_time(seed):
    clock = fed(AdapterClockMap(), robot_in_real_time(seed, 5.0))
    assert abs(offset_error(clock)) < 0.008
    assert abs(offset_error(clock)) < 2.0 * clock.sigma_s


@pytest.mark.parametrize("ppm", [-200.0, 200.0])
def test_adapter_offset_follows_the_drift_of_its_quartz(ppm):
    duration_s = 120.0
    clock = fed(AdapterClockMap(), robot_in_real_time(1, duration_s, adapter_ppm=ppm))
    now_s = (duration_s - OFFSET_S) * (1.0 + ppm * 1e-6)
    error_s = clock.to_robot(now_s) - duration_s
    assert abs(error_s) < 0.012
    assert abs(error_s) < 3.0 * clock.sigma_s


@pytest.mark.parametrize("seed", SEEDS)
def test_sigma_covers_the_error_when_all_statuses_are_late(seed):
    clock = fed(AdapterClockMap(), bursty_simulation(seed, 10.0, status_delay_s=0.004))
    assert abs(offset_error(clock)) < 3.0 * clock.sigma_s


def test_adapter_map_is_not_ready_before_two_seconds():
    events = bursty_simulation(1, 4.0)
    clock = fed(AdapterClockMap(), [event for event in events if event[0] <= events[len(events) // 3][0]])
    assert not clock.is_ready
    assert fed(AdapterClockMap(), events).is_ready


def test_adapter_that_starts_its_clock_again_is_followed():
    clock = fed(AdapterClockMap(), bursty_simulation(1, 20.0))
    again = [(arrival_s, kind, stamp_s + (57.3 if kind == "frame" else 20.0))
             for arrival_s, kind, stamp_s in bursty_simulation(2, 5.0)]
    assert fed(clock, again).to_robot(57.3 - OFFSET_S) == pytest.approx(20.0, abs=0.005)


def test_a_gap_in_the_frames_gives_no_pair():
    clock = AdapterClockMap()
    for index in range(40):
        clock.frame(index * 1.0)
        clock.status(index * 1.0 + 0.5, 0.0)
    assert not clock.is_ready


def test_stamps_continue_over_the_minute():
    unwrapper = StampUnwrapper()
    stamps = [59_960, 59_980, 0, 20, 15, 40, 30_000, 59_999, 19]
    assert [unwrapper.unwrap(stamp) for stamp in stamps] == pytest.approx(
        [59.96, 59.98, 60.0, 60.02, 60.015, 60.04, 90.0, 119.999, 120.019])


@pytest.mark.parametrize("rate", [1.0, 1.0001, 0.5, 8.0])
@pytest.mark.parametrize("seed", SEEDS)
def test_arrival_map_finds_offset_and_rate_within_5_ms_after_5_s(rate, seed):
    clock = fed(ArrivalClockMap(), robot_in_real_time(seed, 5.0, rate))
    # Delays count in robot time: 1 ms of the shortest is 8 ms at 8 times real time, and no map can know it.
    errors = [clock.to_robot(time_s / rate) - time_s + 0.001 * rate for time_s in (3.0, 4.0, 5.0)]
    assert max(map(abs, errors)) < 0.005 * max(rate, 1.0)
    assert max(map(abs, errors)) < 3.0 * clock.sigma_s


def test_arrival_map_ignores_late_statuses():
    events = robot_in_real_time(1, 8.0)
    late = [(arrival_s + (0.3 if index % 7 == 0 else 0.0), kind, stamp_s)
            for index, (arrival_s, kind, stamp_s) in enumerate(events)]
    clock = fed(ArrivalClockMap(), sorted(late))
    assert clock.to_robot(8.0) == pytest.approx(8.0, abs=0.006)


def test_arrival_map_starts_again_when_the_robot_does():
    clock = fed(ArrivalClockMap(), robot_in_real_time(1, 5.0))
    clock.status(0.0, 6.0)
    assert not clock.is_ready


def test_sigma_of_a_new_map_is_unknown():
    assert math.isnan(AdapterClockMap().sigma_s) and math.isnan(ArrivalClockMap().sigma_s)


def test_offset_and_sigma_are_those_of_all_pairs_that_are_kept_also_after_a_jump():
    chance, pairs, clocks, local_s = random.Random(4), [], AdapterClockMap(), 10.0
    clocks.frame(local_s)
    for number in range(900):
        offset_s = OFFSET_S + (50.0 if number >= 500 else 0.0)
        stamp_s = local_s + offset_s + chance.uniform(0.0, 0.02)
        clocks.status(stamp_s, stamp_s)
        before_s, local_s = local_s, local_s + chance.choice((0.02, 0.04, 0.1))
        clocks.frame(local_s)
        pairs = [*pairs, (stamp_s, stamp_s - (before_s + local_s) / 2, local_s - before_s)][-300:]
        # Ten pairs in a row tell that a clock was set: those before are of no use.
        pairs = pairs[-10:] if number == 509 else pairs
        if 20 < number < 500 or number > 530:
            offsets = [offset_s for _, offset_s, _ in pairs]
            tiles = statistics.quantiles(offsets, n=6)
            drift_s = 200e-6 * (pairs[-1][0] - pairs[0][0]) / 2
            gap_s = statistics.median(gap_s for _, _, gap_s in pairs)
            assert clocks.to_robot(0.0) == statistics.median(offsets), number
            assert clocks.sigma_s == math.hypot((tiles[-1] - tiles[0]) / 2, gap_s / math.sqrt(12.0),
                                                drift_s / math.sqrt(3.0)), number
