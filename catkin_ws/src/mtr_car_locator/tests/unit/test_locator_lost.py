"""Mapping of the Car while the robot's position is lost."""
# SPDX-License-Identifier: Apache-2.0
import pytest
from locator_simulation import Scene, World, car_with_bumpers

from mtr_car_locator.survey.surface_map import MapPhase
from mtr_core.se2 import Pose2
from mtr_core.states import CarState

START = Pose2(0.0, 0.0, 0.0)
REFUSED = "The way round the Car was not closed."


def wait(world, duration_s, mapping, map_car_id=8):
    for _ in range(int(duration_s / 0.02)):
        world.step(mapping=mapping, map_car_id=map_car_id)
    return world.newest


def test_map_of_a_lost_robot_waits_for_its_position_and_begins_where_that_is():
    world = World(Scene(car_with_bumpers()))
    found = world.run()
    world.is_lost = True
    wait(world, 1.0, mapping=False)
    # The robot is brought back to the starting place, so the newest valid pose is another one.
    assert world.pose.distance_to(START) > 1.0
    world.pose = START
    ordered = wait(world, 5.0, mapping=True)
    assert (ordered.state, ordered.phase, ordered.waypoint) == (CarState.COLLECTING, MapPhase.COLLECT, None)
    assert ordered.map_id not in (0, found.map_id)
    world.is_lost = False
    assert wait(world, 0.2, mapping=True).map_id == ordered.map_id
    again = world.run(map_car_id=8)
    assert again.state == CarState.LOCATED, again.message
    assert world.error()[0] < 0.01


def test_car_whose_position_was_lost_is_not_where_it_was_found():
    world = World(Scene(car_with_bumpers()))
    world.run()
    world.is_lost = True
    wait(world, 1.0, mapping=False)
    # The new map has another frame, in which the Car is elsewhere.
    world.place_car(world.car @ Pose2(3.0, 2.0, 0.3), car_with_bumpers())
    world.pose = world.car @ world.scene.start
    wait(world, 0.5, mapping=True)
    world.is_lost = False
    assert world.run(map_car_id=8).state == CarState.LOCATED
    assert world.error()[0] < 0.01


@pytest.fixture
def refused():
    """Return a world with a rejected map and a lost position, for which the state machine ends the mapping at once."""
    world = World(Scene(car_with_bumpers(), map_problem=REFUSED))
    while world.mapper.map is None:
        world.step(mapping=True, map_car_id=7)
    world.is_lost = True
    return world


def test_refused_map_is_told_though_the_mapping_has_ended(refused):
    estimate = wait(refused, 0.5, mapping=False, map_car_id=7)
    assert estimate.state == CarState.FAILED and REFUSED in estimate.message.text


def test_after_a_refused_map_the_same_order_begins_another(refused):
    failed = wait(refused, 1.0, mapping=False, map_car_id=7)
    refused.pose, refused.scene.map_problem = START, ""
    again = wait(refused, 1.0, mapping=True, map_car_id=7)
    assert (again.state, again.phase) == (CarState.COLLECTING, MapPhase.COLLECT) and again.map_id != failed.map_id
    refused.is_lost = False
    assert refused.run().state == CarState.LOCATED
    assert refused.error()[0] < 0.01


def test_short_gap_in_the_poses_is_no_lost_position(world):
    world.is_lost = True
    wait(world, 0.3, mapping=False, map_car_id=7)
    wait(world, 0.1, mapping=True)
    world.is_lost = False
    assert world.run(map_car_id=8).state == CarState.LOCATED
