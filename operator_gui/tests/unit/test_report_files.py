"""results.csv, protocol.png and protocol.pdf."""
# SPDX-License-Identifier: Apache-2.0
import csv
import io
import struct
from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from mtr_operator.domain.identity.identity_document import identity_from
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.results.picture import Picture, Stretch
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.scenarios.key_press_result import KeyPressResult
from mtr_operator.report.figures import sigma_text
from mtr_operator.report.files import write_report
from mtr_operator.report.protocol_page import label_stretches
from mtr_operator.report.protocol_rows import date_text, parameter_rows
from mtr_operator.report.results_csv import results_csv
from mtr_operator.report.table import line_text, results_table

HEADERS = {
    "autolock": "axis,side,origin_x_m,origin_y_m,direction_x,direction_y,unlock_result_m,unlock_low_m,unlock_high_m,"
                "lock_result_m,lock_low_m,lock_high_m,unlock_status,unlock_distance_m,"
                "unlock_uncertainty_m,unlock_robot_time_s,lock_status,lock_distance_m,lock_uncertainty_m,"
                "lock_robot_time_s,unlock_lateral_offset_m,unlock_heading_offset_deg,unlock_key_height_m,"
                "unlock_speed_mps,unlock_cause,lock_lateral_offset_m,lock_heading_offset_deg,lock_key_height_m,"
                "lock_speed_mps,lock_cause,"
                "unlock_passes,unlock_pass_distances_m,unlock_pass_speeds_mps,unlock_static_m,"
                "unlock_static_sigma_m,unlock_static_low_m,unlock_static_high_m,unlock_reaction_s,"
                "unlock_reaction_low_s,unlock_reaction_high_s,lock_passes,lock_pass_distances_m,"
                "lock_pass_speeds_mps,lock_static_m,lock_static_sigma_m,lock_static_low_m,lock_static_high_m,"
                "lock_reaction_s,lock_reaction_low_s,lock_reaction_high_s,"
                "unlock_static_common_sigma_m,unlock_static_shared_sigma_m,"
                "lock_static_common_sigma_m,lock_static_shared_sigma_m,"
                "unlock_key_number,unlock_doors,lock_key_number,lock_doors,"
                "unlock_own_sigma_m,unlock_common_sigma_m,unlock_expanded_m,"
                "lock_own_sigma_m,lock_common_sigma_m,lock_expanded_m,verdict,verdict_reason,"
                "unlock_to_outline_m,lock_to_outline_m,looks,look_percent,unlock_look_low_m,unlock_look_high_m,"
                "lock_look_low_m,lock_look_high_m",
    "key_press": "radial,angle_deg,result_m,low_m,high_m,"
                 "status,distance_m,failed_distance_m,uncertainty_m,attempts,robot_time_s,"
                 "lateral_offset_m,heading_offset_deg,key_height_m,speed_mps,cause,method,reach,d50_m,d50_sigma_m,"
                 "d50_low_m,d50_high_m,d95_m,d95_low_m,d95_high_m,nearest_failure_m,holes_m,lapse,fit_quality,"
                 "unconfirmed_m,key_number,doors,"
                 "press_own_sigma_m,press_common_sigma_m,press_expanded_m,verdict,verdict_reason,press_to_outline_m,"
                 "looks,look_percent,press_look_low_m,press_look_high_m,boundaries,hole_from_m,hole_to_m",
    "zone_map": "zone,side,height_m,reach_result_m,reach_low_m,reach_high_m,"
                "status,presses,distance_m,low_m,high_m,uncertainty_m,coverage,coverage_low,"
                "coverage_high,reach_own_sigma_m,reach_common_sigma_m,reach_expanded_m,verdict,verdict_reason,"
                "reach_to_outline_m",
    "handle_request": "axis,side,key_height_m,result_m,low_m,high_m,"
                      "status,requests,inside,outside,border_m,inside_at_border,"
                      "outside_at_border,requested_by,distance_m,uncertainty_m,robot_time_s,lateral_offset_m,"
                      "heading_offset_deg,cause,reach,d50_m,d50_sigma_m,d50_low_m,d50_high_m,d95_m,d95_low_m,"
                      "d95_high_m,nearest_failure_m,holes_m,lapse,fit_quality,unconfirmed_m,origin_x_m,origin_y_m,"
                      "direction_x,direction_y,key_number,doors,handle_own_sigma_m,handle_common_sigma_m,handle_expanded_m,verdict,"
                      "verdict_reason,handle_to_outline_m,looks,look_percent,handle_look_low_m,handle_look_high_m,"
                      "boundaries,hole_from_m,hole_to_m",
    "digital_key": "position,side,nominal_m,key_height_m,result_m,low_m,high_m,"
                   "status,answer,samples,reported_m,reported_spread_m,"
                   "reported_sigma_m,age_s,reference_m,uncertainty_m,error_m,error_low_m,error_high_m,robot_time_s,x_m,"
                   "y_m,along_m,lateral_offset_m,heading_offset_deg,phone_own_sigma_m,phone_common_sigma_m,"
                   "phone_expanded_m,verdict,verdict_reason,phone_to_outline_m",
    "sleep_time": "axis,side,key_height_m,result_m,low_m,high_m,"
                  "status,asleep,answers_until_s,silent_from_s,trials,answered_after_s,"
                  "unanswered_after_s,disturbed,requested_by,distance_m,uncertainty_m,robot_time_s,cause,"
                  "key_number,doors,held_own_sigma_m,held_common_sigma_m,held_expanded_m,verdict,verdict_reason,held_to_outline_m",
    "relay_resistance": "axis,side,key_height_m,result_m,low_m,high_m,"
                        "status,resistance,border_m,requests_off,unlocks_off,bound_off,"
                        "requests_on,unlocks_on,bound_on,unlocked_off_m,silent_off_m,unlocked_on_m,silent_on_m,requested_by,"
                        "switched_by,distance_m,uncertainty_m,robot_time_s,lateral_offset_m,heading_offset_deg,cause,"
                        "key_number,doors,relay_own_sigma_m,relay_common_sigma_m,relay_expanded_m,verdict,"
                        "verdict_reason,relay_to_outline_m",
}


def axis(number, unlock="ok", lock="ok", reason=""):
    unlocked, locked = unlock == "ok", lock == "ok"
    return AutolockResult(
        axis=number, side="left", origin_x_m=-0.0, origin_y_m=0.9, direction_x=0.0, direction_y=1.0,
        unlock_status=LineStatus(unlock), unlock_distance_m=1.23456 if unlocked else None,
        unlock_uncertainty_m=0.03 if unlocked else None, unlock_robot_time_s=12.3456 if unlocked else None,
        lock_status=LineStatus(lock), lock_distance_m=2.0 if locked else None, lock_uncertainty_m=None,
        lock_robot_time_s=14.0 if locked else None, reason=reason, unlock_cause="passive_entry" if unlocked else "",
        unlock_lateral_offset_m=-0.01234 if unlocked else None)


def progress_of(scenario, results):
    session = {"started": "2020-02-03T04:05:06+00:00", "software": "mtr-operator 9", "car profile": "some\ncar"}
    return Progress(scenario.name, scenario.parameters_type().to_mapping(), session,
                    CarDimensions(4.5, 1.8, 0.02, 0.01), results)


def lines_of(text):
    lines = text.splitlines()
    return [line for line in lines if line.startswith("#")], [line for line in lines if not line.startswith("#")]


@pytest.mark.parametrize("name", list(SCENARIOS))
def test_header_is_the_promised_one(name):
    assert lines_of(results_csv(SCENARIOS[name], progress_of(SCENARIOS[name], [])))[1] == [HEADERS[name]]


def test_values_are_written_with_points_and_missing_ones_are_empty():
    scenario = SCENARIOS["autolock"]
    _, rows = lines_of(results_csv(scenario, progress_of(scenario, [axis(1), axis(2, "not_reached", "invalid")])))
    assert rows[1] == "1,left,0.0000,0.9000,0.000000,1.000000,1.2346,,,2.0000,,,ok,1.2346,0.0300,12.346,ok,2.0000,," \
        "14.000," \
        "-0.0123,,,,passive_entry,,,,,,0,,,,,,,,,,0,,,,,,,,,,,,,,,,,,,,,,,,not_set,,,,,,,,,"
    passes = "0" + 10 * "," + "0" + 24 * "," + "not_set,,,,,,,,,"
    assert rows[2] == "2,left,0.0000,0.9000,0.000000,1.000000,,,0.5000,,,,not_reached,,,,invalid,,," + 11 * "," + passes


def test_list_stands_in_one_cell_and_in_one_line_of_metadata():
    scenario = SCENARIOS["autolock"]
    progress = progress_of(scenario, [replace(axis(1), unlock_pass_distances_m=(1.2, 1.35), unlock_passes=2)])
    progress.parameters.update(passes=2, measuring_speeds_mps=[0.4, 0.1])
    metadata, rows = lines_of(results_csv(scenario, progress))
    assert ",2,1.2000 1.3500,," in rows[1]
    assert "# parameter measuring_speeds_mps: 0.4 m/s, 0.1 m/s" in metadata
    assert ("Speeds of the passes", "1.44 km/h; 0.36 km/h") in parameter_rows(scenario, progress)


def test_metadata_names_parameters_units_version_profile_and_reasons():
    scenario = SCENARIOS["autolock"]
    metadata, _ = lines_of(results_csv(scenario, progress_of(scenario, [axis(3, "invalid", "invalid", "Bus\noff.")])))
    text = "\n".join(metadata)
    for part in ("# scenario: Autolock", "# software: mtr-operator 9", "# car profile: some car",
                 "# parameter maximum_distance_m: 4 m", "# parameter measuring_speed_mps: not set",
                 "# column unlock_distance_m [m]: ", "# axis 3 is invalid: Bus off.", "# Car length: 4.500 m"):
        assert part in text


def test_table_is_in_metres_as_the_file_says_what_is_known_and_why_a_line_is_invalid__A7():
    results = [axis(1), axis(12, "ok", "not_reached"), axis(13, "invalid", "invalid", "Bus off.")]
    scenario = SCENARIOS["autolock"]
    assert list(results_table(scenario, results, scenario.parameters_type())) == [
        "axis        unlock m  key \N{PLUS-MINUS SIGN} m         lock m  key \N{PLUS-MINUS SIGN} m",
        "   1  left     1.235    0.030           2.00",
        "  12  left     1.235    0.030  at least 3.50",
        "  13  left   invalid                 invalid",
        "Beside each distance stands 1 sigma of where the Remote key was at this one event; at another attempt the Car "
        "may react elsewhere, by more than that.",
        "axis 13 (left) is invalid: Bus off."]


@pytest.mark.parametrize(("sigma_m", "text", "shown"), [
    (0.0, "< 0.001", "1.235 \N{PLUS-MINUS SIGN} < 0.001 m"), (0.0004, "< 0.001", "1.235 \N{PLUS-MINUS SIGN} < 0.001 m"),
    (0.0006, "0.001", "1.235 \N{PLUS-MINUS SIGN} 0.001 m"), (0.06, "0.060", "1.23 \N{PLUS-MINUS SIGN} 0.060 m"),
    (None, "", "1.23 m")])
def test_uncertainty_is_never_shown_as_none__A8(sigma_m, text, shown):
    assert sigma_text(sigma_m) == text
    line = line_text(SCENARIOS["autolock"], replace(axis(1), unlock_uncertainty_m=sigma_m))
    assert line == f"axis 1 (left): unlock {shown}, lock 2.00 m"


SCAN = KeyPressResult(1, 0.0, LineStatus.OK, 4.006, 4.506, 0.001, 3, 1.0, "")


@pytest.mark.parametrize(("result", "text"), [
    (SCAN, "radial 1 (0\N{DEGREE SIGN}): press 4.01 to 4.51 m"),
    (replace(SCAN, distance_m=6.0, failed_distance_m=None), "radial 1 (0\N{DEGREE SIGN}): press at least 6.00 m"),
    (replace(SCAN, status=LineStatus.NOT_REACHED, distance_m=None, failed_distance_m=3.0, uncertainty_m=None),
     "radial 1 (0\N{DEGREE SIGN}): press at most 3.00 m"),
    (replace(SCAN, status=LineStatus.INVALID, distance_m=None, reason="Bus off."),
     "radial 1 (0\N{DEGREE SIGN}): press invalid: Bus off.")])
def test_range_between_two_places_and_one_beyond_the_first_are_told_as_such__A5_A6(result, text):
    scenario = SCENARIOS["key_press"]
    assert line_text(scenario, result, scenario.parameters_type()) == text


def test_csv_says_above_its_table_what_may_be_said_of_each_line__A5_A6():
    scenario = SCENARIOS["key_press"]
    beyond = replace(SCAN, radial=2, angle_deg=45.0, distance_m=6.0, failed_distance_m=None)
    metadata, rows = lines_of(results_csv(scenario, progress_of(scenario, [SCAN, beyond])))
    assert "# result: radial 1 (0\N{DEGREE SIGN}): press 4.01 to 4.51 m" in metadata
    assert "# result: radial 2 (45\N{DEGREE SIGN}): press at least 6.00 m" in metadata
    assert any(line.startswith("# Of a range between two places") for line in metadata)
    assert len(rows) == 3


@pytest.mark.parametrize(("started", "shown"), [
    ("2020-02-03T04:05:06+00:00", "2020-02-03  04:05  (UTC+00:00)"),
    ("2020-02-03T04:05:06-03:30", "2020-02-03  04:05  (UTC-03:30)"),
    ("2020-02-03T04:05:06", "2020-02-03  04:05"), ("yesterday", "yesterday")])
def test_date_of_the_protocol_says_its_time_zone(started, shown):
    assert date_text(started) == shown


def test_uncertainty_is_drawn_along_the_axis():
    scenario = SCENARIOS["autolock"]
    picture = scenario.picture(scenario.parameters_type(), CarDimensions(4.5, 1.8, 0.02, 0.01), [axis(1), axis(2)])
    unlocked, locked = picture.point_sets[:2]
    near, far = unlocked.bars[0]
    assert (near, far) == (pytest.approx((0.0, 0.9 + 1.20456)), pytest.approx((0.0, 0.9 + 1.26456)))
    assert (len(unlocked.bars), locked.bars) == (2, ())


def test_labels_that_would_touch_are_left_out():
    axes = Figure().add_axes((0, 0, 1, 1))
    axes.set_ylim(-8.0, 8.0)
    stretches = tuple(Stretch((3.0, 0.0), (6.0, 0.02 * number), str(number)) for number in range(100))
    label_stretches(axes, Picture(stretches, ()))
    assert 2 < len(axes.texts) < 10


def test_file_is_read_back_by_a_csv_reader(tmp_path):
    scenario = SCENARIOS["autolock"]
    write_report(tmp_path, scenario, scenario.parameters_type(), progress_of(scenario, [axis(1), axis(2)]))
    with (tmp_path / "results.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    assert [float(row["unlock_distance_m"]) for row in rows] == [1.2346, 1.2346]


@pytest.mark.parametrize("written, shown", [
    ('key 2,"winter', "key 2,'\"winter"), ("tyres: 235,=HYPERLINK(1)", "tyres: 235,'=HYPERLINK(1)"),
    ("a; =1", "a;' =1"), ("a,+1,-1,@SUM(1)", "a,'+1,'-1,'@SUM(1)"),
    ('a "b", c, -1 = d; e', 'a "b", c, -1 = d; e'), ("=1", "=1")])
def test_what_a_person_wrote_is_neither_a_formula_nor_takes_rows_away(written, shown):
    scenario = SCENARIOS["autolock"]
    progress = progress_of(scenario, [axis(1), axis(2)])
    without = results_csv(scenario, progress)
    progress.identity = identity_from({"notes": written})
    content = results_csv(scenario, progress)
    added, = set(content.splitlines()) - set(without.splitlines())
    assert added == f"# identity notes: {shown}"
    rows = list(csv.reader(io.StringIO(content)))
    assert len(rows) == content.count("\n") and sum(row[0].startswith("#") for row in rows) == len(rows) - 3
    assert not [cell for row in rows[:-3] for cell in row if cell[:1] in tuple("=+-@\t")]


@pytest.mark.parametrize("text, cell", [("=1+1", "'=1+1"), ("-2+3 b", "'-2+3 b"), ("-3.10 4.20", "-3.10 4.20")])
def test_text_of_the_table_is_no_formula(text, cell):
    scenario = SCENARIOS["autolock"]
    progress = progress_of(scenario, [replace(axis(1), unlock_cause=text)])
    row, = csv.DictReader(lines_of(results_csv(scenario, progress))[1])
    assert row["unlock_cause"] == cell


@pytest.mark.parametrize("results", [
    [], [axis(1)], [axis(number) for number in range(1, 6)],
    [axis(1), axis(2, "not_reached", "not_reached"), axis(3, "invalid", "invalid", "x"), axis(4), axis(5)],
])
def test_picture_is_drawn_whatever_was_measured(tmp_path, results):
    scenario = SCENARIOS["autolock"]
    write_report(tmp_path, scenario, scenario.parameters_type(), progress_of(scenario, results))
    content = (tmp_path / "protocol.png").read_bytes()
    width, height = struct.unpack(">II", content[16:24])
    assert content.startswith(b"\x89PNG\r\n\x1a\n")
    assert (width, height) == (1755, 1245)
    assert sorted(file.name for file in tmp_path.iterdir()) == [
        "budget.json", "protocol.pdf", "protocol.png", "results.csv"]


def test_page_of_the_same_test_is_the_same_whenever_it_is_made(tmp_path, monkeypatch):
    scenario = SCENARIOS["autolock"]
    pages = []
    for epoch_s in ("0", "86400"):
        monkeypatch.setenv("SOURCE_DATE_EPOCH", epoch_s)
        write_report(tmp_path, scenario, scenario.parameters_type(), progress_of(scenario, [axis(1), axis(2)]))
        pages.append((tmp_path / "protocol.pdf").read_bytes())
    assert pages[0].startswith(b"%PDF-") and b"/Type /Pages /Kids [ " in pages[0] and b"/Count 1 " in pages[0]
    assert pages[0] == pages[1]
