"""How an outcome of the matrix of states and faults is judged."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import replace
from types import SimpleNamespace

import pytest

from mtr_benchmarks.faults.judge import (
    CarSeen,
    Outcome,
    Seen,
    invalid_because,
    modes_during,
    standstill_s,
    told_since,
    wrong,
)
from mtr_benchmarks.faults.matrix import (
    ANY_REASON,
    GOES_ON,
    HELD,
    LOST,
    PACED,
    UNHEARD,
    Cell,
    Expected,
    Matrix,
    table,
)
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import Interventions, Mode, Notification, Problem

UNTOUCHED = Interventions()
MUST = Expected(stands_s=0.7, told="drive_control.imu_frozen", told_s=1.0, mode="fault", then=HELD, record="lock")
CELL = Cell("driving", "imu", "stuck", 1.0, 0.0, False, MUST)
SEEN = Outcome(0.5, 0.6, {"drive_control.imu_frozen": 0.9}, ["following_waypoint", "fault"], HELD, "A motion lock.")


def status(stamp_s, *codes, interventions=UNTOUCHED, pose_valid=True, mode=Mode.FOLLOWING_WAYPOINT):
    notes = tuple(Notification("n", 3, "x", (Problem(code, (), "x"),)) for code in codes)
    return Seen(stamp_s, SimpleNamespace(stamp_s=stamp_s, notifications=notes, pose_valid=pose_valid, car=None,
                                         car_frame=None, interventions=interventions, mode=mode))


@pytest.mark.parametrize("speeds, stood_s", [
    ([(0.9, 0.5), (1.0, 0.5), (1.4, 0.1), (1.5, 0.0), (2.0, 0.0)], 0.4), ([(1.0, 0.0), (2.0, 0.01)], 0.0),
    ([(1.0, 0.5), (1.5, 0.0), (2.0, 0.3)], None), ([], None)])
def test_standstill_lasts_until_the_end_of_the_fault(speeds, stood_s):
    assert standstill_s(speeds, 1.0, 2.0) == pytest.approx(stood_s)


def test_only_what_is_new_is_told_by_its_first_status():
    said = [status(0.9, "old"), status(1.1, "old"), status(1.2, "old", "new"), status(1.3, "new")]
    assert told_since(said, 1.0) == {"new": pytest.approx(0.2)}


def test_line_is_invalid_for_what_the_application_finds_after_the_fault_began():
    blocked = Interventions(blockages=1)
    assert invalid_because([status(0.9), status(1.1), status(1.2)], 1.0) == ""
    assert "obstacle" in invalid_because([status(0.9), status(1.1, interventions=blocked)], 1.0)
    assert "position" in invalid_because([status(0.9), status(1.1, pose_valid=False)], 1.0)
    assert "interrupted" in invalid_because([status(0.9), status(2.5)], 1.0)


def test_line_is_invalid_for_what_the_application_finds_on_the_cars_bus():
    silent = status(1.1)._replace(car=CarSeen("The bus is silent.", LockState.UNKNOWN))
    assert invalid_because([status(0.9), silent], 1.0) == "The bus is silent."


def test_states_are_those_from_the_fault_until_shortly_after_it():
    seen = [status(0.9), status(1.5, mode=Mode.FAULT), status(2.4), status(2.6, mode=Mode.READY_TO_MAP_CAR)]
    assert modes_during(seen, 1.0, 2.0) == ["fault", "following_waypoint"]


def test_second_without_a_status_is_a_state_of_its_own():
    assert modes_during([status(0.9), status(3.2)], 1.0, 3.0) == ["following_waypoint", UNHEARD]
    assert modes_during([status(0.9), status(1.9), status(2.8)], 1.0, 3.0) == ["following_waypoint"]


def test_cell_that_does_what_it_must_is_right():
    assert wrong(CELL, SEEN) == []


@pytest.mark.parametrize("change, words", [
    ({"stood_s": None}, "stands after None"), ({"stood_s": 0.8}, "stands after 0.8 s"), ({"told_s": {}}, "told after"),
    ({"told_s": {"drive_control.imu_frozen": 1.1}}, "told after 1.1 s"),
    ({"modes": ["ready_to_map_car"]}, "must be fault"),
    ({"then": GOES_ON}, "afterwards goes on"), ({"record": ""}, "line is invalid because ''")])
def test_each_deviation_is_a_sentence(change, words):
    found = wrong(CELL, replace(SEEN, **change))
    assert len(found) == 1 and words in found[0]


def test_both_times_count_from_the_limit_up_to_which_the_fault_is_none():
    later = replace(CELL, expected=replace(MUST, limit_s=0.3))
    seen = replace(SEEN, stood_s=1.0, told_s={"drive_control.imu_frozen": 1.3})
    assert wrong(later, seen) == [] and len(wrong(CELL, seen)) == 2
    assert len(wrong(later, replace(seen, stood_s=1.1))) == 1
    assert "0.3 + 0.7 s" in table(Matrix({}, (later,)))[2]


def test_where_any_reason_will_do_there_must_be_one():
    cell = replace(CELL, expected=replace(MUST, record=ANY_REASON))
    assert wrong(cell, SEEN) == [] and len(wrong(cell, replace(SEEN, record=""))) == 1
    assert table(Matrix({}, (cell,)))[2].endswith("| invalid |")


@pytest.mark.parametrize("lift_stood_s, is_right", [(0.8, True), (0.81, False), (None, False)])
def test_lift_has_a_time_of_its_own(lift_stood_s, is_right):
    cell = replace(CELL, expected=replace(MUST, lift_s=0.5, limit_s=0.3))
    found = wrong(cell, replace(SEEN, lift_stood_s=lift_stood_s))
    assert found == [] if is_right else "lift stands after" in found[0]
    assert "| 0.3 + 0.5 s |" in table(Matrix({}, (cell,)))[2]


def test_robot_that_may_drive_on_must_not_stand_and_a_line_is_judged_only_where_there_is_one():
    drives = replace(CELL, expected=replace(MUST, stands_s=None, record=None))
    assert wrong(drives, replace(SEEN, stood_s=None)) == []
    assert "must drive on" in wrong(drives, replace(SEEN, stood_s=0.0))[0]


def test_cells_from_which_the_robot_does_not_come_back_are_last_and_the_table_has_all():
    lost = replace(CELL, part="odometry", expected=replace(MUST, then=LOST))
    matrix = Matrix({"driving": "drives"}, (lost, CELL, replace(CELL, state="ready", is_short=True)))
    assert matrix.of("driving") == [CELL, lost] and matrix.of("driving", only_short=True) == []
    assert len(table(matrix)) == 2 + 3 and "imu stuck, 1 s" in table(matrix)[3]


def test_cells_of_a_kind_of_robot_are_run_together_in_the_order_of_the_states():
    ready, paced = replace(CELL, state="ready"), replace(CELL, robot=PACED)
    matrix = Matrix({"ready": "stands", "driving": "drives"}, (CELL, paced, ready))
    assert matrix.courses() == [[ready, CELL], [paced]]
    assert matrix.courses(only="ready") == [[ready]] and matrix.courses(only_short=True) == []


def test_faults_of_two_amounts_have_two_names():
    names = {replace(CELL, amount=amount).name for amount in (0.0, 0.5)}
    assert names == {"imu stuck while driving", "imu stuck by 0.5 s while driving"}
