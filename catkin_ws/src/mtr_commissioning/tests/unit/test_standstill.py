"""An update requires a robot at rest with a stop engaged; silence and unknown values refuse it."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_commissioning.standstill.judge import (
    LEAST_MESSAGES,
    LOCK_AGE_S,
    STANDING_MPS,
    STANDING_RADPS,
    VELOCITY_AGE_S,
    WATCHED_S,
    Lock,
    StandstillJudge,
    Velocity,
    Verdict,
)

NOW_S, PERIOD_S = 100.0, 0.02
REST = (0.0, 0.0)
STOP = Lock(NOW_S - 0.05, True, True)


def judged(commanded=REST, measured=REST, lock=STOP, until_s=NOW_S, count=60):
    """Return the answer after a number of reports of both velocities, the last one at until_s."""
    judge = StandstillJudge()
    for number in reversed(range(count)):
        arrived_s = until_s - number * PERIOD_S
        if commanded is not None:
            judge.take_command(Velocity(arrived_s, *commanded))
        if measured is not None:
            judge.take_odometry(Velocity(arrived_s, *measured))
    if lock is not None:
        judge.take_lock("controller_input", lock)
    return judge.answer(NOW_S)


def test_robot_that_stands_with_a_stop_engaged_may_be_stopped():
    assert judged().verdict is Verdict.MAY_STOP
    noise = (0.9 * STANDING_MPS, -0.9 * STANDING_RADPS)
    assert judged(measured=noise).verdict is Verdict.MAY_STOP


def test_limits_of_rest_are_rest():
    assert judged(measured=(STANDING_MPS, 0.0)).verdict is Verdict.MAY_STOP
    assert judged(measured=(0.0, -STANDING_RADPS)).verdict is Verdict.MAY_STOP


def test_newest_report_counts():
    assert judged(until_s=NOW_S - VELOCITY_AGE_S + 0.5 * PERIOD_S).verdict is Verdict.MAY_STOP


@pytest.mark.parametrize("velocity", [
    (0.02, 0.0), (-0.02, 0.0), (0.0, 0.03), (0.0, -0.03), (math.nan, 0.0), (0.0, math.nan), (math.inf, 0.0)])
def test_robot_that_moves_or_whose_velocity_is_no_number_is_refused(velocity):
    assert judged(commanded=velocity).verdict is Verdict.REFUSED
    assert judged(measured=velocity).verdict is Verdict.REFUSED
    assert "moves at" in judged(measured=velocity).sentence


def test_robot_that_moved_a_moment_ago_is_refused():
    judge = StandstillJudge()
    for number in reversed(range(100)):
        arrived_s = NOW_S - number * PERIOD_S
        moved = NOW_S - arrived_s > 0.8 * WATCHED_S
        judge.take_command(Velocity(arrived_s, 0.3 if moved else 0.0, 0.0))
        judge.take_odometry(Velocity(arrived_s, 0.0, 0.0))
    judge.take_lock("controller_input", STOP)
    assert judge.answer(NOW_S).sentence.startswith("The robot moves at 0.30 m/s")
    assert judge.answer(NOW_S + 0.1).verdict is Verdict.REFUSED


@pytest.mark.parametrize("lock", [
    None, STOP._replace(engaged=False), STOP._replace(emergency=False),
    STOP._replace(arrived_s=NOW_S - LOCK_AGE_S - 0.01), STOP._replace(arrived_s=NOW_S + LOCK_AGE_S + 0.01),
    STOP._replace(arrived_s=math.nan)],
    ids=["no lock", "released", "lock of a node", "silent", "of the future", "without a time"])
def test_robot_without_an_engaged_stop_is_refused(lock):
    assert judged(lock=lock).sentence.startswith("No stop is engaged")


def test_one_of_several_stops_suffices_and_its_newest_word_counts():
    judge = StandstillJudge()
    for number in reversed(range(60)):
        judge.take_command(Velocity(NOW_S - number * PERIOD_S, 0.0, 0.0))
        judge.take_odometry(Velocity(NOW_S - number * PERIOD_S, 0.0, 0.0))
    judge.take_lock("state_machine", STOP._replace(emergency=False))
    judge.take_lock("controller_input", STOP._replace(engaged=False))
    judge.take_lock("hardware", STOP)
    assert judge.answer(NOW_S).verdict is Verdict.MAY_STOP
    judge.take_lock("hardware", STOP._replace(engaged=False))
    assert judge.answer(NOW_S).verdict is Verdict.REFUSED


def test_software_without_drive_control_does_not_answer():
    assert judged(commanded=None).verdict is Verdict.SILENT
    assert judged(until_s=NOW_S - WATCHED_S - 0.1).verdict is Verdict.SILENT
    assert StandstillJudge().answer(NOW_S).verdict is Verdict.SILENT


def test_what_is_silent_or_rare_is_refused():
    assert judged(measured=None).verdict is Verdict.REFUSED
    assert judged(until_s=NOW_S - VELOCITY_AGE_S - 0.01).verdict is Verdict.REFUSED
    assert judged(count=LEAST_MESSAGES - 1).verdict is Verdict.REFUSED
    assert judged(count=LEAST_MESSAGES).verdict is Verdict.MAY_STOP
