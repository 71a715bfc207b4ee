"""Time that a line takes, and the picture of what was measured on it."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace

import pytest

from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.autolock import SCENARIO as AUTOLOCK
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.key_press import SCENARIO as KEY_PRESS
from mtr_operator.domain.scenarios.key_press_parameters import KeyPressParameters

CAR = CarDimensions(4.5, 1.8, 0.02, 0.01)
AXES = AutolockParameters(measurements_distance_m=10.0, measuring_speed_mps=0.4)
RADIALS = KeyPressParameters.from_mapping({"angle_between_radials_deg": 90.0})


@pytest.fixture(name="no_passive_entry")
def no_passive_entry_fixture(world):
    """The Car reacts to buttons only."""
    world.unlock_m, world.lock_m = -1.0, -1.0


def points_of(picture, label):
    """The set of points with this label."""
    return next(points for points in picture.point_sets if points.label == label)


def test_an_axis_takes_the_time_of_its_way_at_the_two_speeds():
    parameters = replace(AXES, straightening_distance_m=0.6, maximum_speed_mps=2.0)
    # 0.6 m at 2 m/s, then from 3.4 m half way to 0.5 m and back at 0.4 m/s.
    assert AUTOLOCK.expected_line_s(parameters) == pytest.approx(0.3 + 2.9 / 0.4)


def test_areas_are_outlines_of_where_the_car_unlocked_and_locked(run_scenario):
    picture = AUTOLOCK.picture(AXES, CAR, run_scenario(AUTOLOCK, AXES))
    unlocked, locked = points_of(picture, "Unlocked"), points_of(picture, "Locked")
    assert unlocked.points[0] == pytest.approx((2.25 + 1.5, 0.0), abs=0.005)
    assert locked.points[0] == pytest.approx((2.25 + 2.5, 0.0), abs=0.005)
    assert unlocked.is_outline and locked.is_outline
    assert len(unlocked.bars) == len(locked.bars) == 8
    assert not any(points_of(picture, label).known for label in ("Unlock not reached", "Lock not reached", "Invalid"))


def test_axes_without_a_reaction_are_marked_where_the_ways_ended(run_scenario, world):
    world.unlock_m = 0.3
    picture = AUTOLOCK.picture(AXES, CAR, run_scenario(AUTOLOCK, AXES))
    assert points_of(picture, "Unlock not reached").points[0] == pytest.approx((2.25 + 0.5, 0.0))
    assert points_of(picture, "Lock not reached").points[0] == pytest.approx((2.25 + 3.5, 0.0))
    assert points_of(picture, "Unlocked").known == ()


def test_a_distance_of_an_invalid_measurement_is_not_part_of_the_area(run_scenario):
    results = run_scenario(AUTOLOCK, AXES)
    results[0] = replace(results[0], unlock_status=LineStatus.INVALID)
    assert points_of(AUTOLOCK.picture(AXES, CAR, results), "Unlocked").points[0] is None


def test_a_radial_takes_the_time_of_its_way_and_of_the_presses_to_the_middle_place():
    parameters = replace(RADIALS, maximum_speed_mps=0.5, press_duration_s=0.2, attempts=2)
    # Seven places from 6 m to 3 m: 2 m of way, three places with two presses in vain, one press that works.
    assert KEY_PRESS.expected_line_s(parameters) == pytest.approx(2.0 / 0.5 + 3 * 2 * (0.5 + 1.0) + 0.5)


def test_the_nearest_place_may_leave_exactly_the_clearance():
    assert len(KEY_PRESS.lines(replace(RADIALS, clearance_m=0.75), CAR)) == 4


def test_radials_may_be_shown_before_the_car_is_measured():
    assert KEY_PRESS.lines_stay and not AUTOLOCK.lines_stay


@pytest.mark.usefixtures("no_passive_entry")
def test_outline_encloses_what_worked_and_an_invalid_radial_is_marked_at_its_first_place(run_scenario):
    results = run_scenario(KEY_PRESS, RADIALS)
    results[0] = replace(results[0], status=LineStatus.INVALID, distance_m=None)
    worked, failed, _, invalid = KEY_PRESS.picture(RADIALS, CAR, results).point_sets
    assert (worked.is_outline, failed.is_outline, invalid.is_outline) == (True, False, False)
    assert invalid.known == (pytest.approx((6.0, 0.0)),)
    assert worked.points[0] is None and len(worked.bars) == 3
