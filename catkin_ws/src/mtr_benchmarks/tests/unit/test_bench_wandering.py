"""An abducted robot is put down at a free place, and drives on near the Car without contacts."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import numpy as np
import pytest

from mtr_benchmarks.localization.drives.legs import MAX_TURN_RADPS, CarryLeg, LiftLeg, WanderLeg, leg_name
from mtr_benchmarks.localization.drives.options import DriveOptions
from mtr_benchmarks.localization.drives.pattern import ABDUCT, WANDER, WANDER_AFTER_S, pieces
from mtr_benchmarks.localization.drives.record import MAX_WANDER_S, MIN_WANDER_S, plan
from mtr_benchmarks.localization.drives.selection import SCENES, abductions, all_drives, options, repeated
from mtr_benchmarks.localization.drives.site_bodies import (
    MAX_JUMP_M,
    MIN_JUMP_M,
    PLACE_CLEARANCE_M,
    Body,
    Jump,
    clearance_m,
    random_jump,
    site_bodies,
)
from mtr_benchmarks.localization.drives.wandering import FACING_RAD, MAX_SPEED_MPS, MIN_SPEED_MPS, Wanderer
from mtr_core.errors import ConfigurationError
from mtr_core.se2 import Pose2, wrap_angle
from mtr_simulation.noise import stream
from mtr_simulation.sim import Sim
from mtr_simulation.site.scenario import SCENARIOS, Scenario
from mtr_simulation.site.surroundings import Cone, ParkedCar, Pole, Walk, Wall

TICK_S = 0.02
# Radius of the robot's circle, which contains the key's tip and the rear corners.
ROBOT_RADIUS_M = 0.35
BESIDE = Pose2(0.5, 2.6, 0.0)


def wandered(bodies, pose, seed, duration_s=25.0):
    """Return poses and commands of a robot that follows commands immediately."""
    wanderer, poses, commands, done = Wanderer(bodies, stream(seed, "test"), duration_s, TICK_S), [pose], [], False
    while not done:
        (speed, turning), done = wanderer.update(poses[-1])
        commands.append((speed, turning))
        poses.append(poses[-1] @ Pose2(speed * TICK_S, 0.0, turning * TICK_S))
    return poses, np.array(commands)


@pytest.mark.parametrize(("place", "expected_m"), [((3.0, 0.0), 1.0), ((0.0, -4.0), 3.0), ((5.0, 5.0), 5.0),
                                                   ((0.0, 0.0), -1.0), ((1.5, 0.9), -0.1)])
def test_clearance_of_a_rectangle(place, expected_m):
    assert Body(Pose2(0.0, 0.0, 0.0), 2.0, 1.0).clearance_m(*place) == pytest.approx(expected_m)


def test_each_thing_of_a_site_is_where_it_stands():
    site = Scenario(poles=(Pole(6.0, 1.0, 0.1),), cones=(Cone(-6.0, 1.0, 0.2),),
                    walls=(Wall(Pose2(0.0, 9.0, 0.3), 4.0, 0.2),), parked_cars=(ParkedCar(Pose2(-8.0, -7.0, 1.0)),),
                    person=Walk((5.0, -9.0), (9.0, -9.0)))
    bodies, car_from_world = site_bodies(site), site.world_from_car.inverse()

    def room(x_m, y_m):
        return clearance_m(bodies, *car_from_world.apply(x_m, y_m))

    assert len(bodies) == 6
    assert room(6.0, 1.5) == pytest.approx(0.4)
    assert room(-6.0, 1.5) == pytest.approx(0.3)
    assert room(-math.sin(0.3) * 0.6, 9.0 + math.cos(0.3) * 0.6) == pytest.approx(0.5)
    assert room(-8.0, -7.0) == pytest.approx(-0.9)
    assert room(7.0, -10.0) == pytest.approx(0.6)
    assert room(1.3, -0.7) == pytest.approx(-0.9)


@pytest.mark.parametrize("scene", SCENES)
def test_what_the_robot_touches_is_nearer_than_its_circle(scene):
    """The shapes match the physics: places with room have no contact, and places inside the Car have one."""
    site = SCENARIOS[scene]
    sim, bodies = Sim(1, site), site_bodies(site)
    noise = np.random.default_rng(2)
    for x, y, heading in noise.uniform((-11.0, -11.0, -3.0), (11.0, 11.0, 3.0), (300, 3)):
        sim.kidnap(site.world_from_car @ Pose2(x, y, heading))
        room_m = clearance_m(bodies, x, y)
        if room_m > ROBOT_RADIUS_M or room_m < -0.3:
            assert bool(sim.contacts()) == (room_m < 0.0), (x, y)


@pytest.mark.parametrize("scene", SCENES)
def test_jump_ends_at_a_free_place_and_is_as_long_as_it_may_be(scene):
    bodies, chance = site_bodies(options(scene, 2).scenario()), np.random.default_rng(5)
    jumps = [random_jump(bodies, BESIDE, chance) for _ in range(400)]
    places = [jump.applied(BESIDE) for jump in jumps]
    assert min(clearance_m(bodies, place.x, place.y) for place in places) >= PLACE_CLEARANCE_M
    lengths = np.array([place.distance_to(BESIDE) for place in places])
    assert lengths.min() >= MIN_JUMP_M and lengths.max() <= MAX_JUMP_M
    assert np.mean(lengths) == pytest.approx(0.5 * (MIN_JUMP_M + MAX_JUMP_M), abs=0.4)
    turns = np.array([wrap_angle(place.heading - BESIDE.heading) for place in places])
    assert turns.min() < -2.9 and turns.max() > 2.9 and abs(np.mean(turns)) < 0.35


def test_jump_leaves_out_what_is_taken():
    """All places except a gap to the left are occupied."""
    bodies = [Body(Pose2(0.0, 20.0, 0.0), 30.0, 19.0), Body(Pose2(-20.0, 0.0, 0.0), 19.0, 30.0),
              Body(Pose2(20.0, 0.0, 0.0), 19.0, 30.0)]
    chance = np.random.default_rng(1)
    for _ in range(20):
        place = random_jump(bodies, Pose2(0.0, 0.0, 0.0), chance).applied(Pose2(0.0, 0.0, 0.0))
        assert place.y > 0.0 and abs(place.x) <= 1.0 - PLACE_CLEARANCE_M


def test_site_without_room_is_said():
    with pytest.raises(ValueError, match="No place within 8 m"):
        random_jump([Body(Pose2(0.0, 0.0, 0.0), 50.0, 50.0)], BESIDE, np.random.default_rng(1))


def test_jump_is_in_the_frame_of_the_car():
    place = Jump(2.0, math.pi / 2.0, 0.3).applied(Pose2(1.0, 1.0, 2.0))
    assert (place.x, place.y, place.heading) == pytest.approx((1.0, 3.0, 2.3))


@pytest.mark.parametrize("scene", SCENES)
def test_wandering_robot_touches_nothing_and_gets_about(scene):
    for seed in range(3):
        bodies = site_bodies(options(scene, 2).scenario())
        poses, commands = wandered(bodies, random_jump(bodies, BESIDE, stream(seed, "jump")).applied(BESIDE), seed)
        assert min(clearance_m(bodies, pose.x, pose.y) for pose in poses) > ROBOT_RADIUS_M
        assert commands[:, 0].sum() * TICK_S > 4.0
        assert commands[:, 0].max() <= MAX_SPEED_MPS and np.abs(commands[:, 1]).max() <= MAX_TURN_RADPS


def test_robot_before_a_wall_turns_on_the_spot_until_its_way_is_free():
    wall = [Body(Pose2(-1.0, 0.0, 0.0), 0.1, 5.0)]
    poses, commands = wandered(wall, Pose2(0.0, 0.0, 0.0), 3, 3.0)
    free = next(row for row, pose in enumerate(poses) if abs(pose.heading) > 0.95)
    assert (commands[:free - 1, 0] == 0.0).all()
    assert np.abs(commands[:, 1]).max() == pytest.approx(MAX_TURN_RADPS) and commands[free:, 0].max() > 0.0


def test_robot_that_is_far_away_comes_back():
    for seed in range(4):
        poses, _ = wandered([Body(Pose2(0.0, 0.0, 0.0), 2.0, 1.0)], Pose2(14.0, 0.0, 0.0), seed)
        assert math.hypot(poses[-1].x, poses[-1].y) < 12.0
    turned = [wrap_angle(math.atan2(-pose.y, -pose.x) - pose.heading) for pose in poses]
    assert min(map(abs, turned)) < FACING_RAD


def test_speeds_and_turns_are_random_and_the_seed_decides_them():
    _, commands = wandered([Body(Pose2(0.0, 50.0, 0.0), 2.0, 1.0)], BESIDE, 1)
    _, again = wandered([Body(Pose2(0.0, 50.0, 0.0), 2.0, 1.0)], BESIDE, 1)
    _, other = wandered([Body(Pose2(0.0, 50.0, 0.0), 2.0, 1.0)], BESIDE, 2)
    assert (commands == again).all() and (commands != other).any()
    moving = commands[100:]
    assert moving[:, 0].min() >= MIN_SPEED_MPS and np.ptp(moving[:, 0]) > 0.2
    assert moving[:, 1].min() < -0.2 and moving[:, 1].max() > 0.2


def test_abducted_robot_wanders_is_carried_away_and_wanders_on():
    drive = abductions(1)[0].options
    found = list(pieces(drive.shape, drive.scenario().start_in_car, plan(drive)))[-3:]
    assert [(leg_name(piece.leg), piece.kind) for piece in found] == [
        ("wander", WANDER), ("carry", ABDUCT), ("wander", ABDUCT)]
    assert MIN_WANDER_S <= found[0].leg.duration_s <= MAX_WANDER_S
    assert found[2].leg.duration_s == WANDER_AFTER_S == 25.0
    assert leg_name(CarryLeg()) == "carry" and not isinstance(found[1].leg, LiftLeg)
    assert isinstance(found[0].leg, WanderLeg)


def test_scenes_and_seeds_have_cases_of_their_own():
    waits = {plan(each.options).abducted_after_s for each in abductions(5)}
    assert len(waits) == 5 * len(SCENES)


def test_abductions_differ_from_plain_drives_in_nothing_else_and_have_names_of_their_own():
    found = abductions(50, first_seed=7)
    assert {(each.options.scene, each.options.seed) for each in found} == {
        (scene, seed) for scene in SCENES for seed in range(7, 57)}
    assert all(each.options == replace(options(each.options.scene, each.options.seed), abduct=True) for each in found)
    names = [each.name for each in [*found, *all_drives()]]
    assert len(set(names)) == len(names)


def test_repeated_drive_has_a_seed_that_no_other_has():
    found = abductions(200)
    again = [repeated(each) for each in found]
    assert not {each.name for each in found} & {each.name for each in again}
    assert all(replace(each.options, seed=first.options.seed) == first.options for first, each in zip(found, again))


def test_robot_is_carried_away_in_one_way():
    with pytest.raises(ConfigurationError, match="kidnap and abduct are both true"):
        DriveOptions(kidnap=True, abduct=True)
