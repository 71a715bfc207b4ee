"""Truth of handle requests and of zones: borders, reach, covered area, and the comparison of their results."""
# SPDX-License-Identifier: Apache-2.0
import csv
import math

import numpy as np
import pytest

from mtr_simulation.car.choice import chosen_car
from mtr_simulation.car.honest.radio.key_antenna import Attitude
from mtr_simulation.truth.compare import main
from mtr_simulation.truth.distance import CarSize, start_and_direction
from mtr_simulation.truth.expected import expected
from mtr_simulation.truth.log import TruthLog
from mtr_simulation.truth.results import MeasuredEvent, ResultsError
from mtr_simulation.truth.zones import ZoneGrid, true_coverage

SIZE = CarSize(4.5, 1.8)
NAN = math.nan
LOOKING = Attitude(-math.pi / 2.0)
HANDLE_HEADER = ("axis,side,key_height_m,status,requests,inside,outside,border_m,inside_at_border,outside_at_border,"
                 "distance_m,uncertainty_m,robot_time_s,d50_m,d50_low_m,d50_high_m,d95_m,d95_low_m,d95_high_m,"
                 "origin_x_m,origin_y_m,direction_x,direction_y")
ZONE_HEADER = ("zone,side,height_m,status,presses,distance_m,low_m,high_m,uncertainty_m,coverage,coverage_low,"
               "coverage_high")

PRESS_HEADER = "radial,angle_deg,status,distance_m,uncertainty_m,robot_time_s"


def handle(border_m=1.5, height_m=1.2):
    """An axis of Handle request."""
    return MeasuredEvent("1", "handle", "ok", NAN, NAN, NAN, "left", (0.0, 1.0), (0.4, 0.91), key_height_m=height_m,
                         border_m=border_m)


class HandleCar:
    """Car whose zone for handle requests is smaller at lower heights."""

    def handle(self, places, attitude):
        return 1.0 / (1.0 + np.exp((places[:, 1] - 0.9 - 1.5 * places[:, 2]) / 0.1))


def test_border_of_handle_requests_is_that_of_its_axis_and_height():
    found = expected(handle(), SIZE, HandleCar(), 1.0)
    assert found[:2] == pytest.approx((1.8, 1.8 - 0.1 * math.log(19.0)), abs=1e-3)
    assert math.isnan(found.static_m)
    assert found.border_share == pytest.approx(1.0 / (1.0 + math.exp(-3.0)), abs=1e-3)
    assert math.isnan(expected(handle(NAN), SIZE, HandleCar(), 1.0).border_share)


def test_handle_request_of_a_car_that_unlocks_by_approach_is_one_look_for_the_key():
    places = np.array([[0.4, 0.9 + distance_m, 1.0] for distance_m in (0.5, 1.6, 4.0)])
    toward = expected_model("honest")
    assert toward.handle(places, LOOKING) == pytest.approx(0.98 * toward.unlock_poll(places, LOOKING))
    assert expected_model("gentle").handle(places, LOOKING).max() == 0.0
    only_handle = expected_model("honest_handle")
    assert np.array_equal(only_handle.handle(places, LOOKING), only_handle.unlock(places, LOOKING))


def expected_model(name):
    """Reaction model of a shipped Car."""
    return chosen_car(name).reactions(1)


class Ring:
    """Car on which every press works within 6 m of its centre, and none farther away."""

    def press(self, places, attitude):
        return (np.hypot(places[:, 0], places[:, 1]) < 6.0).astype(float)


def zone(side="left", height_m=1.0):
    """A zone of Zone map."""
    return MeasuredEvent("7", "reach", "ok", NAN, 5.0, 0.01, side, (0.0, 0.0), key_height_m=height_m)


def test_zone_ends_where_presses_stop_to_work_along_its_middle_from_the_outline():
    assert expected(zone(), SIZE, Ring(), 1.0).p50_distance_m == pytest.approx(5.1, abs=0.02)
    assert expected(zone("front"), SIZE, Ring(), 1.0).p50_distance_m == pytest.approx(3.75, abs=0.02)
    start, direction = start_and_direction(zone("front_right"), SIZE)
    assert start == pytest.approx((0.9, -0.9)) and direction == pytest.approx((math.sqrt(0.5), -math.sqrt(0.5)))


def test_zone_of_no_known_side_is_refused():
    with pytest.raises(ResultsError, match="Zone 7 has side 'roof'"):
        expected(zone("roof"), SIZE, Ring(), 1.0)


def test_true_coverage_is_the_part_of_the_area_where_half_of_the_presses_work():
    grid = ZoneGrid(0.5, 9.5, 0.05, 5.0, 0.3)
    # Ratio of ring areas, 1.4 m to 6 m over 1.4 m to 10.4 m; radials off the middle begin slightly farther out.
    by_hand = (6.0 ** 2 - 1.4 ** 2) / (10.4 ** 2 - 1.4 ** 2)
    assert true_coverage(zone(), SIZE, Ring(), grid) == pytest.approx(by_hand, abs=0.02)
    assert true_coverage(zone(), SIZE, Ring(), grid._replace(farthest_m=4.0)) == 1.0
    assert math.isnan(true_coverage(zone(), SIZE, Ring(), grid._replace(farthest_m=0.4)))


def test_places_of_a_zone_are_those_at_which_the_application_may_press():
    grid = ZoneGrid(0.5, 2.0, 0.5, 15.0, 0.6)
    places = list(grid.places(zone("front"), SIZE))
    # Radials at -15, 0 and 15 degrees; the nearest place on each is too near.
    assert len(places) == 3 * 3
    assert {round(math.degrees(outward)) for _, _, outward in places} == {-15, 0, 15}
    assert min(x for x, _, _ in places) == pytest.approx(2.25 + math.cos(math.radians(15.0)) * 1.0)


@pytest.fixture
def compared(tmp_path, capsys):
    """Function that compares results on the honest Car with a handle and returns exit status, truth.csv and output."""
    log = TruthLog(tmp_path)
    log.handle(10_000_000_000, (0.0, 2.6, 1.0), True)
    log.handle(12_000_000_000, (0.0, 2.9, 1.0), False)
    log.close()

    def compare(results, car="honest_handle"):
        (tmp_path / "results.csv").write_text(results, encoding="utf-8")
        status = main(["--events", str(tmp_path / "truth_events.csv"), "--results", str(tmp_path), "--car-length",
                       "4.5", "--car-width", "1.8", "--car", car])
        with open(tmp_path / "truth.csv", newline="", encoding="utf-8") as file:
            return status, list(csv.DictReader(file)), capsys.readouterr()
    return compare


def test_handle_results_give_true_border_and_distance_and_decisions_beside_the_truth(compared):
    line = "2,left,1.0,ok,14,9,5,1.5,2,0,1.68,0.003,10.1,1.7,1.5,1.9,1.2,1.0,1.4,0,0.9,0,1"
    status, (row,), told = compared(f"# parameter key_height_m: 1.4 m\n{HANDLE_HEADER}\n{line}\n")
    assert status == 0
    assert (row["scenario"], row["line"], row["event"]) == ("handle_request", "2", "handle")
    assert float(row["true_distance_m"]) == pytest.approx(1.7)
    event = MeasuredEvent("2", "handle", "ok", NAN, NAN, NAN, "left", (0.0, 1.0), (0.0, 0.9), border_m=1.5)
    likely = expected(event, SIZE, expected_model("honest_handle"), 1.0)
    assert float(row["p50_distance_m"]) == pytest.approx(likely.p50_distance_m, abs=1e-4)
    assert float(row["true_border_share"]) == pytest.approx(likely.border_share, abs=1e-4)
    assert row["truth_static_m"] == row["true_coverage"] == ""
    assert f"   2    1.500       2 of 2      {likely.border_share:11.3f}" in told.out.splitlines()
    assert "handle_request: 1 of 1 distances are ok and have their true event" in told.out


def test_handle_request_that_the_car_did_not_answer_is_no_true_event(compared):
    line = "2,left,1.0,ok,14,9,5,,0,0,2.0,0.003,12.0,1.7,1.5,1.9,1.2,1.0,1.4,0,0.9,0,1"
    status, (row,), told = compared(f"{HANDLE_HEADER}\n{line}\n")
    assert status == 1 and "Line 2: no true event for its handle" in told.err
    assert row["true_distance_m"] == row["true_border_share"] == ""
    assert "inside at border" not in told.out


def test_zones_are_compared_without_an_event_of_their_own(compared):
    lines = "1,front,1.0,ok,16,3.0,2.0,4.0,0.002,0.5,0.3,0.7\n2,front_right,1.0,not_reached,16,,,0.5,,0.0,0.0,0.1"
    status, rows, told = compared(f"# parameter maximum_distance_m: 5 m\n{ZONE_HEADER}\n{lines}\n", "honest_button")
    assert status == 0 and told.err == ""
    assert [(row["scenario"], row["line"], row["event"], row["true_distance_m"]) for row in rows] == [
        ("zone_map", "1", "reach", ""), ("zone_map", "2", "reach", "")]
    event = MeasuredEvent("1", "reach", "ok", NAN, 3.0, 0.002, "front", (0.0, 0.0), key_height_m=1.0)
    covered = true_coverage(event, SIZE, expected_model("honest_button"), ZoneGrid(0.5, 5.0, 0.5, 15.0, 0.3))
    assert 0.0 < covered < 1.0 and float(rows[0]["true_coverage"]) == pytest.approx(covered, abs=1e-4)
    assert "zone_map: reach, area: " in told.out and "distances are ok" not in told.out


@pytest.mark.parametrize("angle_deg", [60, 90, 180, 360])
def test_radials_of_key_press_may_lie_farther_apart_than_a_zone_is_wide(compared, tmp_path, angle_deg):
    log = TruthLog(tmp_path)
    log.press(10_000_000_000, (5.0, 0.0, 1.0), True)
    log.close()
    results = f"# parameter angle_between_radials_deg: {angle_deg} deg\n{PRESS_HEADER}\n1,0,ok,5.01,0.003,10.1\n"
    status, (row,), told = compared(results, "honest_button")
    assert status == 0 and told.err == ""
    assert (row["scenario"], row["true_distance_m"], row["true_coverage"]) == ("key_press", "5.0000", "")
