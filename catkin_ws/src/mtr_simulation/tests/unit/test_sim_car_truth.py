"""Truth of the simulated Car: the log, true distances, and the comparison's files, figures and exit status."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math

import pytest

from mtr_core.errors import ConfigurationError
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.truth.compare import main, percentile
from mtr_simulation.truth.distance import CarSize, find_true, true_distance_m
from mtr_simulation.truth.expected import expected
from mtr_simulation.truth.log import TruthLog
from mtr_simulation.truth.results import MeasuredEvent, ResultsError, TrueEvent

SIZE = CarSize(4.5, 1.8)
AUTOLOCK_HEADER = (
    "axis,side,origin_x_m,origin_y_m,direction_x,direction_y,"
    "unlock_status,unlock_distance_m,unlock_uncertainty_m,unlock_robot_time_s,"
    "lock_status,lock_distance_m,lock_uncertainty_m,lock_robot_time_s"
)
HEADER = ["scenario", "line", "event", "true_distance_m", "p50_distance_m", "p95_distance_m", "truth_static_m",
          "true_border_share", "true_coverage"]
# Number of cells of a line that are empty without a model of the Car.
UNKNOWN = 5 * [""]
KEY_PRESS_HEADER = "radial,angle_deg,status,distance_m,failed_distance_m,uncertainty_m,attempts,robot_time_s"


def measured(event="unlock", time_s=10.0, side="left", direction=(0.0, 1.0)):
    """A measured event."""
    return MeasuredEvent("1", event, "ok", time_s, 1.0, 0.1, side, direction)


def at(x, y, kind="unlocked", time_s=10.0, accepted=False):
    """A true event."""
    return TrueEvent(kind, time_s, x, y, accepted)


@pytest.fixture
def folder(tmp_path):
    """A folder for results with a truth log of one unlock, one lock and two presses."""
    log = TruthLog(tmp_path)
    log.lock_event("unlocked", 10_000_000_000, (0.5, 2.4, 1.0))
    log.lock_event("locked", 20_000_000_000, (0.5, 3.4, 1.0))
    log.press(30_000_000_000, (6.0, 0.0, 1.0), False)
    log.press(40_000_000_000, (3.0, 4.0, 1.0), True)
    log.close()
    return tmp_path


def run(folder, results, *more):
    """Exit status of the comparison for these results."""
    (folder / "results.csv").write_text(results, encoding="utf-8")
    arguments = ["--events", folder / "truth_events.csv", "--results", folder, "--car-length", 4.5, "--car-width", 1.8]
    return main([str(argument) for argument in (*arguments, *more)])


def truth(folder):
    """Rows of truth.csv."""
    with open(folder / "truth.csv", newline="", encoding="utf-8") as file:
        return list(csv.reader(file))


def test_log_is_complete_on_disk_after_each_event(tmp_path):
    log = TruthLog(tmp_path / "new" / "folder")
    log.press(1_220_000_000, (1.0, -2.0, 0.95), True)
    log.handle(2_000_000_000, (0.0, 3.0, 1.0), False)
    assert log.path.read_text(encoding="utf-8").splitlines() == [
        "event,robot_time_s,key_x_m,key_y_m,key_z_m,accepted",
        "press,1.220000000,1.000000,-2.000000,0.950000,1",
        "handle,2.000000000,0.000000,3.000000,1.000000,0",
    ]


def test_log_in_an_impossible_folder_is_refused_with_path_and_reason(tmp_path):
    (tmp_path / "file").write_text("", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="truth_events.csv"):
        TruthLog(tmp_path / "file")


@pytest.mark.parametrize(
    ("side", "direction", "key", "expected"),
    [
        ("left", (0.0, 1.0), (0.7, 2.4), 1.5),
        ("right", (0.0, -1.0), (0.7, -2.4), 1.5),
        ("front", (1.0, 0.0), (3.25, 0.4), 1.0),
        ("rear", (-1.0, 0.0), (-3.25, 0.4), 1.0),
        ("front_left", (1.0, 1.0), (3.25, 1.9), math.sqrt(2.0)),
        ("front_right", (0.6, -0.8), (2.25 + 0.6, -0.9 - 0.8), 1.0),
        ("rear_left", (-0.6, 0.8), (-2.25 - 1.2, 0.9 + 1.6), 2.0),
        ("rear_right", (-0.6, -0.8), (-2.25 - 1.2, -0.9 - 1.6), 2.0),
    ],
)
def test_true_distance_is_along_the_axis_from_the_true_side_or_corner(side, direction, key, expected):
    assert true_distance_m(measured(side=side, direction=direction), at(*key), SIZE) == pytest.approx(expected)


def test_true_distance_of_a_press_is_from_the_centre():
    assert true_distance_m(measured("press", side=""), at(-3.0, 4.0), SIZE) == pytest.approx(5.0)


@pytest.mark.parametrize(("side", "direction"), [("top", (1.0, 0.0)), ("", (1.0, 0.0)), ("front_left", (0.0, 0.0))])
def test_axis_without_a_known_side_or_direction_is_refused(side, direction):
    with pytest.raises(ResultsError, match="Axis 1"):
        true_distance_m(measured(side=side, direction=direction), at(1.0, 1.0), SIZE)


def test_nearest_event_of_the_kind_within_half_a_second_is_the_true_one():
    events = [at(1, 1, time_s=9.6), at(2, 2, time_s=10.2), at(3, 3, "locked", 10.0)]
    assert find_true(measured(), events).key_x_m == 2
    assert find_true(measured(time_s=10.8), events) is None
    assert find_true(measured(time_s=math.nan), events) is None


def test_press_that_the_car_did_not_accept_is_no_true_event():
    events = [at(1, 1, "press", 10.0, accepted=False), at(2, 2, "press", 10.4, accepted=True)]
    assert find_true(measured("press"), events).key_x_m == 2


def test_autolock_results_give_truth_csv_table_and_errors(folder, capsys):
    line = "0,left,0.5,0.88,0,1,ok,1.52,0.01,10.1,ok,2.45,0.05,19.9"
    assert run(folder, f"# units: m\n{AUTOLOCK_HEADER}\n{line}\n", "--scenario", "autolock") == 0
    assert truth(folder) == [
        HEADER,
        ["autolock", "0", "unlock", "1.5000", *UNKNOWN],
        ["autolock", "0", "lock", "2.5000", *UNKNOWN],
    ]
    output = capsys.readouterr().out
    assert "2 of 2 distances" in output
    assert "median 0.035 m, 95th percentile 0.048 m, largest 0.050 m" in output
    assert "rms 1.58, largest 2.00" in output


def test_key_press_results_are_recognised_by_their_header(folder, capsys):
    lines = "0,0,not_reached,,,,5,\n1,45,ok,5.1,5.6,0.1,3,40.08"
    assert run(folder, f"{KEY_PRESS_HEADER}\n{lines}\n") == 0
    assert truth(folder)[1:] == [["key_press", "1", "press", "5.0000", *UNKNOWN]]
    assert "1 of 2 distances" in capsys.readouterr().out


def test_named_car_gives_its_distances_also_of_a_line_that_was_not_reached(folder):
    lines = "0,0,not_reached,,,,5,\n1,45,ok,5.1,5.6,0.1,3,40.08"
    assert run(folder, f"# parameter key_height_m: 1.2 m\n{KEY_PRESS_HEADER}\n{lines}\n", "--car", "honest") == 0
    first, second = ([float(cell or "nan") for cell in row[3:]] for row in truth(folder)[1:])
    model = chosen_car("honest").reactions(1)
    computed = [expected(MeasuredEvent("0", "press", "", 0, 0, 0, "", (0, 0), clockwise_rad=math.radians(angle)), SIZE,
                         model, 1.2) for angle in (0.0, 45.0)]
    assert math.isnan(first[0])
    assert second[0] == 5.0
    assert [first[1], second[1]] == pytest.approx([each.p50_distance_m for each in computed], abs=1e-4)
    assert math.isnan(first[3])


def test_named_car_gives_the_static_boundary_of_both_events_of_an_axis(folder):
    line = "0,left,0.5,0.88,0,1,ok,1.52,0.01,10.1,ok,2.45,0.05,19.9"
    assert run(folder, f"{AUTOLOCK_HEADER}\n{line}\n", "--car", "gentle", "--seed", "3") == 0
    unlock, lock = (float(row[6]) for row in truth(folder)[1:])
    assert 0.75 < unlock < lock - 0.5 < 2.4


def test_unknown_car_is_refused_with_a_sentence(folder, capsys):
    assert run(folder, f"{KEY_PRESS_HEADER}\n", "--car", "unreal") == 2
    assert "car is 'unreal'" in capsys.readouterr().err


def test_line_that_is_ok_without_a_true_event_fails_and_is_named(folder, capsys):
    assert run(folder, f"{KEY_PRESS_HEADER}\n3,45,ok,5.1,,0.1,3,30.0\n") == 1
    assert "Line 3: no true event for its press at 30.000 s." in capsys.readouterr().err
    assert truth(folder) == [HEADER]


@pytest.mark.parametrize(("limits", "status"), [
    ((), 0), (("--max-error", 0.049), 1), (("--max-error", 0.051), 0), (("--max-sigmas", 1.9), 1),
    (("--max-sigmas", 2.1), 0), (("--max-error", 0.051, "--max-sigmas", 1.9), 1)])
def test_distance_that_is_farther_off_than_allowed_fails_and_is_named(folder, capsys, limits, status):
    line = "0,left,0.5,0.88,0,1,ok,1.52,0.01,10.1,ok,2.45,0.05,19.9"
    assert run(folder, f"{AUTOLOCK_HEADER}\n{line}\n", *limits) == status
    said = capsys.readouterr().err
    assert ("m off with a sigma of" in said) is bool(status)
    if limits[:1] == ("--max-error",) and status and len(limits) == 2:
        assert said == "Line 0: its lock is -0.050 m off with a sigma of 0.050 m.\n"


@pytest.mark.parametrize(("line", "said"), [
    ("1,45,ok,6.1,,0.1,3,40.08", "Line 1: its press is +1.100 m off with a sigma of 0.100 m."),
    ("1,45,ok,5.0,,nan,3,40.08", "Line 1: its press is +0.000 m off with a sigma of nan m."),
    ("1,45,not_reached,,,,3,", "No distance is ok, so that none agrees with the truth.")])
def test_results_that_only_happened_at_the_right_time_do_not_agree_with_the_truth(folder, capsys, line, said):
    results = f"{KEY_PRESS_HEADER}\n{line}\n"
    assert run(folder, results) == 0
    assert run(folder, results, "--max-error", 0.15, "--max-sigmas", 4) == 1
    assert said in capsys.readouterr().err


@pytest.mark.parametrize(
    ("results", "word"),
    [
        ("", "known scenario"),
        ("a,b\n1,2\n", "known scenario"),
        ("radial,status\n", "has no column distance_m"),
        (f"{KEY_PRESS_HEADER}\n1,45,ok\n", "data line 1"),
        (f"{KEY_PRESS_HEADER}\n1,45,ok,far,,0.1,3,30\n", "'far'"),
        (f"{AUTOLOCK_HEADER}\n0,roof,0,0,0,1,ok,1,0.1,10,ok,2,0.1,20\n", "'roof'"),
    ],
)
def test_unusable_results_give_one_sentence_and_no_truth_csv(folder, capsys, results, word):
    assert run(folder, results) == 2
    assert word in capsys.readouterr().err
    assert not (folder / "truth.csv").exists()


def test_missing_events_and_impossible_size_are_refused(folder, capsys):
    results = f"{KEY_PRESS_HEADER}\n"
    assert run(folder, results, "--car-length", "90") == 2
    assert run(folder, results, "--events", folder / "none.csv") == 2
    errors = capsys.readouterr().err
    assert "car-length is 90 m; allowed is 0.5 to 20 m" in errors
    assert "none.csv cannot be read" in errors


def test_percentile_interpolates():
    assert percentile([0.0, 1.0, 2.0, 3.0], 0.5) == 1.5
    assert percentile([4.0], 0.95) == 4.0
