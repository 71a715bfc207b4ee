"""Returns of the drive: transformed like the key-frames, corrected by the range bias, without repetitions."""
# SPDX-License-Identifier: Apache-2.0
import math
import pickle

import numpy as np
import pytest

from mtr_car_locator.measure.close_up import MAX_SWEEPS, WayRound
from mtr_car_locator.scan import RangeBias, Returns
from mtr_core.se2 import Pose2

LIDAR = Pose2(0.12, 0.0, 0.0)
THING = (3.0, 1.5)


def drift(time_s):
    """Return the frame of the adjusted map as assumed by the robot."""
    return Pose2(0.02 * time_s, -0.01 * time_s, 0.003 * time_s)


def true_pose(time_s):
    return Pose2(0.5 * time_s, 0.1 * math.sin(time_s), 0.2 * time_s)


def sweep(time_s, bias_m=0.0, is_rear=False):
    """Return one return of the object, as located by a drifting robot."""
    viewer = true_pose(time_s).apply(LIDAR.x, LIDAR.y)
    away = np.subtract(THING, viewer)
    point = THING + bias_m * away / np.linalg.norm(away)
    return Returns(np.array([drift(time_s).apply(*point)]), np.array(drift(time_s).apply(*viewer)), time_s,
                   drift(time_s) @ true_pose(time_s), is_rear)


def way_round(times_s, bias_m=0.0, is_rear=False):
    way = WayRound(2.0, 1.0)
    for time_s in times_s:
        way.add(sweep(time_s, bias_m, is_rear), LIDAR)
    return way


def key_frames(*times_s):
    return np.array([(time_s, true_pose(time_s).x, true_pose(time_s).y, true_pose(time_s).heading)
                     for time_s in times_s])


@pytest.mark.parametrize("bias, is_rear", [(RangeBias(), False), (RangeBias(0.02, -0.01), False),
                                           (RangeBias(0.02, -0.01), True)])
def test_thing_seen_by_a_drifting_robot_is_where_the_adjusted_map_has_it(bias, is_rear):
    times = np.arange(0.0, 8.0, 0.04)
    way = way_round(times, bias.rear_m if is_rear else bias.front_m, is_rear)
    seen = way.sweeps().close_up(key_frames(*np.arange(0.5, 7.6, 0.5)), bias)
    assert len(seen.points) == pytest.approx(7.0 / 0.04, abs=2)
    assert np.abs(seen.points - THING).max() < 0.0005
    away = np.subtract(THING, true_pose(0.52).apply(LIDAR.x, LIDAR.y))
    assert seen.beams[0] == pytest.approx(away / np.linalg.norm(away), abs=0.01)


def test_frame_of_the_car_turns_points_and_beams():
    seen = way_round(np.arange(0.0, 2.0, 0.04)).sweeps().close_up(key_frames(0.0, 1.0, 1.9), RangeBias())
    turned = seen.in_frame(Pose2(*THING, math.pi / 2.0))
    assert np.abs(turned.points).max() < 0.0005
    assert turned.beams[0] == pytest.approx((seen.beams[0][1], -seen.beams[0][0]))


def test_sweeps_outside_of_the_key_frames_do_not_count():
    assert way_round(np.arange(0.0, 2.0, 0.04)).sweeps().close_up(key_frames(5.0, 6.0), RangeBias()) is None
    assert way_round(np.arange(0.0, 2.0, 0.04)).sweeps().close_up(key_frames(1.0), RangeBias()) is None
    assert way_round([]).sweeps().close_up(key_frames(1.0, 2.0), RangeBias()) is None


def test_robot_that_stands_adds_nothing_and_what_is_far_is_left_out():
    way = way_round(np.arange(0.0, 2.0, 0.04))
    for _ in range(2 * MAX_SWEEPS):
        way.add(sweep(1.96), LIDAR)
    assert len(way.sweeps().close_up(key_frames(0.0, 1.9), RangeBias()).points) == 48
    far = WayRound(20.0, 1.0)
    for time_s in np.arange(0.0, 2.0, 0.04):
        far.add(sweep(time_s), LIDAR)
    assert len(far.sweeps().close_up(key_frames(0.0, 1.9), RangeBias()).points) == 0


def test_sweeps_get_to_another_process_as_two_arrays_however_many_they_are():
    buffers = []
    sweeps = way_round(np.arange(0.0, 80.0, 0.04)).sweeps()
    # Pickling holds the interpreter lock; thousands of objects blocked a node for half a second on a busy machine.
    assert len(pickle.dumps(sweeps, 5, buffer_callback=buffers.append)) < 1000
    assert len(buffers) == 2 and len(sweeps.rows) > 1000
