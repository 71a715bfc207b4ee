"""Repeated observation of the Car: self-check from two places, frame corrections at standstill."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_simulation import Scene, World, car_with_bumpers, closed, leg_at, wheels_alone

from mtr_core.se2 import Pose2
from mtr_core.states import CarState, Check

CAR = car_with_bumpers()
# A stationary robot observes every 10 s, and two observations must agree.
LOOKED_AGAIN_S = 15.0
DOOR = closed(((1.0, 0.9), (1.0, 0.95), (0.6, 1.7), (0.55, 1.7)))


def moved(world, x, y, degrees):
    """Move the Car in its own frame."""
    world.place_car(world.car @ Pose2(x, y, math.radians(degrees)), CAR)


def test_car_that_stands_passes_from_two_places(world):
    report = world.check(3).check
    assert (report.check_id, report.state) == (3, Check.PASSED)
    assert report.difference_m < 0.005 and report.difference_rad < math.radians(0.1)
    places = {estimate.waypoint.id for estimate in world.estimates if estimate.waypoint and estimate.fit}
    assert len(places) == 2
    assert world.newest.waypoint is None


@pytest.mark.parametrize("motion, difference_m", [((0.03, 0.0, 0.0), 0.03), ((0.0, 0.025, 0.0), 0.025),
                                                  ((-0.02, 0.02, 0.3), 0.028)])
def test_moved_car_fails_with_the_difference(world, motion, difference_m):
    moved(world, *motion)
    report = world.check(4).check
    assert report.state is Check.FAILED
    assert report.difference_m == pytest.approx(difference_m, abs=0.006)
    assert report.difference_rad == pytest.approx(math.radians(motion[2]), abs=math.radians(0.1))
    assert "allowed is 2.0 cm" in report.message.text


def drifting(world, seed):
    """Set pose errors of an open field with LiDARs by data sheet: 1 cm rms per direction, varying within seconds."""
    scene = world.scene
    scene.drift_m, scene.drift_rad, scene.pose_sigma_m, scene.range_sigma_m = 0.01, 0.002, 0.01, 0.02
    scene.rng = np.random.default_rng(seed)


@pytest.mark.parametrize("seed", range(4))
def test_car_that_stands_gives_no_false_alarm_to_a_robot_that_is_a_centimetre_off(world, seed):
    drifting(world, seed)
    report = world.check(3).check
    assert report.state is Check.PASSED and report.difference_m < 0.018
    assert world.stand(LOOKED_AGAIN_S).revision == 1


@pytest.mark.parametrize("seed, motion", [(1, (0.05, 0.0, 0.0)), (2, (0.05, 0.0, 0.0)), (3, (0.0, 0.05, 0.0)),
                                          (4, (0.0, -0.05, 0.0))])
def test_car_moved_by_5_cm_is_noticed_by_a_robot_that_is_a_centimetre_off(world, seed, motion):
    drifting(world, seed)
    moved(world, *motion)
    report = world.check(3).check
    assert report.state is Check.FAILED
    assert report.difference_m == pytest.approx(0.05, abs=0.02)


def test_turned_car_fails(world):
    moved(world, 0.0, 0.0, 0.8)
    report = world.check(4).check
    assert report.state is Check.FAILED
    assert math.degrees(report.difference_rad) == pytest.approx(0.8, abs=0.1)


def test_difference_below_the_limit_passes_and_is_told(world):
    moved(world, 0.012, 0.0, 0.0)
    report = world.check(4).check
    assert report.state is Check.PASSED
    assert report.difference_m == pytest.approx(0.012, abs=0.004)


def test_person_or_open_door_beside_the_car_is_no_difference(world):
    world.place_car(world.car, np.vstack([CAR, DOOR, leg_at(2.6, 0.1), leg_at(0.3, 1.1)]))
    report = world.check(4).check
    assert report.state is Check.PASSED and report.difference_m < 0.01


def test_car_that_has_gone_fails_without_a_figure(world):
    world.place_car(Pose2(50.0, 0.0, 0.0), CAR)
    report = world.check(4).check
    assert report.state is Check.FAILED and math.isnan(report.difference_m)


def test_place_that_cannot_be_reached_is_replaced_by_another_corner(world):
    first = world.newest
    next_id = max(estimate.waypoint.id for estimate in world.estimates if estimate.waypoint) + 1
    world.scene.refused = (next_id,)
    assert world.check(5).check.state is Check.PASSED
    assert world.newest.revision == first.revision


def test_checked_again_under_a_new_number(world):
    assert world.check(3).check.check_id == 3
    again = world.check(4).check
    assert (again.check_id, again.state) == (4, Check.PASSED)


def test_car_on_wheels_can_be_checked():
    world = World(Scene(wheels_alone()))
    world.run()
    assert world.check(3).check.state is Check.PASSED


def test_standing_robot_sees_no_reason_to_change_the_frame(world):
    before = world.newest
    assert world.stand(15.0).rectangle == before.rectangle
    assert world.newest.revision == 1


def test_small_motion_of_the_car_becomes_a_new_revision_with_its_correction(world):
    moved(world, 0.04, 0.015, 0.4)
    after = world.stand(LOOKED_AGAIN_S)
    assert (after.state, after.revision) == (CarState.LOCATED, 2)
    correction = after.correction
    assert (correction.x, correction.y) == pytest.approx((0.04, 0.015), abs=0.004)
    assert math.degrees(correction.heading) == pytest.approx(0.4, abs=0.1)
    assert world.error()[0] < 0.005
    assert "corrected" in after.message.text and "revision 2" in after.message.text


def test_motion_below_the_limit_does_not_change_the_frame(world):
    moved(world, 0.006, 0.0, 0.0)
    assert world.stand(LOOKED_AGAIN_S).revision == 1


def test_frame_does_not_change_while_the_robot_moves(world):
    moved(world, 0.04, 0.0, 0.0)
    world.pushed_mps = 0.05
    assert world.stand(LOOKED_AGAIN_S).revision == 1
    world.pushed_mps = 0.0
    assert world.stand(LOOKED_AGAIN_S).revision == 2


def test_car_that_was_moved_far_is_lost_with_a_sentence(world):
    moved(world, 0.15, 0.0, 0.0)
    after = world.stand(LOOKED_AGAIN_S)
    assert after.state == CarState.FAILED and "was moved" in after.message.text


@pytest.mark.parametrize("motion", [(0.3, 0.0, 0.0), (-0.5, 0.0, 0.0), (1.0, 0.0, 0.0), (2.0, 0.0, 0.0),
                                    (0.0, 0.4, 0.0), (0.0, -0.8, 1.0), (0.6, 0.3, 3.0)])
def test_car_that_was_moved_along_its_own_sides_is_lost_and_not_corrected_by_a_part_of_it(world, motion):
    """Its long sides stay on the same lines, and the nearest old surface is another one."""
    moved(world, *motion)
    after = world.stand(LOOKED_AGAIN_S)
    assert after.state == CarState.FAILED and "was moved" in after.message.text
    assert after.revision == 1


@pytest.mark.parametrize("motion", [(0.5, 0.0, 0.0), (0.0, 0.5, 0.0), (1.5, 0.0, 0.0)])
def test_car_that_was_moved_by_half_a_metre_fails_the_check(world, motion):
    moved(world, *motion)
    report = world.check(4).check
    assert report.state is Check.FAILED and report.difference_m > 0.1


def test_persons_and_things_beside_the_car_are_no_motion(world):
    legs = [leg_at(2.6 + 0.2 * k, 0.3 * k) for k in range(4)]
    wall = np.array([[2.9, -1.0, 2.9, 1.2]])
    world.place_car(world.car, np.vstack([CAR, DOOR, *legs, wall]))
    assert world.stand(LOOKED_AGAIN_S).revision == 1
    assert world.newest.state == CarState.LOCATED
    assert world.check(4).check.state is Check.PASSED


def test_car_that_drove_away_is_lost(world):
    world.place_car(Pose2(50.0, 0.0, 0.0), CAR)
    after = world.stand(20.0)
    assert after.state == CarState.FAILED and "no longer seen" in after.message.text


def test_unsure_pose_of_the_robot_is_no_evidence_against_the_car():
    world = World(Scene(CAR, pose_sigma_m=0.03))
    world.run()
    moved(world, 0.03, 0.0, 0.0)
    assert world.stand(LOOKED_AGAIN_S).revision == 1
