"""Random Cars are plausible, the robot gets around them, and estimates are evaluated correctly."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_benchmarks.harness.rows import all_met
from mtr_benchmarks.localization import __main__ as program
from mtr_benchmarks.localization import one_any_car, report
from mtr_benchmarks.localization.drives.legs import PathLeg
from mtr_benchmarks.localization.drives.pattern import LOOP, pieces
from mtr_benchmarks.localization.drives.random_car import LENGTH_M, NEIGHBOUR_GAP_M, WIDTH_M, random_car
from mtr_benchmarks.localization.drives.record import DriveError, plan
from mtr_benchmarks.localization.drives.selection import ANY_CARS, any_cars
from mtr_benchmarks.localization.drives.site_bodies import clearance_m, site_bodies
from mtr_benchmarks.localization.judging import any_car
from mtr_benchmarks.localization.methods.outcome import THIS_SYSTEM, CarErrors
from mtr_benchmarks.localization.methods.this_system import NotLocated, SystemFailure
from mtr_benchmarks.localization.one_drive import RECORDING, DriveResult, DriveTask
from mtr_benchmarks.localization.repeats import MAX_DRIVES

ROBOT_RADIUS_M = 0.35
SEEDS = range(1, ANY_CARS + 1)
EXACT = CarErrors(0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.002, 0.002, 0.0, 0.0, 0.005, 0.005, [0.001, 0.001, 0.0005], False,
                  "", 0.0)


def judged(**errors):
    return any_car.verdict(replace(EXACT, **errors), {})


def test_seeds_draw_cars_of_all_sizes_and_the_same_ones_again():
    shapes = [random_car(seed).shape for seed in SEEDS]
    assert shapes == [random_car(seed).shape for seed in SEEDS]
    for sizes, (low, high) in (([each.length_m for each in shapes], LENGTH_M),
                               ([each.width_m for each in shapes], WIDTH_M)):
        assert low <= min(sizes) < low + 0.1 * (high - low) and high - 0.2 * (high - low) < max(sizes) <= high
    for fitting in ("tow_bar_m", "low_mirrors_m", "tailgate_m", "sill_rise_m", "undercut_m"):
        assert 0 < sum(getattr(each, fitting) > 0.0 for each in shapes) < len(shapes)


@pytest.mark.parametrize("drive", any_cars(60), ids=lambda drive: drive.name)
def test_way_round_keeps_away_from_all_and_ends_where_it_was_before(drive):
    options = drive.options
    site, passed = options.scenario(), []
    bodies = site_bodies(site)
    for piece in pieces(options.shape, site.start_in_car, plan(options)):
        if piece.kind == LOOP and isinstance(piece.leg, PathLeg):
            passed += piece.leg.points
    assert min(clearance_m(bodies, *place) for place in passed) > ROBOT_RADIUS_M
    assert min(math.dist(passed[-1], place) for place in passed[:-1]) < 0.1
    if options.neighbour:
        assert NEIGHBOUR_GAP_M - 1e-6 <= min(body.clearance_m(*place) for body in bodies[1:]
                                              for place in outline(options.shape)) < NEIGHBOUR_GAP_M + 0.3


def outline(shape):
    """Return places on the Car's outline, every 5 cm."""
    x, y = 0.5 * shape.length_m, 0.5 * shape.width_m
    steps = [index / 100.0 for index in range(-100, 101)]
    return [*((share * x, side * y) for share in steps for side in (1, -1)),
            *((side * x, share * y) for share in steps for side in (1, -1))]


def test_car_that_is_off_by_what_it_says_is_right():
    assert judged().verdict == any_car.RIGHT
    assert judged(along_error_m=0.2, sigmas=[0.08, 0.001, 0.0005]).verdict == any_car.RIGHT
    assert judged(across_error_m=-0.029, width_error_body_m=0.029).verdict == any_car.RIGHT


@pytest.mark.parametrize("errors", [{"along_error_m": -0.031}, {"across_error_m": 0.04}, {"length_error_body_m": 0.05},
                                    {"width_error_body_m": -0.05}, {"yaw_error_deg": 0.6},
                                    {"length_error_body_m": 0.4, "length_sigma_m": 0.1},
                                    {"along_error_m": math.nan}, {"yaw_error_deg": math.nan},
                                    {"width_error_body_m": math.nan, "width_sigma_m": math.inf},
                                    {"across_error_m": 0.01, "sigmas": [0.001, math.inf, 0.0005]},
                                    {"length_sigma_m": math.nan}, {"sigmas": [0.001, 0.001, math.nan]}])
def test_car_that_is_off_by_more_is_wrong_and_told(errors):
    found = judged(**errors)
    assert found.verdict == any_car.WRONG and " with a sigma of " in found.sentence


def rows_of(*verdicts, failed=0):
    return {row.requirement.name.partition(": ")[2]: row for row in any_car.rows(list(verdicts), failed)}


def test_rows_count_what_is_asked_and_what_is_wrong():
    asked = any_car.CarVerdict(any_car.ASKED, "No.", {})
    table = rows_of(judged(), judged(), asked, judged(along_error_m=1.0))
    assert table["found right"].value == 0.5 and not table["found right"].is_met
    assert table["wrong without a word"].value == 1 and not table["wrong without a word"].is_met
    assert all_met(list(rows_of(*[judged()] * 39, asked).values()))
    for none in (rows_of(), rows_of(judged(), failed=1)):
        assert [row.requirement for row in none.values() if row.is_met] == [any_car.CLOSE_CARS]


def test_rows_tell_what_right_is_made_of():
    by_sigma = judged(along_error_m=0.5, length_error_body_m=1.0, sigmas=[0.4, 0.001, 0.001], length_sigma_m=0.8)
    table = rows_of(judged(), judged(), judged(), by_sigma)
    assert table["found right"].value == 1.0
    close, largest = (table[each.name.partition(": ")[2]] for each in (any_car.CLOSE_CARS, any_car.LARGEST_SIGMA))
    assert close.value == 0.75 and close.remark == "3 of 4; the other right ones by their sigmas"
    assert largest.value == 0.8 and largest.is_met


def test_car_of_which_nothing_is_said_is_right_but_its_sigma_is_not_met():
    vague = judged(along_error_m=2.0, sigmas=[0.7, 0.7, 0.001], length_error_body_m=2.0, length_sigma_m=0.9)
    assert vague.verdict == any_car.RIGHT
    assert not rows_of(judged(), vague)[any_car.LARGEST_SIGMA.name.partition(": ")[2]].is_met


def drawn(**options):
    return DriveTask(any_cars(1, 7)[0], options.pop("folder"), None)


def test_refusal_counts_as_asked_and_another_failure_as_none(tmp_path, monkeypatch):
    monkeypatch.setattr(one_any_car, "record", lambda options, folder: {"segments": []})
    monkeypatch.setattr(one_any_car, "read_truth", lambda folder: None)

    def refuse(error):
        def mapped(bag, out):
            raise error
        monkeypatch.setattr(one_any_car, "mapped", mapped)
        return one_any_car.run_any_car(drawn(folder=tmp_path))

    assert refuse(NotLocated("What?")).car.verdict == any_car.ASKED
    failed = refuse(SystemFailure("Broken."))
    assert failed.car is None and failed.failures == {THIS_SYSTEM: "Broken."}


def test_drive_that_touches_something_is_made_with_another_car_and_told(tmp_path, monkeypatch):
    seeds = []

    def record(options, folder):
        seeds.append(options.seed)
        raise DriveError("It touches.")

    monkeypatch.setattr(one_any_car, "record", record)
    result = one_any_car.run_any_car(drawn(folder=tmp_path))
    assert len(set(seeds)) == MAX_DRIVES == len(result.repeats) and RECORDING in result.failures


def test_report_names_each_car_that_was_not_right():
    drives = any_cars(2, 3)
    results = [DriveResult(drives[0], {}, {}, [], car=judged()),
               DriveResult(drives[1], {}, {}, [], car=judged(along_error_m=1.0))]
    made = report.any_car_report(results)
    assert [each["verdict"] for each in made.figures["any_car"]["cars"]] == ["right", "wrong"]
    assert any(drives[1].name in sentence for sentence in report.remarks(results))
    assert not any(drives[0].name in sentence for sentence in report.remarks(results))


@pytest.mark.parametrize("arguments", [["--any-cars", "0"], ["--any-cars-only", "--kidnappings-only"]])
def test_arguments_that_make_no_sense_are_refused(arguments, capsys):
    with pytest.raises(SystemExit) as caught:
        program.main(arguments)
    assert caught.value.code == 2 and capsys.readouterr().err
