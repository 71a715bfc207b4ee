"""The test area: hostile orders are refused with a sentence; the area in force survives sessions and restarts."""
# SPDX-License-Identifier: Apache-2.0
import math

import genpy
import pytest

from mtr_core.errors import ConfigurationError
from mtr_core.requests import DesiredState
from mtr_dispatcher.area.keeper import Area, AreaKeeper
from mtr_dispatcher.area.order import LARGEST_M2, MAX_CORNERS, AreaOrder, corners_from, order_problem
from mtr_dispatcher.area.polygons import area_m2, is_simple
from mtr_dispatcher.conversions import area_message, desired_message
from mtr_dispatcher.core import Dispatcher
from mtr_dispatcher.parameters import Parameters
from mtr_dispatcher.session import CommandResult
from mtr_dispatcher.status.builder import Identity
from mtr_dispatcher.status.inputs import Inputs
from mtr_msgs.msg import CarEstimate, LocalizedPose
from mtr_proto import robot_link_pb2 as link

NOW_S, SESSION = 100.0, 5
SQUARE = ((3.0, 3.0), (-3.0, 3.0), (-3.0, -3.0), (3.0, -3.0))
ORIGIN = 2 ** 60 + 1


def order(*corners, **changes):
    return AreaOrder(**{"id": 1, "origin_id": ORIGIN, "x": tuple(x for x, _ in corners),
                        "y": tuple(y for _, y in corners), **changes})


def circle(count, radius=5.0):
    return [(radius * math.cos(2.0 * math.pi * i / count), radius * math.sin(2.0 * math.pi * i / count))
            for i in range(count)]


def pose(origin_id=ORIGIN, valid=True, **fields):
    message = LocalizedPose(valid=valid, origin_id=origin_id, **fields)
    message.header.stamp = genpy.Time.from_sec(NOW_S)
    return message


def inputs(**known):
    return Inputs(NOW_S, steady_s=NOW_S, **known)


@pytest.fixture
def core():
    return started(Parameters())


def started(parameters, areas=None):
    dispatcher = Dispatcher(parameters, Identity(7, "1.2.3", 0.25, 0.0), areas)
    dispatcher.status(inputs())
    return dispatcher


def send(core, number, area=None, session_id=SESSION, **content):
    command = link.Command(session_id=session_id, id=number, seen_status_id=1, seen_robot_time_s=NOW_S, **content)
    if area is not None:
        command.test_area.CopyFrom(link.TestArea(id=area.id, origin_id=area.origin_id, x=area.x, y=area.y))
    return core.receive(command.SerializeToString(), NOW_S)[0]


def status(core, **messages):
    return link.Status.FromString(core.status(inputs(**messages)))


@pytest.mark.parametrize("corners", [SQUARE, SQUARE[::-1], circle(3), circle(MAX_CORNERS),
                                     ((0, 0), (4, 0), (4, 4), (2, 1), (0, 4))])
def test_simple_polygon_is_accepted_in_either_direction(corners):
    assert not order_problem(order(*corners))
    assert not order_problem(None)


def test_order_without_corners_withdraws_the_area():
    assert not order_problem(order())


@pytest.mark.parametrize("bad, code", [
    (order(*SQUARE, id=0), "area_without_id"),
    (order(*SQUARE, y=(0.0, 1.0)), "area_not_pairs"),
    (order(*SQUARE, x=()), "area_not_pairs"),
    (order((0.0, 0.0), (1.0, 1.0)), "area_corners"),
    (order((0.0, 0.0)), "area_corners"),
    (order(*circle(MAX_CORNERS + 1)), "area_corners"),
    (order(*SQUARE[:3], (math.nan, 0.0)), "area_coordinate"),
    (order(*SQUARE[:3], (0.0, math.inf)), "area_coordinate"),
    (order(*SQUARE[:3], (0.0, -math.inf)), "area_coordinate"),
    (order(*SQUARE[:3], (100.1, 0.0)), "area_coordinate"),
    (order(*SQUARE[:3], (1e308, 0.0)), "area_coordinate"),
    (order(*SQUARE, SQUARE[-1]), "area_edge"),
    (order(*SQUARE, SQUARE[0]), "area_edge"),
    (order((-3, -3), (3, 3), (3, -3), (-3, 3)), "area_crossed"),
    (order((-3, -3), (3, -3), (3, 3), (0, -3), (-3, 3)), "area_crossed"),
    (order((0, 0), (5, 0), (2, 0), (2, 5)), "area_crossed"),
    (order((0, 0), (5, 0), (5, 0.1)), "area_size"),
    (order(*circle(60, 99.0)), "area_size"),
])
def test_area_that_bounds_none_is_refused_with_a_sentence(core, bad, code):
    problem = order_problem(bad)
    assert problem.code == f"dispatcher.{code}" and problem.text.endswith(".")
    assert send(core, 1, bad) is CommandResult.REFUSED
    assert core.areas.area is None
    [refused] = [notice for notice in status(core).notifications if notice.code == "command_refused"]
    assert problem.text in refused.text


def test_polygons_of_limits():
    assert area_m2(SQUARE) == pytest.approx(36.0) and area_m2(circle(60, 99.0)) > LARGEST_M2
    assert is_simple(SQUARE) and not is_simple(SQUARE[:2]) and not is_simple(())


def test_area_is_echoed_to_its_session_with_its_id_and_to_others_without(core):
    assert send(core, 1, order(*SQUARE, id=9)) is CommandResult.TAKEN
    state = status(core, pose=pose(x=1.0, y=2.0, heading=0.5)).test_area
    assert (state.area.id, state.area.origin_id, state.origin_id) == (9, ORIGIN, ORIGIN)
    assert list(zip(state.area.x, state.area.y)) == list(SQUARE)
    assert (state.x, state.y, state.heading) == (1.0, 2.0, 0.5) and not state.problems
    send(core, 2, end_session=True)
    later = status(core, pose=pose()).test_area
    assert later.area.id == 0 and list(later.area.x) == [x for x, _ in SQUARE]
    send(core, 1, session_id=6)
    assert status(core, pose=pose()).test_area.area.id == 0 and core.areas.corners == SQUARE


def test_area_that_is_repeated_changes_nothing_and_a_new_id_replaces_it(core):
    send(core, 1, order(*SQUARE))
    send(core, 2, order(*circle(5)))
    assert core.areas.corners == SQUARE
    send(core, 3, order(*circle(5), id=2))
    assert len(core.areas.corners) == 5
    send(core, 4)
    assert len(core.areas.corners) == 5
    send(core, 5, order(id=3))
    assert core.areas.corners == ()
    assert core.area_problem(pose()).code == "dispatcher.no_area"


def test_watching_and_foreign_applications_set_no_area(core):
    send(core, 1, order(*SQUARE), watches=True)
    assert core.areas.area is None
    send(core, 1)
    assert send(core, 1, order(*SQUARE), session_id=6) is CommandResult.FOREIGN
    assert core.areas.area is None


def test_real_robot_says_what_it_needs_and_a_simulated_one_needs_nothing(core):
    assert core.area_problem(None).code == core.area_problem(pose()).code == "dispatcher.no_area"
    real = status(core)
    assert real.test_area.required and not real.simulated
    assert [problem.code for problem in real.test_area.problems] == ["dispatcher.no_area"]
    simulated = started(Parameters(simulated=True))
    assert not simulated.area_problem(pose())
    told = status(simulated)
    assert told.simulated and not told.test_area.required and not told.test_area.HasField("area")


@pytest.mark.parametrize("simulated", [False, True])
def test_area_of_another_origin_holds_for_nothing_until_it_is_drawn_again(simulated):
    core = started(Parameters(simulated=simulated))
    send(core, 1, order(*SQUARE))
    assert not core.area_problem(pose())
    assert not core.area_problem(None)
    assert core.area_problem(pose(ORIGIN + 1)).code == "dispatcher.area_of_other_origin"
    send(core, 2, order(*SQUARE, id=2, origin_id=ORIGIN + 1))
    assert not core.area_problem(pose(ORIGIN + 1))


def test_other_nodes_get_polygon_and_problem(core):
    desired = desired_message(core.desired(NOW_S), genpy.Time(1), 0.5, core.area_problem(None))
    assert [problem.code for problem in desired.area_problems] == ["dispatcher.no_area"]
    empty = area_message(core.areas, genpy.Time(1))
    assert empty.required and not empty.x and empty.header.frame_id == "map"
    send(core, 1, order(*SQUARE))
    message = area_message(core.areas, genpy.Time(1))
    assert list(zip(message.x, message.y)) == list(SQUARE) and message.origin_id == ORIGIN
    assert not desired_message(core.desired(NOW_S), genpy.Time(1), 0.5, core.area_problem(pose())).area_problems


def test_area_outlives_the_process():
    kept = {}
    before = AreaKeeper(True, remember=kept.update)
    before.take(SESSION, order(*SQUARE, id=4))
    after = AreaKeeper(True, remembered=kept)
    assert after.area == before.area == Area(SESSION, 4, ORIGIN, SQUARE)
    after.take(SESSION, order(*circle(5), id=4))
    assert after.corners == SQUARE


@pytest.mark.parametrize("rubbish", [None, {}, {"x": [1.0]}, {"session_id": "a", "id": "1", "origin_id": "1", "x": [],
                                                              "y": []},
                                     {"session_id": "1", "id": "1", "origin_id": "1", "x": [0, 1, 2], "y": [0, 0, 0]},
                                     {"session_id": "1", "id": "1", "origin_id": "1", "x": [math.nan] * 3,
                                      "y": [0.0] * 3}])
def test_corrupt_memory_is_no_area(rubbish):
    assert not AreaKeeper(True, remembered=rubbish).corners


def test_area_of_the_launch_file_refers_to_the_first_origin_and_cannot_be_changed():
    core = started(Parameters(test_area_xy=(3, 3, -3, 3, -3, -3, 3, -3)))
    assert not core.area_problem(None)
    assert not core.area_problem(pose())
    send(core, 1, order(*circle(5)))
    state = status(core, pose=pose()).test_area
    assert state.fixed and state.area.id == 0 and len(state.area.x) == 4 and state.area.origin_id == ORIGIN
    assert core.area_problem(pose(ORIGIN + 1)).code == "dispatcher.fixed_area_of_other_origin"


def test_area_of_the_launch_file_keeps_its_origin_over_a_restart_of_the_dispatcher():
    kept = {}
    before = AreaKeeper(True, SQUARE, remember=kept.update)
    before.observe(pose())
    after = AreaKeeper(True, SQUARE, remembered=kept)
    after.observe(pose(ORIGIN + 1))
    assert after.problem(pose(ORIGIN + 1)).code == "dispatcher.fixed_area_of_other_origin"
    # Another area in the launch file replaces the stored one.
    other = AreaKeeper(True, circle(5), remembered=kept)
    other.observe(pose(ORIGIN + 1))
    assert not other.problem(pose(ORIGIN + 1))


@pytest.mark.parametrize("numbers", [(1.0,), (0, 0, 1, 0), (0, 0, 9, 9, 9, 0, 0, 9), (0, 0, 9, 0, 9, math.nan)])
def test_launch_file_without_an_area_names_the_parameter(numbers):
    with pytest.raises(ConfigurationError, match="test_area_xy"):
        corners_from(numbers)
    with pytest.raises(ConfigurationError, match="test_area_xy"):
        Parameters(test_area_xy=numbers)


def test_place_of_robot_and_car_is_told_in_the_start_frame_only_when_it_is_known(core):
    located = CarEstimate(state=CarEstimate.LOCATED, x=4.0, y=1.0, heading=0.2, outline_x=[1.0], outline_y=[1.0])
    located.header.stamp = genpy.Time.from_sec(NOW_S)
    state = status(core, pose=pose(x=1.0), car=located).test_area
    assert (state.car_x, state.car_y, state.car_heading) == (4.0, 1.0, 0.2)
    for unknown in (pose(valid=False), pose(x=math.nan)):
        state = status(core, pose=unknown, car=CarEstimate()).test_area
        assert not state.HasField("x") and not state.HasField("car_x") and state.origin_id == ORIGIN


def test_desired_state_has_no_area_problem_by_default():
    assert not DesiredState().area_problem
