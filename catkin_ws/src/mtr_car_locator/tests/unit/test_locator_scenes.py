"""The locator maps whole synthetic scenes: what it finds, and when it says that it found nothing."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest
from locator_simulation import BOX, PARAMETERS, WHEEL, Scene, World, car_with_bumpers, closed, leg_at

from mtr_core.se2 import Pose2
from mtr_core.states import CarState

NOMINAL = PARAMETERS.car_from_start
OFF = Pose2(NOMINAL.x + 0.25, NOMINAL.y - 0.20, NOMINAL.heading + math.radians(5.0))
CAR = car_with_bumpers()
DRIFT = {"drift_m": 0.02, "drift_rad": math.radians(1.0)}

FOUND = {
    "box": Scene(closed(BOX)),
    "bumpers and wheels": Scene(CAR),
    "robot off its starting place": Scene(CAR, start=OFF),
    "slow pose error": Scene(CAR, start=OFF, seed=3, **DRIFT),
    "white pose error": Scene(CAR, start=OFF, drift_time_s=0.02, **DRIFT),
    "person beside the car": Scene(np.vstack([CAR, leg_at(0.3, 1.2), leg_at(0.5, 1.25)]), start=OFF),
    "person before the car": Scene(np.vstack([CAR, leg_at(2.6, 0.1), leg_at(2.65, -0.2)])),
    "neighbours and a wall": Scene(np.vstack([CAR, closed(BOX, (0.0, -5.5)), closed(BOX, (-8.0, 0.0))]), start=OFF),
}


@pytest.mark.parametrize("name", FOUND)
def test_car_is_located_within_3_cm_and_its_size_within_4_cm(name):
    world = World(FOUND[name])
    estimate = world.run()
    assert estimate.state == CarState.LOCATED, estimate.message
    position, heading, length, width = world.error()
    assert position < 0.03
    assert abs(math.degrees(heading)) < 0.5
    assert abs(length) < 0.04
    assert abs(width) < 0.04
    assert 0.01 < estimate.length_sigma < 0.10
    assert estimate.map_car_id == 7


@pytest.mark.parametrize("segments", [closed(BOX, (30.0, 0.0)), closed(((.3, .3), (-.3, .3), (-.3, -.3), (.3, -.3))),
                                      np.vstack([closed(WHEEL, (0.0, y)) for y in (-.5, .5)])])
def test_scene_without_a_car_fails_with_a_sentence(segments):
    world = World(Scene(segments))
    estimate = world.run()
    assert estimate.state == CarState.FAILED
    assert estimate.message.startswith("The Car was not found.")
    assert estimate.message.endswith(".")


def test_slow_drift_of_the_pose_widens_the_sigmas_and_a_large_one_fails():
    honest, drifting = World(Scene(CAR)), World(Scene(CAR, creep_mps=0.003))
    sure, unsure = honest.run(), drifting.run()
    assert unsure.state == CarState.LOCATED
    assert max(unsure.length_sigma, unsure.width_sigma) > 2.0 * max(sure.length_sigma, sure.width_sigma)
    lost = World(Scene(CAR, creep_mps=0.012)).run()
    assert lost.state == CarState.FAILED
    assert "drifted" in lost.message


def test_frame_never_moves_after_it_was_found_and_a_new_order_maps_again():
    world = World(Scene(CAR))
    found = world.run()
    for _ in range(100):
        world.step(mapping=True, map_car_id=7)
    assert world.estimates[-1] == found
    world.step(mapping=False, map_car_id=8)
    assert world.estimates[-1].state == CarState.LOCATED
    again = world.run(limit_s=1.0, map_car_id=8)
    assert again.state == CarState.LOCATED
    for _ in range(5):
        world.step(mapping=True, map_car_id=8)
    assert world.estimates[-1].state == CarState.COLLECTING
    assert world.run(map_car_id=8).state == CarState.LOCATED
    assert world.error()[0] < 0.03


def test_refused_place_is_left_out():
    world = World(Scene(CAR, refused=(3,)))
    assert world.run().state == CarState.LOCATED


def test_mapping_that_pauses_keeps_its_points_and_goes_on():
    world = World(Scene(CAR))
    for paused in (False, True, False):
        for _ in range(500):
            world.step(mapping=not paused, map_car_id=7)
    place = world.estimates[-1].place
    assert world.estimates[-1].state == CarState.COLLECTING
    assert place.place_id > 1
    assert world.run().state == CarState.LOCATED
