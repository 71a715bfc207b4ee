"""Dead time and braking of simulated bases, from the commands and the wheels' odometry."""
# SPDX-License-Identifier: Apache-2.0
import math
from collections import deque

import numpy as np
import pytest

from mtr_commissioning.preflight.expected import Setup
from mtr_motion_check.finding import NEEDS_MORE
from mtr_motion_check.recording import Recording, SentSample, WheelSample
from mtr_motion_check.response import brakings, response, response_findings

TICK_S = 0.02
# Stamp of the wheels before the next command: the two are not synchronous.
STAMPED_BEFORE_S = 0.007
REACTION_S = Setup().reaction_s


def commands(peak_mps, ramp_mps2=1.5, brakes=2, sign=1.0, steady_s=1.2):
    """Yield drive control's commands: rest, a ramp up at 1 m/s2, steady, a ramp down, rest; repeated `brakes` times."""
    for _ in range(brakes):
        speed, wanted = 0.0, [0.0] * 20 + [peak_mps] * round((peak_mps / 1.0 + steady_s) / TICK_S) + [0.0] * 80
        for target in wanted:
            speed += min(max(target - speed, -ramp_mps2 * TICK_S), 1.0 * TICK_S)
            yield sign * speed


def driven(dead_time_s, braking_mps2=3.0, *, lag_s=0.0, noise_mps=0.005, seed=1, **kind):
    """Return the recording of a base that follows commands later, with its own limit, and optionally a first-order
    lag."""
    recording, rng = Recording(), np.random.default_rng(seed)
    step_s, wheels = 0.002, 0.0
    waiting = deque([0.0] * round(dead_time_s / step_s))
    lagged = 0.0
    for tick, sent in enumerate(commands(**{"peak_mps": 0.4, **kind})):
        recording.sent.append(SentSample(100.0 + tick * TICK_S, sent))
        for _ in range(round(TICK_S / step_s)):
            waiting.append(sent)
            wanted = waiting.popleft()
            lagged = wanted if not lag_s else lagged + (wanted - lagged) * step_s / lag_s
            wheels += min(max(lagged - wheels, -braking_mps2 * step_s), braking_mps2 * step_s)
        recording.wheels.append(WheelSample(100.0 + (tick + 1) * TICK_S - STAMPED_BEFORE_S,
                                            wheels + rng.normal(0.0, noise_mps), 0.0))
    return recording


def found_of(recording):
    return response(brakings(recording.sent, recording.wheels))


@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("dead_time_s", [0.0, 0.06, 0.1, 0.15, 0.2, 0.3, 0.45])
@pytest.mark.parametrize("kind", [{}, {"peak_mps": 0.75}, {"sign": -1.0}, {"ramp_mps2": 0.8}, {"ramp_mps2": 60.0},
                                  {"noise_mps": 0.015}, {"brakes": 1}])
def test_dead_time_is_measured(dead_time_s, kind, seed):
    found = found_of(driven(dead_time_s, **{"braking_mps2": 80.0 if "ramp_mps2" in kind else 3.0, **kind}, seed=seed))
    # Velocities are constant between two commands, which the wheels' stamps shift by half a tick.
    assert found.dead_time_s == pytest.approx(dead_time_s, abs=0.02)


@pytest.mark.parametrize("dead_time_s", [0.06, 0.2])
@pytest.mark.parametrize("braking_mps2", [0.3, 0.5, 0.8, 1.1])
def test_weak_brakes_are_measured_beside_the_dead_time(dead_time_s, braking_mps2):
    found = found_of(driven(dead_time_s, braking_mps2))
    assert found.braking_mps2 == pytest.approx(braking_mps2, rel=0.12)
    assert found.dead_time_s == pytest.approx(dead_time_s, abs=0.03)
    assert found.sent_mps2 == pytest.approx(1.5, rel=0.1)


@pytest.mark.parametrize("braking_mps2", [1.5, 2.0, 10.0])
def test_base_that_follows_the_ramp_brakes_as_sent(braking_mps2):
    assert found_of(driven(0.06, braking_mps2)).braking_mps2 > 1.3


def verdict(recording, reaction_s=REACTION_S):
    """Return sentences of bad findings, and all their checks."""
    found = response_findings(recording, reaction_s)
    return [each.text for each in found if each.is_bad], {each.check for each in found}


def test_simulated_base_is_good():
    assert verdict(driven(0.06)) == ([], {"motion.response"})
    assert verdict(driven(0.0, lag_s=0.06)) == ([], {"motion.response"})


@pytest.mark.parametrize("dead_time_s", [0.15, 0.2, 0.3])
def test_late_base_fails_with_the_value_to_set_and_passes_with_it(dead_time_s):
    sentences, _ = verdict(driven(dead_time_s))
    assert len(sentences) == 1 and "set reaction_s" in sentences[0]
    to_set = float(sentences[0].partition("set reaction_s of drive control to ")[2].partition(" s")[0])
    assert dead_time_s < to_set < dead_time_s + 0.06
    assert verdict(driven(dead_time_s, seed=2), to_set)[0] == []


def test_base_later_than_any_reaction_time_is_to_be_mended():
    assert "remove the delay" in verdict(driven(0.52))[0][0]


def test_weak_base_fails_with_both_decelerations():
    sentences, _ = verdict(driven(0.06, 0.6))
    assert len(sentences) == 1 and "brakes at 0.6" in sentences[0] and "linear_deceleration_mps2" in sentences[0]


@pytest.mark.parametrize("recording", [
    Recording(), driven(0.06, brakes=0), driven(0.06, peak_mps=0.1), driven(0.06, steady_s=0.05, brakes=1),
    Recording(sent=driven(0.06).sent), Recording(wheels=driven(0.06).wheels)],
    ids=["nothing", "at_rest", "too_slow", "not_steady", "no_odometry", "no_commands"])
def test_drive_without_a_braking_needs_more(recording):
    assert verdict(recording)[1] == {NEEDS_MORE}


def test_wheels_that_do_something_else_need_more():
    recording = driven(0.06)
    recording.wheels = [sample._replace(linear_mps=0.4 * math.sin(7.0 * sample.time_s)) for sample in recording.wheels]
    sentences, checks = verdict(recording)
    assert checks == {NEEDS_MORE} and "allowed is 0.08" in sentences[0]
