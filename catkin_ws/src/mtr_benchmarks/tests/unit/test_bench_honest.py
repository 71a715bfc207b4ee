"""Bounds of consistent drives contain drives that are known to be consistent."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from mtr_benchmarks.localization.judging.figures import ratio
from mtr_benchmarks.localization.judging.honest import SAMPLE_S, bounds_of, freedom_of
from mtr_benchmarks.localization.methods.errors import PoseErrors

SECONDS = 240


def drive(whitened):
    stamps = 0.5 * np.arange(len(whitened))
    one = np.ones(len(stamps))
    return PoseErrors(stamps, one, one, whitened, one > 0, one < 0, one)


def honest(noise, lasting):
    """Return errors of variance 1: a share is constant during the drive, and the rest is correlated over ten
    seconds."""
    white = noise.standard_normal((2 * SECONDS, 3))
    kept = np.exp(-0.5 / 10.0)
    fast = np.empty_like(white)
    fast[0] = white[0]
    for i in range(1, len(white)):
        fast[i] = kept * fast[i - 1] + np.sqrt(1.0 - kept ** 2) * white[i]
    return drive(np.sqrt(lasting) * noise.standard_normal(3) + np.sqrt(1.0 - lasting) * fast)


@pytest.mark.parametrize("lasting", [0.0, 0.5, 1.0])
def test_honest_drives_are_within_their_bounds(lasting):
    noise = np.random.default_rng(5)
    drives = [honest(noise, lasting) for _ in range(200)]
    bounds = bounds_of(freedom_of(drives))
    inside = np.mean([bounds.low <= ratio(each.nees) <= bounds.high for each in drives])
    assert 0.9 <= inside <= 0.99


def test_errors_that_last_for_ever_leave_three_degrees_of_freedom_and_white_ones_three_for_each_instant():
    noise = np.random.default_rng(1)
    assert freedom_of([honest(noise, 1.0) for _ in range(100)]) == pytest.approx(3.0, rel=0.01)
    white = [drive(noise.standard_normal((2 * SECONDS, 3))) for _ in range(100)]
    assert freedom_of(white) == pytest.approx(3.0 * SECONDS / SAMPLE_S, rel=0.1)


def test_systems_that_are_too_sure_or_too_cautious_have_the_same_bounds():
    noise = np.random.default_rng(2)
    drives = [honest(noise, 0.5) for _ in range(20)]
    too_sure = [drive(3.0 * each.whitened) for each in drives]
    assert freedom_of(too_sure) == pytest.approx(freedom_of(drives))


def test_the_worst_of_many_is_worse_than_one():
    one, many = bounds_of(20.0), bounds_of(20.0, 80)
    assert many.low < one.low < 1.0 < one.high < many.high


def test_what_is_not_known_has_no_part_and_nothing_known_has_no_bounds():
    noise = np.random.default_rng(3)
    drives = [honest(noise, 0.3) for _ in range(30)]
    for each in drives:
        each.whitened[100:300] = np.nan
    assert 3.0 < freedom_of(drives) < 60.0
    assert freedom_of([drive(np.full((50, 3), np.nan))]) is None and freedom_of([]) is None
