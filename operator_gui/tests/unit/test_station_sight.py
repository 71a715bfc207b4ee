"""What the robot sees around the Car, and which way is not free."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_operator.domain.ports import LockState
from mtr_operator.domain.results.picture import Stretch
from mtr_operator.domain.robot_status import CarDimensions, CarFrame, RobotStatus
from mtr_operator.domain.surroundings import StopZone, Surroundings
from mtr_operator.robot_link.conversions import decode_status, status_message_from
from mtr_operator.robot_link.surroundings import surroundings_from
from mtr_operator.station.events import RobotSnapshot
from mtr_operator.station.mailbox import Mailbox
from mtr_operator.station.sight.obstacle_map import CELL_M, ObstacleMap
from mtr_operator.station.sight.view import view_of
from mtr_operator.station.sight.ways import Ways, spans, ways_of
from mtr_operator.station.view_model import ViewModel
from mtr_proto import robot_link_pb2 as pb

CAR = CarDimensions(4.0, 2.0, 0.01, 0.01)
WALL = tuple((3.0, -2.0 + 0.05 * index) for index in range(81))


def status(stamp_s=1.0, points=WALL, session=1, **changes):
    """A robot 3 m before the Car's front that looks away from it, at a wall 3 m ahead."""
    told = {"x": 5.0, "y": 0.0, "heading": 0.0, "pose_valid": True, "car": CAR, "car_frame": CarFrame(1),
            "surroundings": Surroundings(points), **changes}
    return RobotStatus(1, session, stamp_s, sent_s=stamp_s, **told)


def looked(count, obstacles=None, points=WALL, start_s=0.0, **changes):
    obstacles = obstacles or ObstacleMap()
    for index in range(count):
        told = status(start_s + 0.5 * index, points, **changes)
        obstacles.learn(told, view_of(told))
    return obstacles


def test_surroundings_survive_the_link_to_the_centimetre():
    sent = Surroundings(((1.234, -2.0), (0.0, 3.5)), ((5.0, 6.0),), StopZone.SLOWED, (0.5, -0.25))
    message = status_message_from(status(surroundings=sent))
    seen = decode_status(message.SerializeToString()).surroundings
    assert seen == Surroundings(((1.23, -2.0), (0.0, 3.5)), ((5.0, 6.0),), StopZone.SLOWED, (0.5, -0.25))
    assert decode_status(status_message_from(status(surroundings=None)).SerializeToString()).surroundings is None


@pytest.mark.parametrize(("fields", "obstacle"), [
    ({"obstacle_m": math.nan, "obstacle_bearing_rad": 0.0}, None), ({"obstacle_m": -1.0}, None),
    ({"obstacle_m": 1.0, "obstacle_bearing_rad": math.inf}, None), ({"obstacle_m": 1.0}, (1.0, 0.0))])
def test_obstacle_that_cannot_be_is_none(fields, obstacle):
    assert surroundings_from(pb.Surroundings(**fields)).obstacle == obstacle


def test_a_flood_of_points_is_cut_and_an_odd_one_left_out():
    assert len(surroundings_from(pb.Surroundings(points_cm=[1] * 100_001)).points) == 4096
    assert surroundings_from(pb.Surroundings(path_cm=[100, 200, 300])).path == ((1.0, 2.0),)


def test_returns_and_obstacle_are_seen_in_the_frame_of_the_car():
    view = view_of(status(x=1.0, y=2.0, heading=math.pi / 2.0, surroundings=Surroundings(
        ((2.0, 0.0), (0.0, 5.0)), zone=StopZone.BLOCKED, obstacle=(1.7, 0.02))))
    assert view.points == pytest.approx(np.array([[1.0, 4.0], [-4.0, 2.0]]))
    place, distance_m = view.obstacle
    assert (distance_m, view.viewer) == (1.7, (1.0, 2.0))
    assert place == pytest.approx((1.0, 4.0), abs=0.05)


@pytest.mark.parametrize("changes", [{"pose_valid": False}, {"surroundings": None}])
def test_nothing_is_seen_from_nowhere(changes):
    assert view_of(status(**changes)) is None


def test_obstacle_without_a_return_on_its_bearing_is_put_at_its_distance():
    view = view_of(status(surroundings=Surroundings((), obstacle=(0.5, 0.0))))
    assert view.obstacle[0] == pytest.approx((5.5, 0.0))


def test_wall_is_in_the_map_after_three_looks_where_it_stands():
    assert len(looked(2).places) == 0
    places = looked(3).places
    assert len(places) > 10
    assert np.abs(places[:, 0] - 8.0).max() <= CELL_M
    assert np.abs(places[:, 1]).max() <= 2.0 + CELL_M


def test_what_has_gone_is_forgotten_once_it_was_looked_through():
    obstacles = looked(6)
    version = obstacles.version
    behind = tuple((2.0 * x, 2.0 * y) for x, y in WALL)
    looked(20, obstacles, behind, start_s=10.0)
    assert obstacles.version > version
    assert np.abs(obstacles.places[:, 0] - 11.0).max() <= CELL_M


def test_looks_that_follow_at_once_count_as_one():
    obstacles = ObstacleMap()
    for index in range(20):
        told = status(0.01 * index)
        obstacles.learn(told, view_of(told))
    assert obstacles.version == 0


@pytest.mark.parametrize("changes", [{"session": 2}, {"car_frame": CarFrame(2)}])
def test_another_frame_begins_anew(changes):
    obstacles = looked(6)
    looked(1, obstacles, (), start_s=10.0, **changes)
    assert len(obstacles.places) == 0


def test_line_that_ends_in_the_wall_is_named_with_its_distance():
    obstacles = looked(4)
    lines = [Stretch((2.5, 0.0), (6.0, 0.0), "1"), Stretch((2.5, 1.0), (9.0, 1.0), "2"),
             Stretch((-2.5, 0.0), (-9.0, 0.0), "3"), Stretch((2.5, 0.0), (7.7, 0.0), "4")]
    found = ways_of(lines, CAR, obstacles)
    assert found.hindered == ("2", "4")
    assert found.gap_m == pytest.approx(6.0, abs=CELL_M)
    assert ways_of(lines[:1], CAR, obstacles).hindered == ways_of(lines, CAR, ObstacleMap()).hindered == ()
    assert math.isnan(ways_of(lines[:1], CAR, obstacles).gap_m)


def test_line_that_leads_where_nobody_has_looked_is_named():
    obstacles = looked(1)
    # Between the robot and the wall; behind the wall; behind the robot; beyond the map.
    lines = [Stretch((5.2, 0.0), (7.0, 0.5), "1"), Stretch((5.2, 0.0), (12.0, 0.0), "2"),
             Stretch((-2.5, 0.0), (-9.0, 0.0), "3"), Stretch((0.0, 30.0), (0.0, 50.0), "4")]
    assert ways_of(lines, CAR, obstacles) == Ways((), pytest.approx(math.nan, nan_ok=True), ("2", "3", "4"))
    # Of a wall that is known the way behind it is not told besides.
    assert ways_of(lines, CAR, looked(4)).unseen == ("3", "4")
    assert ways_of(lines, CAR, ObstacleMap()).unseen == ("1", "2", "3", "4")


def test_what_was_seen_is_forgotten_with_the_frame_of_the_car():
    obstacles = looked(6)
    mark = obstacles.mark
    looked(1, obstacles, (), start_s=10.0, session=2)
    assert not obstacles.seen.any() and obstacles.mark != mark


def test_the_car_itself_stands_in_nobodys_way():
    obstacles = ObstacleMap()
    obstacles.places = np.array([[2.1, 0.0], [2.3, 0.5]])
    assert ways_of([Stretch((2.5, 0.0), (6.0, 0.0), "1")], CAR, obstacles).hindered == ()


@pytest.mark.parametrize(("labels", "text"), [
    ((), ""), (("7",), "7"), (("1", "2"), "1, 2"),
    (("1", "2", "3", "7", "9", "10", "11", "12"), "1\u20133, 7, 9\u201312")])
def test_numbers_that_follow_each_other_are_said_by_their_ends(labels, text):
    assert spans(labels) == text


def test_sight_of_a_status_that_was_passed_over_is_kept():
    mailbox, model = Mailbox(), ViewModel()
    for told in (status(1.0), status(1.1, surroundings=None)):
        mailbox.put_robot(RobotSnapshot(told, LockState.LOCKED, ""))
    batch = mailbox.take()
    assert (batch.robot.status.stamp_s, batch.sight.stamp_s) == (1.1, 1.0)
    model.apply(batch)
    assert len(model.view.points) == len(WALL)
    assert mailbox.take().sight is None
