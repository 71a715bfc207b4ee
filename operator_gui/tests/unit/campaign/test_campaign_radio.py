"""Radio kernel: scenarios find the positions where the simulated Car reacts; errors shift the results."""
# SPDX-License-Identifier: Apache-2.0
import copy
import dataclasses
import functools
import pathlib
import tempfile

import measured
import pytest

from mtr_campaign.kernels.order import order_of
from mtr_campaign.kernels.outcome import outcome_of
from mtr_campaign.kernels.radio.kernel import RadioKernel
from mtr_campaign.plan.run import Run
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.storage.progress_file import open_progress
from mtr_simulation.truth.distance import CarSize
from mtr_simulation.truth.expected import expected
from mtr_simulation.truth.results import MeasuredEvent

SIZE = CarSize(4.5, 1.8)
# Fast and reliable polls make the event of a pass almost equal to the static boundary: 12 mm between polls.
QUIET = {"car": "honest", "noise.sigma_db": 0.1, "noise.lapse": 0.0, "uhf.fading_sigma_db": 0.0,
         "passive_entry.poll_period_ms": 40, "passive_entry.debounce_polls": 1, "bus.lock_cycle_ms": 20,
         "locks.actuator_ms": 0, "errors.line_m": 0.0, "parameters.measurements_distance_m": 10.0,
         "parameters.maximum_distance_m": 3.5, "parameters.measuring_speed_mps": 0.3}
NEAR_M = 0.03
# Reference results computed without batches of margins; "unlock" and "lock" of each axis, in m.
NOISY = {"car": "honest", "seed": 3, "parameters.passes": 1, "parameters.measuring_speed_mps": 0.4,
         "parameters.measurements_distance_m": 2.0}
WRONG = {**QUIET, "passive_entry.poll_period_ms": 20, "errors.heading_rad": 0.01, "errors.key_lever_m": 0.004,
         "errors.clock_s": 0.02, "errors.line_m": 0.002}
FORMER_M = [
    (NOISY, {"unlock": [1.205216, 1.085216, 0.725216, 1.285216, 0.725216, 1.165216, 1.285216, 0.845216, 0.965216,
                        1.325216, 0.685216, 0.925216],
             "lock": [2.434784, 2.314784, 2.514784, 2.674784, 2.754784, 2.714784, 2.914784, 2.794784, 2.674784,
                      2.794784, 2.314784, 2.074784]}),
    (WRONG, {"unlock": [1.387073, 1.165073, 1.591073, 1.165073, 1.495073, 1.069073, 1.633073, 1.117073],
             "lock": [2.206927, 2.188927, 2.470927, 2.302927, 2.470927, 2.392927, 2.440927, 2.176927]})]


def ran(**settings):
    """Return outcome and progress of one test."""
    return ran_once(tuple(sorted(settings.items())))


@functools.lru_cache(maxsize=None)
def ran_once(settings):
    run = Run("radio", "autolock", {**QUIET, **{name.replace("__", "."): value for name, value in settings}})
    with tempfile.TemporaryDirectory() as folder:
        outcome = RadioKernel().run(order_of(run), pathlib.Path(folder), run.digest)
        return outcome, open_progress(pathlib.Path(folder, "progress.json"), SCENARIOS)[2], order_of(run)


def true_m(order, result, event):
    measured = MeasuredEvent(str(result.axis), event, "ok", 0.0, 0.0, 0.0, result.side,
                             (result.direction_x, result.direction_y), (result.origin_x_m, result.origin_y_m))
    return expected(measured, SIZE, order.car.reactions(order.seed), 1.0).static_m


def test_autolock_finds_the_static_boundaries_of_the_model():
    outcome, progress, order = ran()
    assert outcome.figures["lines"] == len(progress.results) >= 8 and outcome.figures["invalid"] == 0
    for result in progress.results:
        assert result.unlock_distance_m == pytest.approx(true_m(order, result, "unlock"), abs=NEAR_M), result.side
        assert result.lock_distance_m == pytest.approx(true_m(order, result, "lock"), abs=NEAR_M), result.side


def test_same_run_gives_the_same_and_another_seed_something_else():
    one, other = (ran(seed=seed)[0].distances for seed in (1, 2))
    ran_once.cache_clear()
    assert ran(seed=1)[0].distances == one != other


@pytest.mark.parametrize("settings, former_m", FORMER_M, ids=["noise", "errors"])
def test_distances_are_the_former_ones(tmp_path, settings, former_m):
    run = Run("radio", "autolock", settings)
    distances = RadioKernel().run(order_of(run), tmp_path, run.digest).distances
    for word, expected_m in former_m.items():
        assert list(distances[word].values()) == pytest.approx(expected_m, abs=1e-9)


def test_weaker_antenna_shortens_the_lines_beside_it_alone():
    (before, progress, _), (after, _, _) = ran(), ran(antennas__left_door__strength_db=8.2)
    before, after = before.distances["unlock"], after.distances["unlock"]
    sides = {str(result.axis): result.side for result in progress.results}
    changed_m = {sides[line]: after[line] - before[line] for line in before}
    assert changed_m["left"] < -0.1 and abs(changed_m["right"]) < NEAR_M


@pytest.mark.parametrize("settings, moved_m", [
    # On the left side, whose axis points along +y, only the y error counts.
    ({"errors__position_y_m": 0.15}, 0.15), ({"errors__position_x_m": 0.02}, 0.0),
    # The key is nearer to the centre of the robot than specified, so it seems nearer to the Car than it is.
    ({"errors__key_lever_m": 0.12}, -0.12), ({"errors__mast_lean_rad": 0.15}, 0.15),
    # An event that is stamped too late appears 0.09 m too near to the Car at 0.3 m/s.
    ({"errors__clock_s": 0.3}, -0.09), ({"errors__inset_m": 0.15}, 0.15)])
def test_each_error_moves_what_is_found_by_what_it_is(settings, moved_m):
    (_, before, _), (_, after, _) = ran(), ran(**settings)
    (first,), (second,) = ([result for result in progress.results if result.side == "left"]
                           for progress in (before, after))
    assert second.unlock_distance_m - first.unlock_distance_m == pytest.approx(moved_m, abs=NEAR_M)


def test_key_press_searches_its_radials_with_the_applications_own_search(tmp_path):
    run = Run("radio", "key_press", {"car": "honest_button", "parameters.angle_between_radials_deg": 90.0,
                                     "parameters.attempts_limit": 8})
    outcome = RadioKernel().run(order_of(run), tmp_path, run.digest)
    progress = open_progress(tmp_path / "progress.json", SCENARIOS)[2]
    assert outcome.figures["lines"] == 4 and outcome.figures["invalid"] == 0
    assert all(result.attempts >= 6 and result.method == "adaptive" for result in progress.results)


def test_figures_of_a_test_without_distances_say_so():
    progress, order = copy.copy(ran()[1]), ran()[2]
    none = [dataclasses.replace(result, unlock_status=type(result.unlock_status).NOT_REACHED, unlock_static_m=None)
            for result in progress.results]
    progress.results = none
    outcome = outcome_of(order, progress, 1.0)
    assert outcome.figures["unlock_known"] == 0 and "unlock_mean_m" not in outcome.figures
    assert set(outcome.distances["unlock"].values()) == {None}


def test_area_is_that_of_the_polygon_through_what_is_known():
    order = order_of(Run("radio", "key_press", {"car": "honest_button", "parameters.angle_between_radials_deg": 90.0}))
    outcome = outcome_of(order, measured.progress(6.0, 5.0, 4.0, 3.0), 1.0)
    # For points on the axes of the Car, the area is half the product of the diagonals.
    assert outcome.figures["press_area_m2"] == pytest.approx((6.0 + 4.0) * (5.0 + 3.0) / 2.0)
    assert outcome.distances == {"press": {"1": 6.0, "2": 5.0, "3": 4.0, "4": 3.0}}
