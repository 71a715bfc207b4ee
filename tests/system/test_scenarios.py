"""A short test of each kind through the whole stack, compared with the simulator's truth."""
# SPDX-License-Identifier: Apache-2.0
import json
import pathlib

import pytest

from mtr_simulation.demo import THRESHOLD_LIMITS, compare, read_rows

PARAMETERS = pathlib.Path(__file__).parent / "parameters"
# The Car is almost a threshold and the robot sees its surroundings: the place is known to some mm.
LARGEST_ERROR_M = 0.05

AUTOLOCK_COLUMNS = ("axis,side,origin_x_m,origin_y_m,direction_x,direction_y,"
                    "unlock_result_m,unlock_low_m,unlock_high_m,lock_result_m,lock_low_m,lock_high_m,unlock_status,unlock_distance_m,"
                    "unlock_uncertainty_m,unlock_robot_time_s,lock_status,lock_distance_m,lock_uncertainty_m,"
                    "lock_robot_time_s,unlock_lateral_offset_m,unlock_heading_offset_deg,unlock_key_height_m,"
                    "unlock_speed_mps,unlock_cause,lock_lateral_offset_m,lock_heading_offset_deg,lock_key_height_m,"
                    "lock_speed_mps,lock_cause,"
                    "unlock_passes,unlock_pass_distances_m,unlock_pass_speeds_mps,unlock_static_m,"
                    "unlock_static_sigma_m,unlock_static_low_m,unlock_static_high_m,unlock_reaction_s,"
                    "unlock_reaction_low_s,unlock_reaction_high_s,lock_passes,lock_pass_distances_m,"
                    "lock_pass_speeds_mps,lock_static_m,lock_static_sigma_m,lock_static_low_m,"
                    "lock_static_high_m,lock_reaction_s,lock_reaction_low_s,lock_reaction_high_s,"
                    "unlock_static_common_sigma_m,unlock_static_shared_sigma_m,"
                    "lock_static_common_sigma_m,lock_static_shared_sigma_m,"
                    "unlock_key_number,unlock_doors,lock_key_number,lock_doors,"
                    "unlock_own_sigma_m,unlock_common_sigma_m,unlock_expanded_m,"
                    "lock_own_sigma_m,lock_common_sigma_m,lock_expanded_m,verdict,verdict_reason,"
                    "unlock_to_outline_m,lock_to_outline_m,looks,look_percent,unlock_look_low_m,unlock_look_high_m,"
                    "lock_look_low_m,lock_look_high_m")
KEY_PRESS_COLUMNS = ("radial,angle_deg,result_m,low_m,high_m,"
                     "status,distance_m,failed_distance_m,uncertainty_m,attempts,robot_time_s,"
                     "lateral_offset_m,heading_offset_deg,key_height_m,speed_mps,cause,method,reach,d50_m,d50_sigma_m,"
                     "d50_low_m,d50_high_m,d95_m,d95_low_m,d95_high_m,nearest_failure_m,holes_m,lapse,fit_quality,"
                     "unconfirmed_m,key_number,doors,"
                     "press_own_sigma_m,press_common_sigma_m,press_expanded_m,verdict,verdict_reason,press_to_outline_m,"
                     "looks,look_percent,press_look_low_m,press_look_high_m,boundaries,hole_from_m,hole_to_m")


@pytest.fixture(scope="module")
def autolock(application, out):
    done = application.run("autolock", PARAMETERS / "autolock.yaml", out / "autolock")
    assert done.returncode == 0, done.stderr
    return out / "autolock"


@pytest.fixture(scope="module")
def key_press(application, out, autolock):
    done = application.run("key_press", PARAMETERS / "key_press.yaml", out / "key_press")
    assert done.returncode == 0, done.stderr
    return out / "key_press"


def errors_against_truth(out, folder, columns):
    """Measured minus true distances of a run."""
    assert compare(out / "truth_events.csv", folder, *THRESHOLD_LIMITS) == 0
    truth = {(row["line"], row["event"]): float(row["true_distance_m"]) for row in read_rows(folder / "truth.csv")}
    rows = read_rows(folder / "results.csv")
    line = columns[0]
    return [float(row[distance]) - truth[row[line], event]
            for row in rows for event, status, distance in columns[1:] if row[status] == "ok"]


def test_autolock_measures_every_side_and_corner(autolock):
    rows = read_rows(autolock / "results.csv")
    assert ",".join(rows[0]) == AUTOLOCK_COLUMNS
    assert {row["side"] for row in rows} == {"left", "right", "front", "rear", "front_left", "front_right",
                                             "rear_left", "rear_right"}
    assert all(row["unlock_status"] == row["lock_status"] == "ok" for row in rows)
    assert all(float(row["lock_distance_m"]) > float(row["unlock_distance_m"]) for row in rows)


def test_autolock_distances_are_true(autolock, out):
    errors = errors_against_truth(out, autolock, ("axis", ("unlock", "unlock_status", "unlock_distance_m"),
                                                  ("lock", "lock_status", "lock_distance_m")))
    assert len(errors) == 16
    assert max(map(abs, errors)) < LARGEST_ERROR_M


def test_key_press_finds_the_farthest_place_on_each_radial(key_press):
    rows = read_rows(key_press / "results.csv")
    assert ",".join(rows[0]) == KEY_PRESS_COLUMNS
    assert [float(row["angle_deg"]) for row in rows] == [0.0, 120.0, 240.0]
    assert all(row["status"] == "ok" for row in rows)
    assert all(not row["failed_distance_m"] or float(row["failed_distance_m"]) > float(row["distance_m"])
               for row in rows)


def test_key_press_distances_are_true(key_press, out):
    errors = errors_against_truth(out, key_press, ("radial", ("press", "status", "distance_m")))
    assert len(errors) == 3
    assert max(map(abs, errors)) < LARGEST_ERROR_M


def test_pictures_and_progress_are_left(autolock, key_press):
    for folder in (autolock, key_press):
        assert (folder / "protocol.png").read_bytes().startswith(b"\x89PNG")
        json.loads((folder / "progress.json").read_text(encoding="utf-8"))
