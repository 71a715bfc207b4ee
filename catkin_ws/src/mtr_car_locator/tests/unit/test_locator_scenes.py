"""Mapping of complete synthetic scenes: located Car, or a report that there is none."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_simulation import (
    BOX,
    PARAMETERS,
    WHEEL,
    Scene,
    World,
    car_with_bumpers,
    closed,
    leg_at,
    wheels_alone,
)

from mtr_car_locator.parameters import DataSheet, LocatorParameters
from mtr_car_locator.scan import RangeBias
from mtr_car_locator.survey.surface_map import MapPhase
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

NOMINAL = PARAMETERS.car_from_start
OFF = Pose2(NOMINAL.x + 0.25, NOMINAL.y - 0.20, NOMINAL.heading + math.radians(5.0))
# Largest placement error of the Operator: 1 m and 20 degrees.
FAR_OFF = Pose2(NOMINAL.x - 0.8, NOMINAL.y + 0.6, NOMINAL.heading - math.radians(19.0))
CAR = car_with_bumpers()
DRIFT = {"drift_m": 0.02, "drift_rad": math.radians(1.0)}
WALL = ((4.5, 0.1), (-4.5, 0.1), (-4.5, -0.1), (4.5, -0.1))

FOUND = {
    "box": Scene(closed(BOX)),
    "bumpers and wheels": Scene(CAR),
    "robot off its starting place": Scene(CAR, start=OFF),
    "robot as far off as allowed": Scene(CAR, start=FAR_OFF),
    "localization drifts until its map is adjusted": Scene(CAR, start=OFF, seed=3, **DRIFT),
    "person beside the car": Scene(np.vstack([CAR, leg_at(0.3, 1.2), leg_at(0.5, 1.25)]), start=OFF),
    "person before the car": Scene(np.vstack([CAR, leg_at(2.6, 0.1), leg_at(2.65, -0.2)])),
    "second car 0.5 m beside": Scene(np.vstack([CAR, closed(BOX, (0.0, -2.3))]), start=OFF),
    "second car 0.4 m behind": Scene(np.vstack([CAR, closed(BOX, (-4.9, 0.1))]), start=OFF),
}


@pytest.mark.parametrize("name", FOUND)
def test_car_is_located_within_1_cm_and_its_size_within_2_cm(name):
    world = World(FOUND[name])
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    position, heading, length, width = world.error()
    assert position < 0.01
    assert abs(math.degrees(heading)) < 0.2
    assert abs(length) < 0.02
    assert abs(width) < 0.02
    plane = estimate.fit.in_plane
    assert max(plane.length_sigma, plane.width_sigma) < 0.01
    assert (estimate.map_car_id, estimate.revision) == (7, 1)


def test_side_that_a_wall_hides_is_placed_by_the_expected_width_and_says_so():
    world = World(Scene(np.vstack([CAR, closed(WALL, (0.0, -1.4))]), start=OFF))
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    position, heading, length, _ = world.error()
    assert position < 0.02 and abs(math.degrees(heading)) < 0.2 and abs(length) < 0.02
    assert estimate.width_sigma > 0.08 and "right" not in estimate.fit.seen


def test_outline_is_round_at_the_corners_and_closed_at_the_wheels():
    estimate = World(FOUND["bumpers and wheels"]).run()
    outline = np.array(estimate.outline)
    assert np.abs(outline).max(axis=0) == pytest.approx((2.25, 0.9), abs=0.02)
    area = 0.5 * np.sum(outline[:, 0] * np.roll(outline[:, 1], -1) - np.roll(outline[:, 0], -1) * outline[:, 1])
    assert 7.2 < area < 7.95
    assert not np.any((outline[:, 0] > 2.1) & (np.abs(outline[:, 1]) > 0.8))


def test_wheels_alone_give_pose_and_width_and_a_length_that_says_how_unsure_it_is():
    world = World(Scene(wheels_alone(), start=OFF))
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    position, heading, length, width = world.error()
    assert "wheels" in estimate.message.text
    assert position < 0.02 and abs(math.degrees(heading)) < 0.2
    assert abs(length) < 2.0 * estimate.length_sigma and estimate.length_sigma > 0.1
    assert abs(width) < 2.0 * estimate.width_sigma and estimate.width_sigma > 0.03


def test_known_size_makes_a_car_on_wheels_exact():
    sheet = DataSheet(known_length_m=4.5, known_width_m=1.8, front_overhang_m=0.925)
    world = World(Scene(wheels_alone(), start=OFF, parameters=LocatorParameters(sheet=sheet)))
    estimate = world.run()
    position, _, length, width = world.error()
    assert position < 0.02 and abs(length) < 0.001 and abs(width) < 0.001
    assert estimate.sigmas[0] < 0.03 and estimate.length_sigma < 0.03


@pytest.mark.parametrize("segments", [closed(BOX, (30.0, 0.0)), closed(((.3, .3), (-.3, .3), (-.3, -.3), (.3, -.3))),
                                      np.vstack([closed(WHEEL, (0.0, y)) for y in (-.5, .5)]),
                                      np.vstack([leg_at(1.0, 0.8), leg_at(1.2, 0.5), leg_at(-1.0, -0.4)])],
                         ids=["nothing", "box of 60 cm", "two wheels", "persons"])
def test_scene_without_a_car_fails_with_a_sentence_before_the_robot_moves(segments):
    world = World(Scene(segments))
    estimate = world.run()
    assert estimate.state == CarState.FAILED
    assert estimate.message.text.startswith("The Car was not found.") and "starting place" in estimate.message.text
    assert world.pose == Pose2(0.0, 0.0, 0.0)


def test_map_that_localization_cannot_make_fails_with_its_sentence():
    estimate = World(Scene(CAR, map_problem="The way round was not closed.")).run()
    assert estimate.state == CarState.FAILED
    assert "The way round was not closed." in estimate.message.text


def test_localization_without_a_map_leaves_the_locator_its_own_surfels():
    world = World(Scene(CAR, start=OFF, maps=False, pose_sigma_m=0.02, **DRIFT))
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    # The drift moves the Car like the robot.
    assert world.error()[0] < 2.0 * world.scene.pose_sigma_m
    assert estimate.length_sigma > 0.02


def test_size_of_own_surfels_is_as_unsure_as_a_range_bias_that_nobody_estimates():
    estimate = World(Scene(CAR, maps=False, range_bias=RangeBias(0.03, 0.03))).run()
    size = estimate.fit.in_plane
    assert abs(size.length - 4.5) > 0.03 and abs(size.length - 4.5) < 2.0 * size.length_sigma
    assert abs(size.width - 1.8) < 2.0 * size.width_sigma


def test_missing_map_fails_after_its_time():
    world = World(Scene(CAR))
    while not world.estimates or world.newest.phase is not MapPhase.FREEZE:
        world.step(mapping=True, map_car_id=7)
    world.mapper.map, world.scene.maps = None, False
    estimate = world.run(limit_s=PARAMETERS.map_limit_s + 1.0)
    assert estimate.state == CarState.FAILED and "map" in estimate.message.text


def test_frame_stays_until_a_new_order_maps_again():
    world = World(Scene(CAR))
    found = world.run()
    for _ in range(100):
        world.step(mapping=True, map_car_id=7)
    assert world.newest == found
    world.step(mapping=False, map_car_id=8)
    assert world.newest.state == CarState.LOCATED
    for _ in range(10):
        world.step(mapping=True, map_car_id=8)
    assert world.newest.state == CarState.COLLECTING and world.newest.map_id != found.map_id
    again = world.run(map_car_id=8)
    assert (again.state, again.revision, again.map_car_id) == (CarState.LOCATED, 2, 8)
    assert world.error()[0] < 0.01


def test_refused_place_is_left_out():
    assert World(Scene(CAR, refused=(3,))).run().state == CarState.LOCATED


def test_blocked_way_is_left_after_a_while_and_the_other_way_is_taken():
    world = World(Scene(CAR, blocked=(3,)))
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    assert world.error()[0] < 0.01


def test_mapping_that_pauses_goes_on_where_it_was():
    world = World(Scene(CAR))
    for paused in (False, True, False):
        for _ in range(500):
            world.step(mapping=not paused, map_car_id=7)
    assert world.newest.state == CarState.COLLECTING and world.newest.waypoint.id > 1
    map_id = world.newest.map_id
    world.run()
    assert world.newest.state == CarState.LOCATED
    assert {estimate.map_id for estimate in world.estimates if estimate.map_id} == {map_id}


def test_map_that_changes_under_the_car_ends_its_frame():
    world = World(Scene(CAR))
    world.run()
    world.mapper.revision += 1
    world.stand(0.2)
    assert world.newest.state == CarState.FAILED and "another map" in world.newest.message.text
