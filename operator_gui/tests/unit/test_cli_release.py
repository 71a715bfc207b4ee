"""The command line asks whether a robot that is held may go on (A8), and for the Car's handle."""
# SPDX-License-Identifier: Apache-2.0
import os
import time

import pytest

from mtr_operator.cli.enter import Enter
from mtr_operator.cli.handle import HandleQuestion
from mtr_operator.cli.release import QUESTION, Release

LIMIT_S = 5.0


@pytest.fixture(name="stdin")
def stdin_fixture():
    """What was asked, who reads Enter, and where a person types."""
    read_end, write_end = os.pipe()
    with os.fdopen(read_end) as stream, os.fdopen(write_end, "w", buffering=1) as keys:
        yield [], Enter(stream), keys
        keys.close()


@pytest.fixture(name="person")
def person_fixture(stdin):
    """What was asked, the object, and where a person types."""
    asked, enter, keys = stdin
    return asked, Release(asked.append, enter), keys


def within_limit(condition):
    """True as soon as the condition holds."""
    deadline = time.monotonic() + LIMIT_S
    while not condition() and time.monotonic() < deadline:
        time.sleep(0.005)
    return condition()


def released(release, hold_id):
    """What it gives within the limit for this hold."""
    within_limit(lambda: release(hold_id) == hold_id)
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


def test_line_from_before_the_first_question_answers_nothing():
    """The reader is there from the start, and takes the line away."""
    read_end, write_end = os.pipe()
    with os.fdopen(read_end) as stream, os.fdopen(write_end, "w", buffering=1) as keys:
        lines, answered = [], []

        class Seen:
            def readline(self):
                lines.append(stream.readline())
                return lines[-1]
        enter = Enter(Seen())
        keys.write("\n")
        assert within_limit(lambda: lines)
        enter.ask(lambda: answered.append("question"))
        keys.write("\n")
        assert within_limit(lambda: answered) and lines == ["\n", "\n"]
        keys.close()


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


def test_handle_is_asked_for_with_its_distance_and_taken_with_enter(stdin):
    asked, enter, keys = stdin
    person = HandleQuestion(asked.append, enter).person
    person.request(1.5)
    assert "Remote key at 1.50 m, then press Enter" in asked[0] and not person.is_taken()
    keys.write("\n")
    assert within_limit(person.is_taken)
    person.release()
    assert not person.is_taken() and len(asked) == 1


@pytest.mark.parametrize("is_on, word", [(True, "on"), (False, "off")])
def test_extender_is_asked_for_with_its_state_and_switched_with_enter(stdin, is_on, word):
    asked, enter, keys = stdin
    person = HandleQuestion(asked.append, enter).person
    person.switch(is_on)
    assert asked == [f"Switch the extender {word} now, then press Enter."] and not person.is_switched()
    keys.write("\n")
    assert within_limit(person.is_switched)
    person.release()
    assert not person.is_switched()


def test_enter_that_comes_after_the_car_has_unlocked_does_not_take_the_next_handle(stdin):
    asked, enter, keys = stdin
    person = HandleQuestion(asked.append, enter).person
    person.request(1.5)
    person.release()
    keys.write("\n")
    time.sleep(0.05)
    person.request(2.0)
    assert not person.is_taken()
    keys.write("\n")
    assert within_limit(person.is_taken)


def test_robot_that_is_held_while_the_handle_is_asked_for_needs_an_answer_of_its_own(stdin):
    asked, enter, keys = stdin
    person, release = HandleQuestion(asked.append, enter).person, Release(asked.append, enter)
    person.request(1.5)
    release(7)
    keys.write("\n")
    assert within_limit(person.is_taken) and release(7) == 0
    keys.write("\n")
    assert released(release, 7) == 7
