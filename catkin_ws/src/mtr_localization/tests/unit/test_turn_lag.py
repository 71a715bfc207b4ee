"""Stamp offsets are found from the robot's turns; without turns the result is empty."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import math

import numpy as np
import pytest

from mtr_core.se2 import Pose2
from mtr_localization.any_bag.delays import Delays
from mtr_localization.any_bag.errors import BagUnusable
from mtr_localization.any_bag.imu_check import ImuCheck
from mtr_localization.any_bag.input_checks import OdometryClock, ScanCheck, check_odometry, check_scans
from mtr_localization.any_bag.motion import Sample, Sweep
from mtr_localization.any_bag.sources import Asked
from mtr_localization.any_bag.turn_lag import ScanTurns, rates_of, turn_lag

BEGIN_S, DURATION_S = 1000.0, 40.0
HALF_ROOM_M = np.array([4.0, 3.0])


def heading(time_s):
    """Return turns of different lengths, in rad."""
    return 0.9 * math.sin(0.45 * time_s) + 0.5 * math.sin(0.17 * time_s * (1.0 + 0.02 * time_s))


def scan_at(time_s, stamp_s, beams=271, sense=1.0, is_turning=True):
    """Return a scan in a room, from a robot that drives slowly to and fro."""
    angles = np.linspace(-2.3, 2.3, beams)
    directions = sense * angles + (heading(time_s) if is_turning else 0.0)
    place = np.array([1.5 * math.sin(0.1 * time_s), 0.5])
    cosines = np.stack([np.cos(directions), np.sin(directions)], axis=1)
    with np.errstate(divide="ignore"):
        ranges = ((HALF_ROOM_M * np.sign(cosines) - place) / cosines).min(axis=1)
    return Sweep(BEGIN_S + stamp_s, 4.6 / (beams - 1), 0.0, 20.0, ranges)


def odometry(is_turning=True):
    """Return the odometry of the same drive."""
    times_s = np.arange(0.0, DURATION_S, 0.05)
    rates = [(heading(t + 0.025) - heading(t - 0.025)) / 0.05 if is_turning else 0.0 for t in times_s]
    return OdometryClock("/odom", [Sample(BEGIN_S + t, Pose2(0.0, 0.0, 0.0), 0.0, rate)
                                   for t, rate in zip(times_s, rates)], Delays())


def scans_late(offset_s, topic="/scan", rate_hz=10.0, **options):
    """Return a check that has received each scan of the drive."""
    check = ScanCheck(topic, options.get("sense", 1.0))
    for time_s in np.arange(0.0, DURATION_S, 1.0 / rate_hz):
        check.add(scan_at(time_s, time_s + offset_s, **options), 0.0)
    return check


@pytest.mark.parametrize("offset_s", [-5.0, -2.0, -1.0, -0.5, 0.5, 1.0, 3.0, 5.0])
def test_offset_of_scans_is_refused_with_the_option_that_corrects_it(offset_s):
    with pytest.raises(BagUnusable, match="The stamps of /scan are .* compared with /odom") as caught:
        check_scans([scans_late(offset_s)], odometry(), Asked(scan_delay_s=0.5))
    sentence = str(caught.value)
    assert ("late" if offset_s > 0.0 else "early") in sentence and len(sentence.split()) <= 30
    assert float(sentence[:-1].rsplit(maxsplit=1)[-1]) == pytest.approx(0.5 + offset_s, abs=0.1)


@pytest.mark.parametrize("options", [{}, {"rate_hz": 40.0}, {"rate_hz": 5.0}, {"beams": 1081}, {"sense": -1.0}])
@pytest.mark.parametrize("offset_s", [0.0, 0.1, 2.0])
def test_offset_is_found_for_lidars_of_any_kind_and_small_ones_are_accepted(options, offset_s):
    found = scans_late(offset_s, **options).turn_lag(odometry())
    assert found.lag_s == pytest.approx(offset_s, abs=0.1) and found.is_certain is (offset_s > 1.0)


def test_two_lidars_with_different_offsets_cannot_be_corrected_by_one_option():
    with pytest.raises(BagUnusable, match="/b are 2.* late .*--front-scan /a alone"):
        check_scans([scans_late(0.0, "/a"), scans_late(2.0, "/b")], odometry(), Asked())


@pytest.mark.parametrize(("scans_s", "imu_s", "is_odometry"), [
    (3.0, 3.0, True), (-2.0, -2.0, True), (3.0, 0.0, False), (0.0, 3.0, False), (0.0, 0.0, False), (3.0, -2.0, False)])
def test_odometry_is_named_when_scans_and_imu_agree(scans_s, imu_s, is_odometry):
    imu = ImuCheck("/imu")
    for sample_s, rate in zip(*odometry().turns):
        imu.add(sample_s + imu_s, (0.0, 0.0, rate), (0.0, 0.0, 9.81))
    side = "early" if scans_s > 0.0 else "late"
    with pytest.raises(BagUnusable, match=f"stamps of /odom are {abs(scans_s):.2f} s {side}") if is_odometry else (
            contextlib.nullcontext()):
        check_odometry([scans_late(scans_s)], imu, odometry())


def test_without_turns_nothing_is_claimed():
    assert scans_late(2.0, is_turning=False).turn_lag(odometry(is_turning=False)) is None
    check_scans([scans_late(2.0, is_turning=False)], odometry(is_turning=False), Asked())


def test_turns_that_repeat_do_not_exclude_an_offset_of_zero():
    times_s = np.arange(0.0, 60.0, 0.05)
    rates = rates_of([(t, math.sin(2.0 * math.pi * t / 4.0)) for t in times_s])
    assert not turn_lag(rates, rates).is_certain


@pytest.mark.parametrize("samples", [
    [], [(1.0, 0.1)], [(t, 0.1) for t in range(60)], [(t, math.nan) for t in range(60)]])
def test_few_constant_or_missing_rates_show_nothing(samples):
    assert turn_lag(odometry().turns, rates_of(samples)) is None


def test_scans_without_echoes_show_no_turn():
    turns = ScanTurns(1.0)
    for time_s in np.arange(0.0, DURATION_S, 0.1):
        scan = scan_at(time_s, time_s)
        turns.add(scan._replace(ranges=[math.inf] * len(scan.ranges)))
    assert len(turns.rates.times_s) == 0
