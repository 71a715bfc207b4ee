"""What passes of an axis tell of its static boundary: which passes count, and the errors that all of them share."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import replace

import pytest

from mtr_operator.domain.ports import PASSIVE_ENTRY, LockFacts
from mtr_operator.domain.results.line_result import LineStatus
from mtr_operator.domain.robot_status import CarDimensions
from mtr_operator.domain.scenarios.autolock import SCENARIO
from mtr_operator.domain.scenarios.autolock_boundary import with_boundaries
from mtr_operator.domain.scenarios.autolock_parameters import AutolockParameters
from mtr_operator.domain.scenarios.autolock_result import AutolockResult
from mtr_operator.domain.scenarios.autolock_speeds import pass_speeds
from mtr_operator.domain.verdict.judgement import Circumstances, judge
from mtr_operator.domain.verdict.limits_document import limits_from
from mtr_operator.domain.verdict.verdict import Verdict
from mtr_operator.report.table import line_text

TWO = AutolockParameters(measurements_distance_m=10.0, passes=2, measuring_speeds_mps=(0.4, 0.1))
SHARED_M = 0.03


def axis(distances_m, speeds_mps, sigma_m=0.0, told_every_s=0.0):
    """Result of an axis with these passes in both directions, not yet read."""
    return AutolockResult(
        1, "front", 2.25, 0.0, 1.0, 0.0, LineStatus.OK, distances_m[0], sigma_m, 10.0,
        LineStatus.OK, 2.5, sigma_m, 20.0, "", unlock_speed_mps=speeds_mps[0], lock_speed_mps=-speeds_mps[0],
        unlock_pass_distances_m=distances_m, unlock_pass_speeds_mps=speeds_mps,
        lock_pass_distances_m=(2.7, 2.55), lock_pass_speeds_mps=(0.4, 0.1), told_every_s=told_every_s)


def read(result, parameters=TWO):
    """The same with its static boundaries."""
    return with_boundaries([result], parameters, [result])[0]


@pytest.mark.parametrize("told_every_s", [None, 0.0, 0.2, 0.8])
def test_error_that_all_passes_share_widens_the_boundary_without_the_part_of_each_ones_message(told_every_s):
    passes = axis((1.3, 1.45), (0.4, 0.1), told_every_s=told_every_s)
    # The instant of a message lies anywhere in its cycle; the passes have that part each for itself.
    own_m = 0.4 * (told_every_s or 0.0) / math.sqrt(12.0)
    sigma_m = math.hypot(SHARED_M, own_m)
    alone, whole = read(passes), read(replace(passes, unlock_uncertainty_m=sigma_m, lock_uncertainty_m=sigma_m))
    for word in ("unlock", "lock"):
        narrow_m, wide_m = (getattr(each, f"{word}_static_sigma_m") for each in (alone, whole))
        assert math.sqrt(wide_m ** 2 - narrow_m ** 2) == pytest.approx(SHARED_M, abs=2e-4)
        assert getattr(whole, f"{word}_static_m") == getattr(alone, f"{word}_static_m")


def test_pass_that_is_less_certain_by_its_message_than_told_shares_nothing():
    certain = axis((1.3, 1.45), (0.4, 0.1), 0.01, told_every_s=0.8)
    assert read(certain).unlock_static_sigma_m == read(
        replace(certain, unlock_uncertainty_m=0.0)).unlock_static_sigma_m


def test_car_of_which_no_cycle_is_recorded_is_read_as_one_that_tells_at_once():
    unknown, at_once, slow = (read(axis((1.3, 1.45), (0.4, 0.1), told_every_s=cycle_s)) for cycle_s in (None, 0.0, 0.8))
    assert unknown.distances == at_once.distances
    assert at_once.unlock_static_low_m < 1.5 < at_once.unlock_static_high_m
    assert at_once.unlock_static_sigma_m < slow.unlock_static_sigma_m


def test_robot_that_does_not_say_how_well_it_knows_its_place_leaves_no_interval(run_scenario, spoil):
    said = run_scenario(SCENARIO, TWO)[0]
    spoil(lambda status: True, position_sigma_m=math.nan)
    unsaid = run_scenario(SCENARIO, TWO)[0]
    assert unsaid.unlock_uncertainty_m is unsaid.lock_uncertainty_m is None
    assert (unsaid.unlock_static_m, unsaid.lock_static_m) == pytest.approx((said.unlock_static_m, said.lock_static_m))
    for name in ("sigma_m", "low_m", "high_m"):
        assert getattr(unsaid, f"unlock_static_{name}") is getattr(unsaid, f"lock_static_{name}") is None


def turn_locks_later(world, delay_s):
    """The Car reacts so much later than the key comes to its places."""
    at_once = world.turn_locks

    def later(locked, time_s, source):
        if source == "late":
            at_once(locked, time_s, PASSIVE_ENTRY)
        else:
            world.foreign.append((time_s + delay_s, locked, "late"))
    world.turn_locks = later


def test_reaction_to_a_key_that_has_come_to_a_stand_tells_nothing_of_its_speed(run_scenario, world):
    turn_locks_later(world, 0.5)
    # The approach ends 0.1 m behind the boundary: the fast one before the Car has reacted, the slow one after.
    result = run_scenario(SCENARIO, replace(TWO, minimum_distance_m=1.4))[0]
    assert result.unlock_pass_distances_m == pytest.approx((1.4, 1.45), abs=0.02)
    assert result.unlock_pass_speeds_mps == pytest.approx((0.0, 0.1), abs=1e-5)
    assert (result.unlock_passes, result.unlock_static_m) == (2, None)
    assert result.lock_static_m is not None


def test_reaction_to_a_key_that_stands_at_the_end_of_its_way_is_not_taken_for_one_between_steps(run_scenario, world):
    turn_locks_later(world, 1.0)
    # The retreat ends 0.1 m behind the boundary, and the Car locks 1 s after the key has left it: the key stands.
    stepped = replace(TWO, passes=1, measuring_speeds_mps=None, last_step_m=0.05, straightening_distance_m=1.4,
                      measuring_speed_mps=0.4)
    result = run_scenario(SCENARIO, stepped)[0]
    assert result.lock_distance_m is not None and result.lock_speed_mps == pytest.approx(0.0, abs=1e-3)
    assert result.lock_static_m is None


def test_reaction_to_a_key_that_hardly_moves_is_not_taken_for_one_to_a_key_that_stood_between_steps():
    stepped = replace(TWO, passes=1, measuring_speeds_mps=None, last_step_m=0.05)
    with_hardly, with_none = axis((1.3, 1.2, 1.45), (0.4, 0.01, 0.0)), axis((1.3, 1.45), (0.4, 0.0))
    assert read(with_hardly, stepped).distances == read(with_none, stepped).distances
    assert read(axis((1.3, 1.2), (0.4, 0.01)), stepped).unlock_static_m is None


def test_passes_are_recorded_as_the_first_ones_distance_and_to_micrometres_per_second(run_scenario):
    result = run_scenario(SCENARIO, replace(TWO, measuring_speeds_mps=(0.4123456789, 0.1)))[0]
    assert result.unlock_pass_speeds_mps == result.lock_pass_speeds_mps == (0.412346, 0.1)
    assert result.unlock_pass_distances_m[0] == result.unlock_distance_m == round(result.unlock_distance_m, 6)
    assert result.lock_pass_distances_m[0] == result.lock_distance_m == round(result.lock_distance_m, 6)


# Speeds and forecast


def test_single_pass_has_the_speed_that_is_given():
    assert pass_speeds(AutolockParameters(maximum_speed_mps=0.7), 0.2) == (0.7,)
    assert pass_speeds(AutolockParameters(measuring_speed_mps=0.3), 0.2) == (0.3,)
    assert pass_speeds(AutolockParameters(measuring_speeds_mps=(0.3,)), 0.2) == (0.3,)


def test_axes_that_are_measured_say_how_wide_the_intervals_of_the_others_will_be():
    wide = replace(axis((1.3,), (0.4,)), unlock_static_m=1.5, unlock_static_low_m=1.3, unlock_static_high_m=1.7,
                   lock_static_m=2.5, lock_static_low_m=2.45, lock_static_high_m=2.55)
    forecast = SCENARIO.forecast(TWO, LockFacts(told_every_s=0.2), [wide])
    assert forecast.interval_m == pytest.approx((0.05, 0.2))
    nowhere = replace(wide, unlock_static_m=None, unlock_static_low_m=None, unlock_static_high_m=None)
    assert SCENARIO.forecast(TWO, LockFacts(told_every_s=0.2), [nowhere]).interval_m == pytest.approx((0.05, 0.05))


def unlocked(status):
    """An axis that ended so, and on which nothing locked the Car."""
    return AutolockResult(1, "front", 2.25, 0.0, 1.0, 0.0, status, None, None, None, LineStatus.NOT_REACHED, None, None,
                          None, "")


def test_boundary_that_was_not_reached_lies_beyond_the_end_of_its_way():
    assert SCENARIO.unreached(TWO, unlocked(LineStatus.NOT_REACHED), "unlock") == (None, 0.5)
    assert SCENARIO.unreached(TWO, unlocked(LineStatus.OK), "lock") == (3.5, None)


@pytest.mark.parametrize("status", [LineStatus.NOT_REACHED, LineStatus.INVALID])
def test_car_that_never_unlocked_tells_nothing_of_where_it_locks(status):
    result, lines = unlocked(status), SCENARIO.lines(TWO, CarDimensions(4.5, 1.8, 0.02, 0.01))[:1]
    assert line_text(SCENARIO, result, TWO).endswith("lock not reached")
    limits = limits_from({"limits": [{"what": "lock", "at_least_m": 1.5}, {"what": "lock", "at_most_m": 3.4}]})
    circumstances = Circumstances(unreached=lambda result, word: SCENARIO.unreached(TWO, result, word))
    found = judge(limits, lines, [result], circumstances)
    assert [each.verdict for each in found.judgements] == 2 * [Verdict.INCONCLUSIVE]
    assert found.reason_of(1) == "It was not reached, and the line does not tell on which side of the limit it lies."
    assert found.undecided() == []
