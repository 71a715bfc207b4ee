"""Faults of the IMU in another robot's bag are reported with the option to replay without it."""
# SPDX-License-Identifier: Apache-2.0
import math

import numpy as np
import pytest

from mtr_localization.any_bag.errors import BagUnusable
from mtr_localization.any_bag.imu_check import ImuCheck
from mtr_localization.any_bag.turn_lag import rates_of

BEGIN_S, DURATION_S, RATE_HZ = 1000.0, 45.0, 50.0
GRAVITY = (0.0, 0.0, 9.81)
NOISE = np.random.default_rng(1).normal(0.0, 0.002, 10000)


def turn_rate(time_s):
    """Return turns of different lengths, in rad/s."""
    return 0.5 * math.sin(0.45 * time_s) + 0.4 * math.sin(0.17 * time_s * (1.0 + 0.02 * time_s))


def odometry():
    """Return turn rates of the wheels."""
    return rates_of([(BEGIN_S + t, turn_rate(t)) for t in np.arange(0.0, DURATION_S, 0.02)])


def faults(stamp=lambda t: BEGIN_S + t, rate=turn_rate, rate_hz=RATE_HZ, is_there=lambda _: True, noise=1.0):
    """Return sentences about an IMU with these stamps and values."""
    check = ImuCheck("/imu")
    for number, t in enumerate(np.arange(0.0, DURATION_S, 1.0 / rate_hz)):
        if is_there(t):
            check.add(stamp(t), (0.0, 0.0, rate(t) + noise * NOISE[number]), GRAVITY)
    return check.faults("/odom", odometry())


@pytest.mark.parametrize(("change", "words"), [
    ({"stamp": lambda t: BEGIN_S - 900.0 + t}, "stamps of /imu are 900.00 s early compared with /odom"),
    ({"stamp": lambda t: BEGIN_S + 1e6 + t}, "1000000.00 s late"),
    ({"stamp": lambda t: BEGIN_S + 4.0 + t}, "4.00 s late"), ({"stamp": lambda t: BEGIN_S - 0.7 + t}, "0.70 s early"),
    ({"stamp": lambda t: BEGIN_S + 0.5 + t}, "0.50 s late"), ({"stamp": lambda t: BEGIN_S - 12.0 + t}, "12.00 s early"),
    ({"stamp": lambda t: BEGIN_S + 4.0 + t, "rate_hz": 5.0}, "4.00 s late"),
    ({"stamp": lambda _: 0.0}, "2250 of 2250 messages of /imu have the stamp 0"),
    ({"stamp": lambda t: BEGIN_S + t if t > 30.0 else 0.0}, "1501 of 2250 messages of /imu have the stamp 0"),
    ({"rate": lambda _: math.nan}, "not numbers"), ({"rate": lambda t: 57.3 * turn_rate(t)}, "degrees per second"),
    ({"rate": lambda _: 0.0, "noise": 0.0}, "repeats the same values"),
    ({"rate": lambda _: 0.3, "noise": 0.0}, "repeats the same values"),
    ({"rate": lambda t: turn_rate(min(t, 5.0)), "noise": 0.0}, "repeats the same values"),
    ({"rate": lambda t: turn_rate(min(t, 35.0)), "noise": 0.0}, "repeats the same values")])
def test_imu_that_cannot_be_used_is_refused(change, words):
    with pytest.raises(BagUnusable, match=words) as caught:
        faults(**change)
    assert str(caught.value).endswith("or replay with --imu none.") and len(str(caught.value).split()) <= 30


@pytest.mark.parametrize(("is_there", "words"), [
    (lambda t: t < 5.0, "is silent for 40.0 s of the 45.0 s of /odom"), (lambda t: t > 10.0, "is silent for 10.0 s"),
    (lambda t: not 20.0 < t < 25.0, "is silent for 5.0 s"), (lambda _: False, "has 0 messages")])
def test_imu_that_is_missing_for_a_part_is_named(is_there, words):
    sentences = faults(is_there=is_there)
    assert len(sentences) == 1 and words in sentences[0] and "--imu none" in sentences[0]


@pytest.mark.parametrize("change", [
    {}, {"noise": 0.0}, {"rate_hz": 10.0}, {"rate_hz": 100.0}, {"stamp": lambda t: BEGIN_S + 0.1 + t},
    {"rate": lambda t: -turn_rate(t)}, {"rate": lambda t: 1.3 * turn_rate(t) + 0.05},
    {"is_there": lambda t: t > 0.5},
    {"stamp": lambda t: BEGIN_S + t if t > 1.0 else 0.0, "is_there": lambda t: t > 0.5}])
def test_imu_that_can_be_used_needs_no_remark(change):
    assert faults(**change) == []


def test_message_without_a_stamp_is_left_out():
    check = ImuCheck("/imu")
    assert not check.add(0.0, (0.0, 0.0, 0.1), GRAVITY) and check.add(BEGIN_S, (0.0, 0.0, 0.1), GRAVITY)
