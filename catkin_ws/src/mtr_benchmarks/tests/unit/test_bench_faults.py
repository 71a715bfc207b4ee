"""Evaluation of outcomes in the matrix of states and faults."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import importlib.util
import pathlib
from dataclasses import replace
from types import SimpleNamespace

import pytest

from mtr_benchmarks.faults import campaign
from mtr_benchmarks.faults.__main__ import report
from mtr_benchmarks.faults.course import Course
from mtr_benchmarks.faults.judge import (
    CarSeen,
    Outcome,
    Seen,
    has_stood,
    invalid_because,
    modes_during,
    standstill_s,
    told_since,
    wrong,
)
from mtr_benchmarks.faults.matrix import (
    ANY_REASON,
    FILES,
    GOES_ON,
    HELD,
    LOST,
    PACED,
    UNHEARD,
    Cell,
    Expected,
    Matrix,
    read_matrix,
    table,
)
from mtr_benchmarks.faults.proofs import LANES, Proof, Ran, run, together
from mtr_benchmarks.faults.record import Run, right_of
from mtr_benchmarks.faults.robot import PutBackError
from mtr_operator.domain.ports import LockState
from mtr_operator.domain.robot_status import Interventions, Mode, Notification, Problem
from mtr_simulation.stack import StackError

TOP = pathlib.Path(__file__).resolve().parents[5]
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


@pytest.mark.parametrize("speeds, stood", [
    ([(0.0, 0.5), (1.0, 0.0), (2.0, 0.01)], True), ([(0.0, 0.5), (1.0, 0.3), (2.0, 0.0)], False),
    ([(1.0, 0.0), (2.0, 0.0)], False), ([], False)])
def test_who_waits_has_stood_for_a_while(speeds, stood):
    assert has_stood(speeds, 1.5) is stood


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


def test_states_are_those_of_the_fault_in_their_order():
    seen = [status(0.9), status(1.2), status(1.5, mode=Mode.FAULT), status(1.6, mode=Mode.FAULT), status(1.9),
            status(2.1, mode=Mode.READY_TO_MAP_CAR)]
    assert modes_during(seen, 1.0, 2.0) == ["following_waypoint", "fault", "following_waypoint"]


def test_second_without_a_status_is_a_state_of_its_own():
    assert modes_during([status(0.9), status(1.1), status(3.2)], 1.0, 3.0) == ["following_waypoint", UNHEARD]
    assert modes_during([status(0.9), status(2.9)], 1.0, 3.0) == [UNHEARD, "following_waypoint"]
    assert modes_during([status(0.9), status(2.96)], 1.0, 3.0) == [UNHEARD], "said as the fault ended"
    heard = [status(0.9), status(1.9), status(2.8), status(2.96, mode=Mode.FAULT)]
    assert modes_during(heard, 1.0, 3.0) == ["following_waypoint", "fault"], "a link that was never cut"
    assert modes_during([status(0.9), status(1.9), status(2.8)], 1.0, 3.0) == ["following_waypoint"]


def test_cell_that_does_what_it_must_is_right():
    assert wrong(CELL, SEEN) == []


def test_of_several_states_and_ends_one_will_do_and_no_other():
    cell = replace(CELL, expected=replace(MUST, mode="fault or unheard", then="resumes or held",
                                          told="drive_control.imu_silent or drive_control.imu_frozen"))
    assert wrong(cell, SEEN) == []
    assert wrong(cell, replace(SEEN, modes=["following_waypoint", "unheard"], then=GOES_ON)) == []
    assert len(wrong(cell, replace(SEEN, modes=["mapping_car"], then=LOST, told_s={"dispatcher.expired": 0.1}))) == 3


def test_state_has_its_own_mode_beside_others(tmp_path):
    for name in FILES:
        (tmp_path / f"{name}.yaml").write_text("faults: []", encoding="utf-8")
    (tmp_path / "link.yaml").write_text("""
robot: paced
faults:
- {faults: [link_commands slow, link_commands off], for_s: 1, expect: {stands_s: null, told: "", told_s: 1.0,
   mode: own or unknown, then: held}, in: {mapping: {}, lifting: {then: resumes}}}""", encoding="utf-8")
    cells = read_matrix(tmp_path).cells
    assert [(cell.state, cell.amount, cell.robot) for cell in cells] == [
        ("mapping", 0.5, PACED), ("lifting", 0.5, PACED), ("mapping", 0.0, PACED), ("lifting", 0.0, PACED)]
    assert [cell.expected.mode for cell in cells[:2]] == ["mapping_car or unknown", "following_waypoint or unknown"]
    assert [cell.expected.then for cell in cells[:2]] == [HELD, GOES_ON]


@pytest.mark.parametrize("change, words", [
    ({"stood_s": None}, "stands after None"), ({"stood_s": 0.8}, "stands after 0.8 s"), ({"told_s": {}}, "told after"),
    ({"told_s": {"drive_control.imu_frozen": 1.1}}, "told after 1.1 s"),
    ({"modes": ["ready_to_map_car"]}, "must be fault"),
    ({"then": GOES_ON}, "afterwards resumes"), ({"record": ""}, "line is invalid because ''")])
def test_each_deviation_is_a_sentence(change, words):
    found = wrong(CELL, replace(SEEN, **change))
    assert len(found) == 1 and words in found[0]


def test_both_times_count_from_the_limit_up_to_which_the_fault_is_none():
    later = replace(CELL, expected=replace(MUST, limit_s=0.3))
    seen = replace(SEEN, stood_s=1.0, told_s={"drive_control.imu_frozen": 1.3})
    assert wrong(later, seen) == [] and len(wrong(CELL, seen)) == 2
    assert len(wrong(later, replace(seen, stood_s=1.1))) == 1
    assert "0.3 + 0.7 s" in table(Matrix((later,)))[2]


def test_where_any_reason_will_do_there_must_be_one():
    cell = replace(CELL, expected=replace(MUST, record="had a fault or lock"))
    assert wrong(cell, SEEN) == [] and len(wrong(cell, replace(SEEN, record="was interrupted"))) == 1
    cell = replace(CELL, expected=replace(MUST, record=ANY_REASON))
    assert wrong(cell, SEEN) == [] and len(wrong(cell, replace(SEEN, record=""))) == 1
    assert table(Matrix((cell,)))[2].endswith("| invalid |")


@pytest.mark.parametrize("lift_stood_s, is_right", [(0.8, True), (0.81, False), (None, False)])
def test_lift_has_a_time_of_its_own(lift_stood_s, is_right):
    cell = replace(CELL, expected=replace(MUST, lift_s=0.5, limit_s=0.3))
    found = wrong(cell, replace(SEEN, lift_stood_s=lift_stood_s))
    assert found == [] if is_right else "lift stands after" in found[0]
    assert "| 0.3 + 0.5 s |" in table(Matrix((cell,)))[2]


def test_robot_that_may_drive_on_must_not_stand_and_a_line_is_judged_only_where_there_is_one():
    drives = replace(CELL, expected=replace(MUST, stands_s=None, record=None))
    assert wrong(drives, replace(SEEN, stood_s=None, end_mps=0.3)) == []
    # The robot stops for an instant while it turns.
    assert wrong(drives, replace(SEEN, stood_s=0.7, end_mps=0.0)) == []


@pytest.mark.parametrize("stood_s, end_mps", [(0.34, 0.0), (0.5, 0.01), (None, None)])
def test_robot_that_brakes_at_once_or_is_not_seen_does_not_drive_on(stood_s, end_mps):
    drives = replace(CELL, expected=replace(MUST, stands_s=None))
    assert "must drive on" in wrong(drives, replace(SEEN, stood_s=stood_s, end_mps=end_mps))[0]


def test_matrix_of_no_cells_and_times_of_no_robot_are_not_what_they_must_be():
    assert [row.is_met for row in report([]).rows] == [False]
    drove = campaign.Found(CELL, SEEN, [])
    assert [row.is_met for row in report([drove]).rows] == [True, False, True] and SEEN.stood_s > 0.5
    assert not all(row.is_met for row in report([drove._replace(outcome=None)]).rows[1:])
    # A robot that was stopped before has no time to standstill.
    assert len(report([campaign.Found(replace(CELL, state="ready"), SEEN, [])]).rows) == 2


def test_cells_from_which_the_robot_does_not_come_back_are_last_and_the_table_has_all():
    lost = replace(CELL, part="odometry", expected=replace(MUST, then=LOST))
    matrix = Matrix((lost, CELL, replace(CELL, state="ready", is_short=True)))
    assert matrix.of("driving") == [CELL, lost] and matrix.of("driving", only_short=True) == []
    assert len(table(matrix)) == 2 + 3 and "imu stuck, 1 s" in table(matrix)[3]


def test_cells_of_a_kind_of_robot_are_run_together_in_the_order_of_the_states():
    ready, paced = replace(CELL, state="ready"), replace(CELL, robot=PACED)
    matrix = Matrix((CELL, paced, ready))
    assert matrix.courses() == [[ready, CELL], [paced]]
    assert matrix.courses(only="ready") == [[ready]] and matrix.courses(only_short=True) == []


def test_faults_of_two_amounts_have_two_names():
    names = {replace(CELL, amount=amount).name for amount in (0.0, 0.5)}
    assert names == {"imu stuck while driving", "imu stuck by 0.5 s while driving"}


def test_tables_of_all_proofs_become_one_and_one_without_a_table_is_not_met():
    good = {"table": [{"name": "crashes", "unit": "(count)", "value": 0, "is_met": True}], "cases": 5}
    bad = {"table": [{"name": "slope", "unit": "MiB", "value": 2.0, "met": False}]}
    proofs = [Proof(name, f"{name}.json", ()) for name in ("fuzz", "soak", "kills")]
    found = together([Ran(proofs[0], 0, 60.0, good), Ran(proofs[1], 1, 5.0, bad), Ran(proofs[2], -9, 1.0, None)])
    assert {row["name"]: row["met"] for row in found["table"]} == {
        "fuzz: crashes": True, "fuzz: came to its end": True, "soak: slope": False, "soak: came to its end": True,
        "kills: came to its end": False}
    assert found["proofs"]["fuzz"]["cases"] == 5 and found["proofs"]["soak"]["took_s"] == 5.0


def test_proof_that_leaves_nothing_is_no_table_of_the_run_before(tmp_path):
    (tmp_path / "x.json").write_text('{"table": []}', encoding="utf-8")
    assert run(Proof("x", "x.json", ("-c", "raise SystemExit(3)")), tmp_path, 1).document is None


def test_programs_of_the_proofs_are_there():
    for proof in (proof for lane in LANES for proof in lane):
        first, *others = proof.command
        assert (TOP / first).is_file() if first != "-m" else importlib.util.find_spec(f"{others[0]}.__main__")


def test_cell_that_was_right_on_this_commit_when_it_was_run_last_is_not_left(tmp_path):
    of_run = Run(tmp_path / "bench", 1, "abc")
    assert right_of(of_run.folder, "abc") == set()
    for cell, said in (("first", ["stands"]), ("second", []), ("first", []), ("second", ["stands"])):
        of_run.keep(cell, said)
    Run(of_run.folder, 1, "def").keep("first", ["stands"])
    assert (right_of(of_run.folder, "abc"), right_of(of_run.folder, "def")) == ({"first"}, set())


def test_cell_before_which_a_robot_asks_to_be_put_back_is_begun_on_another_robot_and_only_once(monkeypatch, tmp_path):
    asked = []

    class Asking:
        def __init__(self, _):
            pass

        def run(self, cell):
            asked.append(cell.state)
            if cell.state == "driving":
                raise PutBackError("Put it back.")
            return SEEN

    monkeypatch.setattr(campaign, "FaultyRobot", lambda *_: contextlib.nullcontext())
    monkeypatch.setattr(campaign, "Course", Asking)
    cells = [replace(CELL, state="mapping"), CELL, replace(CELL, state="waiting")]
    first = campaign.one_robot(cells, tmp_path, Run(tmp_path, 1, "abc"))
    second = campaign.one_robot(cells[len(first):], tmp_path, Run(tmp_path, 1, "abc"))
    assert [found.cell.state for found in (*first, *second)] == ["mapping", "driving"]
    assert asked == ["mapping", "driving", "driving"] and second[0].wrong == ["Put it back."]


def test_robot_that_does_not_start_costs_one_cell(monkeypatch, tmp_path):
    def broken(*_):
        raise StackError("It ended while starting.")

    monkeypatch.setattr(campaign, "FaultyRobot", broken)
    found, = campaign.one_robot([CELL, replace(CELL, state="waiting")], tmp_path, Run(tmp_path, 1, "abc"))
    assert (found.cell, found.wrong) == (CELL, ["It ended while starting."])
    assert CELL.name not in right_of(tmp_path, "abc")


@pytest.mark.parametrize(("ended_s", "stood_s"), [(2.62, 0.3), (float("inf"), None)])
def test_robot_has_to_stand_until_its_fault_is_over(ended_s, stood_s):
    speeds = [(0.9, 0.5), (1.0, 0.5), (1.3, 0.2), (1.32, 0.0), (2.62, 0.0), (2.66, 0.1)]
    robot = SimpleNamespace(
        status=SimpleNamespace(hold_id=0, mode=1), release_hold=None, speed_mps=0.5, now_s=99.0, seen=[], lifts=[],
        speeds=speeds, ended_s=ended_s, begin=lambda *_: 1.0, wait_until=lambda *_: None)
    assert Course(robot).run(replace(CELL, state="ready", for_s=1.7)).stood_s == (
        stood_s if stood_s is None else pytest.approx(stood_s))
