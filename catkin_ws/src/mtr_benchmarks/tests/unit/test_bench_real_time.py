"""Silences and rows of the robot in real time, without a robot."""
# SPDX-License-Identifier: Apache-2.0
import json

import pytest
import yaml

from mtr_benchmarks.gazebo.noted import Notes
from mtr_benchmarks.gazebo.run import Run
from mtr_benchmarks.real_time.arrivals import ASKING, VOICES, by_node, silence, silences
from mtr_benchmarks.real_time.judge import Machine, judged, silence_row
from mtr_benchmarks.real_time.measurement import Stop, Stretch, echoes_s
from mtr_benchmarks.real_time.other_work import other_work
from mtr_benchmarks.real_time.whole_tests import DISTANCES, PARAMETERS, figures_of_tests, rows_of_tests, whole_tests
from mtr_simulation.truth.distance import Comparison
from mtr_simulation.truth.results import MeasuredEvent

BEGIN_S, END_S = 100.0, 110.0


def spoken(period_s, pause_s=0.0):
    """Return periodic arrivals with a pause that is longer by pause_s in the middle."""
    count = round((END_S - BEGIN_S) / period_s) + 1
    return [BEGIN_S + index * period_s for index in range(count)
            if not BEGIN_S + 5.0 < BEGIN_S + index * period_s < BEGIN_S + 5.0 + pause_s + 0.5 * period_s]


def test_a_node_that_speaks_at_its_rate_is_not_late():
    found = silence(spoken(0.1), BEGIN_S, END_S, 0.1)
    assert found.late == pytest.approx(0.0, abs=1e-6) and found.median_s == pytest.approx(0.1)


def test_the_longest_pause_counts_and_the_usual_one_is_told():
    found = silence(spoken(0.1, 0.3), BEGIN_S, END_S, 0.1)
    assert found.longest_s == pytest.approx(0.4) and found.late == pytest.approx(3.0)
    assert found.median_s == pytest.approx(0.1) and found.p99_s < found.longest_s


@pytest.mark.parametrize("times_s", [[], [BEGIN_S + 1.0], [BEGIN_S - 1.0, END_S + 1.0]])
def test_silence_at_begin_or_end_or_all_the_time_counts(times_s):
    assert silence(times_s, BEGIN_S, END_S, 0.1).longest_s >= 9.0


def arrivals(**pauses_s):
    return {node: spoken(voice.slot.period_ns * 1e-9, pauses_s.get(node, 0.0))
            for node, voice in {**VOICES, **ASKING}.items()}


def test_nobody_is_blamed_for_the_silence_of_what_it_answers():
    found = silences(arrivals(localization=0.3, simulator=0.3), BEGIN_S, END_S)
    assert found["localization"].late == pytest.approx(0.0, abs=1e-6) and found["simulator"].late > 10.0
    assert silence_row(Machine.IDLE, "localization", found["localization"]).is_met
    assert not silence_row(Machine.IDLE, "localization", silence(spoken(0.02, 0.3), BEGIN_S, END_S, 0.02)).is_met


def test_a_topic_of_several_speakers_is_sorted_by_them():
    topic = VOICES["controller_input"].topic
    assert by_node({topic: {"/controller_input": [1.0], "/dispatcher": [2.0]}})["controller_input"] == [1.0]


def stretch(alarms=(), brakes_s=0.01, cpu=0.02, starts_s=(0.2, 0.4)):
    return Stretch(BEGIN_S, END_S, tuple(alarms), [Stop(brakes_s, 0.5, 0.6)], list(starts_s),
                   dict.fromkeys(VOICES, cpu), [0.001])


TF = [(BEGIN_S + 1.0, 0.004), (BEGIN_S + 2.0, 0.006), (END_S + 1.0, 9.0)]


def test_a_good_robot_meets_every_row():
    rows, figures = judged({machine: stretch() for machine in Machine}, arrivals(), TF)
    assert len(rows) == 2 * (len(VOICES) + 6) and all(row.is_met for row in rows)
    assert len({row.requirement.name for row in rows}) == len(rows)
    assert figures["scan_to_tf_s"]["idle"]["max"] == pytest.approx(0.006)
    assert set(figures["silences"]["busy"]) == {*VOICES, *ASKING}


def table_of(rows):
    """Return the rows in their file format, by name."""
    return {row["name"]: row for row in (each.as_json() for each in rows)}


def test_the_table_has_a_distribution_of_each_node_and_of_each_latency():
    table = table_of(judged({machine: stretch() for machine in Machine}, arrivals(car_locator=0.2), TF)[0])
    for machine in Machine:
        for node, voice in VOICES.items():
            row = table[f"silence of {node}, longest, {machine.value}"]
            assert row["p50_s"] == pytest.approx(voice.slot.period_ns * 1e-9, abs=1e-6)
            assert row["p50_s"] <= row["p99_s"] <= row["max_s"] == row["value"] and row["must"] is not None
    latencies = [row for name, row in table.items() if "max_s" in row and "silence" not in name]
    assert len(latencies) == 2 * 4 and all(row["p50_s"] <= row["p99_s"] <= row["max_s"] for row in latencies)


def test_a_robot_that_never_sets_off_is_told_and_its_file_can_be_written():
    rows, _ = judged({Machine.IDLE: stretch(starts_s=[float("inf")])}, arrivals(), TF)
    (row,) = (row for row in rows if "waypoint" in row.requirement.name)
    assert json.loads(json.dumps(row.as_json(), allow_nan=False))["value"] is None


def test_processor_time_is_judged_and_told_by_node_on_both_machines():
    rows, _ = judged({machine: stretch(cpu=0.05) for machine in Machine}, arrivals(), TF)
    missed = [row.as_json() for row in rows if not row.is_met]
    assert len(missed) == 2 and all(row["drive_control"] == 0.05 for row in missed)


@pytest.mark.parametrize("machine, measured, spoke, missed", [
    (Machine.IDLE, stretch(), arrivals(car_locator=0.2), "silence of car_locator"),
    (Machine.BUSY, stretch(), arrivals(car_locator=0.6), "silence of car_locator"),
    (Machine.IDLE, stretch(alarms=["state machine: FAULT"]), arrivals(), "alarms"),
    (Machine.IDLE, stretch(brakes_s=0.2), arrivals(), "stop"),
    (Machine.IDLE, stretch(brakes_s=float("inf")), arrivals(), "stop"),
    (Machine.IDLE, stretch(cpu=0.05), arrivals(), "processor time")])
def test_what_is_not_as_it_must_be_is_one_row(machine, measured, spoke, missed):
    rows, _ = judged({machine: measured}, spoke, TF)
    assert [row.requirement.name for row in rows if not row.is_met] == [
        row.requirement.name for row in rows if missed in row.requirement.name]


def test_echoes_and_other_work_leave_nothing(tmp_path):
    with other_work(tmp_path, computing=1):
        assert all(0.0 < echo_s < 10.0 for echo_s in echoes_s(3))
    assert not list(tmp_path.iterdir())


def line(status="ok", error_m=0.01):
    return Comparison(MeasuredEvent("1", "unlock", status, 10.0, 1.5 + error_m, 0.01, "front", (1.0, 0.0)), 1.5)


GOOD = tuple(line() for _ in range(DISTANCES))


def a_run(status=0, lines=GOOD, touched=()):
    return Run(Notes(), {"autolock": status}, {"autolock": list(lines)}, tuple(touched))


def made_of(made, folder):
    """Return complete tests on an idle machine, with given results instead of the robot."""
    made = list(made)
    seeds = range(1, len(made) + 1)
    return whole_tests(folder, [Machine.IDLE], seeds, run_one=lambda simulator, options: made[options.seed - 1])


def test_tests_that_end_whole_meet_their_rows(tmp_path):
    made = made_of([a_run(), a_run()], tmp_path)
    assert [(each.seed, each.is_whole) for each in made] == [(1, True), (2, True)]
    rows = rows_of_tests(made)
    assert len(rows) == 3 and all(row.is_met for row in rows)
    assert "of 2" in rows[0].remark and figures_of_tests(made)[1]["seed"] == 2


@pytest.mark.parametrize("wrong, missed", [
    (a_run(status=1), "did not end whole"), (a_run(lines=GOOD[1:]), "did not end whole"),
    (a_run(lines=[line("aborted"), *GOOD[1:]]), "did not end whole"),
    (a_run(lines=[]), "did not end whole"),
    (a_run(lines=[line(error_m=0.06), *GOOD[1:]]), "largest error"),
    (a_run(touched=["car"]), "touched")])
def test_what_goes_wrong_in_one_test_is_told_with_its_seed(wrong, missed, tmp_path):
    rows = rows_of_tests(made_of([a_run(), wrong], tmp_path))
    (row,) = (row for row in rows if not row.is_met)
    assert missed in row.requirement.name
    assert missed != "did not end whole" or "seeds 2" in row.remark


def test_each_test_gets_a_folder_and_the_parameters_of_eight_axes(tmp_path):
    given = []

    def noted(simulator, options):
        given.append((simulator, options.folder.name, options.seed, options.demo("autolock").parameters))
        return a_run()

    with_work_folder = tmp_path / "tests"
    made = whole_tests(with_work_folder, [Machine.IDLE], (1, 2), run_one=noted)
    assert all(each.load > 0.0 for each in made) and figures_of_tests(made)[0]["load"] == made[0].load
    assert given == [("mujoco", f"idle_{seed}", seed, with_work_folder / "autolock.yaml") for seed in (1, 2)]
    assert yaml.safe_load((with_work_folder / "autolock.yaml").read_text(encoding="utf-8")) == PARAMETERS


def test_whole_tests_are_run_in_the_other_simulator_when_that_is_asked_for(tmp_path):
    given = []

    def noted(simulator, options):
        given.append((simulator, options.folder.name))
        return a_run()

    whole_tests(tmp_path, [Machine.BUSY], (3,), "gazebo", run_one=noted)
    assert given == [("gazebo", "busy_3")]
