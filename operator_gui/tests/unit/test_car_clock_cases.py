"""Single cases of the clock maps, with numbers whose outcome is known exactly."""
# SPDX-License-Identifier: Apache-2.0
import math
import random
import statistics

import pytest

from mtr_operator.car_link.clocks.adapter_clock import AdapterClockMap, StampUnwrapper
from mtr_operator.car_link.clocks.arrival_clock import ArrivalClockMap

GAP_S = 0.03125
FIRST_S = 100.0


def add_pair(clock, stamp_s, offset_s=0.0, gap_s=GAP_S):
    """A Status in the middle of two frames of an adapter whose clock is the robot's less offset_s."""
    clock.frame(stamp_s - offset_s - gap_s / 2)
    clock.status(stamp_s, 0.0)
    clock.frame(stamp_s - offset_s + gap_s / 2)


def adapter_map(stamps, offset_s=0.0, gap_s=GAP_S):
    """Map after Statuses with these stamps."""
    clock = AdapterClockMap()
    for stamp_s in stamps:
        add_pair(clock, stamp_s, offset_s, gap_s)
    return clock


def arrival_map(stamps, delays=None, rate=1.0):
    """Map after Statuses with these stamps, each delayed by some of the robot's seconds; arrivals begin at 0."""
    clock = ArrivalClockMap()
    for stamp_s, delay_s in zip(stamps, delays or [0.0] * len(stamps)):
        clock.status(stamp_s, (stamp_s + delay_s - FIRST_S) / rate)
    return clock


def evenly(count, span_s):
    """This many stamps over a span."""
    return [FIRST_S + span_s * index / (count - 1) for index in range(count)]


@pytest.mark.parametrize("of", [adapter_map, arrival_map])
@pytest.mark.parametrize("count, span_s, is_ready", [
    (20, 2.0, True), (19, 4.0, False), (20, 1.9, False), (40, 1.9, False), (40, 2.0, True)])
def test_a_map_is_ready_after_20_statuses_over_2_seconds(of, count, span_s, is_ready):
    assert of(evenly(count, span_s)).is_ready == is_ready


def test_a_gap_of_a_quarter_second_still_gives_a_pair():
    assert adapter_map(evenly(20, 19.0), gap_s=0.25).is_ready


def test_a_frame_that_comes_late_after_a_status_gives_no_pair():
    clock = AdapterClockMap()
    for stamp_s in evenly(40, 39.0):
        clock.frame(stamp_s)
        clock.status(stamp_s, 0.0)
        clock.frame(stamp_s - 0.02)
    assert not clock.is_ready


def test_the_frames_of_one_stamp_are_one_frame():
    clock = AdapterClockMap()
    for stamp_s in evenly(20, 19.0):
        clock.frame(stamp_s)
        clock.status(stamp_s + GAP_S / 2, 0.0)
        clock.frame(stamp_s)
        clock.frame(stamp_s + GAP_S)
    assert clock.is_ready
    assert clock.to_robot(0.0) == pytest.approx(0.0, abs=1e-9)


def test_sigma_of_an_even_link_is_that_of_a_status_anywhere_between_its_frames():
    clock = adapter_map(evenly(20, 2.0), gap_s=0.2)
    assert clock.sigma_s == pytest.approx(0.2 / math.sqrt(12.0), rel=1e-4)


def test_sigma_of_a_long_window_is_that_of_quartz_clocks_200_ppm_apart():
    span_s = 28.5
    clock = adapter_map(evenly(20, span_s), gap_s=1e-6)
    assert clock.sigma_s == pytest.approx(200e-6 * span_s / math.sqrt(12.0), rel=1e-4)


def test_sigma_of_normally_scattered_delays_is_about_theirs():
    delay = statistics.NormalDist(0.1, 0.02)
    delays = [delay.inv_cdf((index + 0.5) / 300) for index in range(300)]
    random.Random(1).shuffle(delays)
    clock = AdapterClockMap()
    for stamp_s, offset_s in zip(evenly(300, 3.0), delays):
        add_pair(clock, stamp_s, offset_s, 1e-6)
    # A sixth of a normal distribution lies below -0.967 sigma.
    assert clock.sigma_s == pytest.approx(0.967 * 0.02, rel=0.01)


def test_nine_statuses_far_off_do_not_move_the_map():
    clock = adapter_map(evenly(40, 39.0))
    for index in range(9):
        add_pair(clock, 140.0 + index, 2.0)
    assert clock.is_ready
    assert clock.to_robot(0.0) == 0.0


def test_statuses_far_off_count_only_in_a_row():
    clock = adapter_map(evenly(40, 39.0))
    for index in range(19):
        add_pair(clock, 140.0 + index, 0.0 if index == 9 else 2.0)
    assert clock.is_ready
    assert clock.to_robot(0.0) == 0.0


def test_ten_statuses_far_off_begin_a_new_map_which_ten_more_complete():
    clock = adapter_map(evenly(40, 39.0))
    for index in range(10):
        add_pair(clock, 140.0 + index, -2.0)
    assert not clock.is_ready
    for index in range(10):
        add_pair(clock, 150.0 + index, -2.0)
    assert clock.is_ready
    assert clock.to_robot(0.0) == -2.0


def test_a_stamp_that_is_a_second_older_is_one_of_the_next_minute():
    unwrapper = StampUnwrapper()
    assert [unwrapper.unwrap(stamp) for stamp in (5_000, 4_001, 4_000)] == [5.0, 4.001, 64.0]


def test_arrival_map_starts_again_when_the_robots_clock_steps_back_within_its_window():
    clock = arrival_map(evenly(40, 4.0))
    clock.status(FIRST_S + 2.0, 4.1)
    assert not clock.is_ready


def test_arrival_map_keeps_its_pairs_when_statuses_arrive_in_disorder():
    clock = arrival_map(evenly(40, 4.0))
    clock.status(FIRST_S + 3.5, 4.1)
    clock.status(FIRST_S + 4.2, 4.2)
    assert clock.is_ready


def test_a_robot_runs_at_true_rate_though_its_delays_shrink():
    stamps = evenly(20, 5.0)
    clock = arrival_map(stamps, [0.04 - 0.002 * index for index in range(20)])
    assert clock.to_robot(100.0) - clock.to_robot(0.0) == pytest.approx(100.0, abs=1e-9)
    assert clock.to_robot(5.002) == pytest.approx(stamps[-1], abs=1e-9)


def test_sigma_of_the_arrivals_is_the_median_delay_beyond_the_shortest():
    clock = arrival_map(evenly(20, 5.0), [0.01, 0.05] * 10)
    assert clock.sigma_s == pytest.approx(math.hypot(0.02, 0.003), rel=1e-6)


def test_sigma_of_an_accelerated_robot_counts_the_way_in_its_own_seconds():
    clock = arrival_map(evenly(20, 16.0), rate=8.0)
    assert (clock.sigma_s, clock.rate) == (pytest.approx(8.0 * 0.003, rel=1e-6), pytest.approx(8.0))


@pytest.mark.parametrize("fast", [(0, 19), (2, 19), (0, 17), (3, 12)])
def test_the_line_of_an_accelerated_robot_runs_through_its_two_fastest_statuses(fast):
    stamps = evenly(20, 19.0)
    # The others' delays differ, so that none of their edges has the true rate.
    delays = [0.0 if index in fast else 0.5 + 0.3 * (index % 3) for index in range(20)]
    clock = arrival_map(stamps, delays, rate=4.0)
    assert clock.to_robot(0.0) == pytest.approx(FIRST_S, abs=1e-6)
    assert clock.to_robot(10.0) == pytest.approx(FIRST_S + 40.0, abs=1e-6)
