"""The test area before the robot moves, its corners, and what a test's record says of it."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.cli.arguments import argument_parser
from mtr_operator.domain.actions.car import Car
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.preparation import prepare
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.errors import InvalidParameter, RobotFailed
from mtr_operator.domain.geometry.area import (
    MAX_CORNERS,
    area_m2,
    check_corners,
    corners_from_text,
    corners_text,
    rectangle_around,
)
from mtr_operator.domain.geometry.pose import Pose
from mtr_operator.domain.requests import AreaOrder
from mtr_operator.domain.results.session_record import TEST_AREA, area_record
from mtr_operator.domain.robot_status import AreaState, Problem
from mtr_operator.domain.supervision.area import TOO_OLD, await_area, set_area
from mtr_operator.robot_link.virtual.area import VirtualArea
from mtr_operator.station.checks.area_check import test_area as area_item
from mtr_operator.station.checks.finding import Finding, State
from mtr_operator.station.links.idle_loop import IdleLoop
from mtr_operator.station.links.stop_order import StopOrder
from mtr_operator.station.links.watched_link import WatchedRobotLink
from mtr_operator.station.sight.area_sketch import AreaSketch

SQUARE = ((3.0, 3.0), (-3.0, 3.0), (-3.0, -3.0), (3.0, -3.0))
ORIGIN = 77
NO_AREA = Problem("dispatcher.no_area", (), "No test area is set.")
FREE = AreaState(origin_id=ORIGIN)
NEEDED = AreaState(required=True, origin_id=ORIGIN, problems=(NO_AREA,))


@pytest.fixture
def session(robot_link, car_link):
    return ControlLoop(robot_link, car_link)


class Keeper:
    """Has the world's robot report an area, and confirm what is ordered."""

    def __init__(self, world, robot_link, state, *, confirms=True):
        self.link, self.state, self.confirms = robot_link, state, confirms
        world.spoil = self

    def __call__(self, status):
        ordered = self.link.answers[-1][1].area if self.link.answers else None
        if ordered is not None and self.confirms:
            self.state = replace(self.state, area_id=ordered.id, area_origin_id=ordered.origin_id,
                                 corners=ordered.corners, problems=())
        return replace(status, area=self.state)


@pytest.mark.parametrize("corners", [SQUARE, SQUARE[::-1], ((0, 0), (4, 0), (4, 4), (2, 1), (0, 4))])
def test_simple_polygons_are_accepted(corners):
    check_corners(corners)


@pytest.mark.parametrize("corners", [
    (), SQUARE[:2], SQUARE * 20, (*SQUARE[:3], (math.nan, 0.0)), (*SQUARE[:3], (math.inf, 0.0)),
    (*SQUARE[:3], (0.0, 101.0)), (*SQUARE, SQUARE[0]), ((-3, -3), (3, 3), (3, -3), (-3, 3)),
    ((0, 0), (5, 0), (2, 0), (2, 5)), ((0, 0), (1, 0), (1, 1)), ((-3, -3), (3, -3), (3, 3), (0, -3), (-3, 3))])
def test_what_a_robot_refuses_is_refused_before(corners):
    with pytest.raises(InvalidParameter, match=r"\.$"):
        check_corners(corners)


def test_corners_survive_their_text_and_other_text_is_refused():
    assert corners_from_text(corners_text(SQUARE)) == SQUARE
    assert corners_from_text("3,3; -3,3;-3 -3 ; 3 -3;") == SQUARE
    for text in ("", "1 2; 3", "a b; c d; e f", "0 0; 1 1; 2 nan", "1 2 3; 4 5 6; 7 8 9"):
        with pytest.raises(InvalidParameter):
            corners_from_text(text)


def test_rectangle_is_around_the_robot_along_its_heading():
    corners = rectangle_around(Pose(1.0, 2.0, 0.5), 16.0, 14.0)
    check_corners(corners)
    assert area_m2(corners) == pytest.approx(224.0)
    assert sum(x for x, _ in corners) / 4 == pytest.approx(1.0)


def test_area_is_in_the_cars_frame_only_while_it_is_in_force_and_the_car_is_known():
    state = AreaState(area_origin_id=ORIGIN, corners=SQUARE, origin_id=ORIGIN, car=Pose(1.0, 0.0, math.pi / 2))
    assert state.corners_at_car()[0] == pytest.approx((3.0, -2.0))
    assert replace(state, car=None).corners_at_car() == replace(state, origin_id=ORIGIN + 1).corners_at_car() == ()


def test_area_of_the_command_line_is_confirmed_before_the_robot_moves(session, world, robot_link):
    Keeper(world, robot_link, NEEDED)
    set_area(session, SQUARE)
    prepare(session, Robot(session), Car(session), 1.0, 1.0)
    orders = [desired for _, desired in robot_link.answers]
    first = next(index for index, desired in enumerate(orders) if desired.area)
    assert orders[first].area == AreaOrder(1, ORIGIN, SQUARE)
    assert not any(desired.waypoint or desired.key_height_m for desired in orders[:first + 1])
    assert all(desired.area for desired in orders[first:])


@pytest.mark.parametrize("state, text", [
    (NEEDED, r"^No test begins\. No test area is set\.$"),
    (replace(FREE, problems=(Problem("dispatcher.area_of_other_origin", (), "Draw it again."),)), "Draw it again")])
def test_no_test_begins_on_a_robot_that_lacks_its_area(session, world, robot_link, state, text):
    Keeper(world, robot_link, state)
    with pytest.raises(RobotFailed, match=text):
        prepare(session, Robot(session), Car(session), 1.0, 1.0)
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


def test_area_that_the_robot_does_not_confirm_ends_the_test(session, world, robot_link):
    Keeper(world, robot_link, FREE, confirms=False)
    set_area(session, SQUARE)
    with pytest.raises(RobotFailed, match="did not accept the test area"):
        await_area(session)


@pytest.mark.parametrize("state, text", [(None, "too old"), (replace(FREE, is_fixed=True), "launch file"),
                                         (AreaState(), "does not know its position")])
def test_area_that_a_robot_cannot_keep_is_refused_with_a_sentence(session, world, robot_link, state, text):
    Keeper(world, robot_link, state)
    with pytest.raises(RobotFailed, match=text):
        set_area(session, SQUARE)
    assert TOO_OLD.endswith(".")


def test_robots_without_an_area_and_of_before_begin_as_always(session, world, robot_link):
    for state in (FREE, None):
        Keeper(world, robot_link, state)
        await_area(session)


def test_record_names_the_area_and_where_it_comes_from():
    state = AreaState(corners=SQUARE, area_origin_id=ORIGIN, origin_id=ORIGIN)
    [(name, text)] = area_record(state).items()
    assert name == TEST_AREA and text.startswith(corners_text(SQUARE)) and "drawn" in text
    assert "launch file" in area_record(replace(state, is_fixed=True))[TEST_AREA]
    assert area_record(None) == area_record(FREE) == {}


def test_command_line_accepts_corners_and_a_file_of_them(tmp_path):
    path = tmp_path / "area.txt"
    path.write_text("3 3\n-3 3\n-3 -3\n3 -3\n", encoding="utf-8")
    common = ["run", "autolock", "--params", "p", "--out", "o", "--test-area"]
    for given in (corners_text(SQUARE), str(path)):
        assert argument_parser().parse_args([*common, given]).test_area == SQUARE
    for wrong in ("0 0; 1 1", str(tmp_path), "nowhere.txt"):
        with pytest.raises(SystemExit):
            argument_parser().parse_args([*common, wrong])


@pytest.mark.parametrize("state, verdict, finding", [
    (None, State.UNKNOWN, Finding.AREA_UNTOLD), (FREE, State.GOOD, Finding.AREA_NOT_NEEDED),
    (NEEDED, State.BAD, Finding.AREA_MISSING),
    (AreaState(required=True, origin_id=ORIGIN), State.BAD, Finding.AREA_MISSING),
    (AreaState(True, False, 1, ORIGIN + 1, SQUARE, ORIGIN), State.BAD, Finding.AREA_MISSING),
    (AreaState(True, False, 1, ORIGIN, SQUARE, ORIGIN), State.GOOD, Finding.AREA_KEPT),
    (AreaState(True, True, 0, ORIGIN, SQUARE, ORIGIN), State.GOOD, Finding.AREA_FIXED)])
def test_checklist_has_a_missing_area_as_bad(state, verdict, finding):
    item = area_item(state)
    assert (item.state, item.finding) == (verdict, finding)


def test_idle_window_sets_an_area_without_lifting_a_stop(robot_link, car_link):
    stop = StopOrder()
    watched = WatchedRobotLink(robot_link, stop)
    watched.connect()
    idle = IdleLoop(watched, car_link)
    idle.step()
    stop.give()
    idle.set_area(SQUARE, ORIGIN)
    idle.step()
    sent = robot_link.answers[-1][1]
    assert sent.area == AreaOrder(1, ORIGIN, SQUARE) and sent.stop
    idle.set_area((), ORIGIN)
    idle.step()
    assert robot_link.answers[-1][1].area == AreaOrder(2, ORIGIN, ()) and not idle.has_order


def test_virtual_robot_confirms_an_area_to_its_session():
    area = VirtualArea(ORIGIN, Pose(4.0, 1.0, 3.0))
    start = area.state(0, Pose(4.0, 1.0, 3.0), is_mapped=False)
    assert (start.robot.x, start.robot.y, start.car) == (pytest.approx(0.0), pytest.approx(0.0), None)
    area.take(5, AreaOrder(1, ORIGIN, SQUARE))
    area.take(5, AreaOrder(1, ORIGIN, ()))
    state = area.state(5, Pose(4.0, 1.0, 3.0), is_mapped=True)
    assert (state.area_id, state.corners, state.is_in_force) == (1, SQUARE, True)
    assert state.car.apply((4.0, 1.0)) == pytest.approx((0.0, 0.0))
    assert area.state(6, Pose(4.0, 1.0, 3.0), is_mapped=True).area_id == 0


def test_sketch_takes_each_step_back():
    sketch = AreaSketch()
    for corner in SQUARE:
        assert sketch.add(corner)
    assert sketch.problem == ""
    sketch.pick(0)
    sketch.move((4.004, 4.0))
    sketch.move((5.0, 4.0))
    sketch.drop()
    assert sketch.corners[0] == (5.0, 4.0)
    sketch.undo()
    assert sketch.corners == SQUARE
    sketch.remove(1)
    sketch.replace(())
    sketch.undo()
    sketch.undo()
    assert sketch.corners == SQUARE
    # A corner that is picked and not moved is no step.
    sketch.pick(2)
    sketch.drop()
    sketch.undo()
    assert len(sketch.corners) == 3


def test_sketch_has_no_corner_that_a_robot_refuses_for_its_place_or_number():
    sketch = AreaSketch()
    sketch.add((1e9, -1e9))
    assert sketch.corners == ((100.0, -100.0),)
    while sketch.add((1.0, 1.0)):
        pass
    assert len(sketch.corners) == MAX_CORNERS
    assert sketch.nearest((50.0, 50.0), 0.5) is None and sketch.nearest((1.2, 1.0), 0.5) == 1
    for _ in range(MAX_CORNERS + 5):
        sketch.undo()
    assert sketch.corners == () and not sketch.can_undo and sketch.nearest((0.0, 0.0), 9.0) is None
