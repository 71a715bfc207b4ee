"""The command line asks whether a robot that is held may go on. A8"""
# SPDX-License-Identifier: Apache-2.0
import os
import time

import pytest

from mtr_operator.cli.release import QUESTION, Release

LIMIT_S = 5.0


@pytest.fixture(name="person")
def person_fixture():
    """What was asked, the object, and where a person types."""
    read_end, write_end = os.pipe()
    asked = []
    with os.fdopen(read_end) as stream, os.fdopen(write_end, "w", buffering=1) as keys:
        yield asked, Release(asked.append, stream), keys
        keys.close()


def released(release, hold_id):
    """What it gives within the limit for this hold."""
    deadline = time.monotonic() + LIMIT_S
    while release(hold_id) != hold_id and time.monotonic() < deadline:
        time.sleep(0.005)
    return release(hold_id)


def test_without_a_hold_nobody_is_asked(person):
    asked, release, _ = person
    assert [release(0) for _ in range(5)] == [0] * 5 and asked == []


def test_robot_is_asked_for_once_and_goes_on_after_enter(person):
    asked, release, keys = person
    assert [release(7) for _ in range(5)] == [0] * 5
    assert asked == [QUESTION]
    keys.write("\n")
    assert released(release, 7) == 7


def test_another_hold_is_another_question(person):
    asked, release, keys = person
    release(7)
    keys.write("\n")
    assert released(release, 7) == 7
    release(8)
    assert release(8) == 7 and asked == [QUESTION] * 2
    keys.write("\n")
    assert released(release, 8) == 8


def test_answer_to_the_question_before_is_none_to_the_present_one(person):
    asked, release, keys = person
    release(7)
    release(8)
    keys.write("\n")
    time.sleep(0.05)
    assert release(8) == 0
    keys.write("\n")
    assert released(release, 8) == 8


def test_end_of_the_input_is_no_answer(person):
    _, release, keys = person
    release(7)
    keys.close()
    time.sleep(0.05)
    assert release(7) == 0
