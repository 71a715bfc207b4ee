"""Looks at a line: all together err as rarely as one, whatever their sequence."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import math

import numpy as np
import pytest

from mtr_operator.domain.estimation.interval import SIGMAS_OF_LEVEL
from mtr_operator.domain.estimation.looks import (
    ERROR_PER_SIDE,
    Look,
    are_possible,
    confidence_percent,
    deviate,
    is_spent,
    last_look,
    with_look,
)

EVERY_8 = tuple(range(24, 73, 8))


def looks_at(attempts, most):
    looks = ()
    for count in attempts:
        looks = with_look(looks, count / most)
    return looks


def deviates(attempts, most):
    return [deviate(looks_at(attempts[:number + 1], most)) for number in range(len(attempts))]


def test_deviates_of_the_usual_sequence():
    assert deviates(EVERY_8, 72) == pytest.approx([2.77, 2.70, 2.58, 2.46, 2.35, 2.26, 2.16], abs=0.01)


@pytest.mark.parametrize(("attempts", "most", "first"), [((11,), 72, 3.25), ((24,), 72, 2.77), ((2,), 16, 3.36),
                                                         ((9,), 600, 4.39), ((1,), 1000, 5.45)])
def test_first_look_is_the_stricter_the_less_it_rests_on(attempts, most, first):
    assert deviate(looks_at(attempts, most)) == pytest.approx(first, abs=0.01)


def test_one_look_alone_is_by_the_95_percent_interval():
    assert deviate(()) == SIGMAS_OF_LEVEL
    assert deviate(last_look(looks_at((24,), 72))) == pytest.approx(SIGMAS_OF_LEVEL, abs=1e-4)
    assert confidence_percent(last_look(looks_at((24,), 72))) == pytest.approx(95.0, abs=1e-3)


@pytest.mark.parametrize(("attempts", "most"), [
    (EVERY_8, 72), ((9, 17, 25, 33, 41, 49, 57, 65, 72), 72), ((24, 72), 72), ((24, 25, 26, 72), 72),
    (tuple(range(2, 17)), 16), ((24, 32), 72), ((24, 32, 40), 72), ((6,), 18), ((70, 71, 72), 72), ((1, 72), 72)])
def test_all_looks_together_pass_and_fail_wrongly_as_rarely_as_one(attempts, most):
    """A Brownian motion, as the score of a Car at its limit; the last look takes what is left."""
    looks = looks_at(attempts, most)
    limits = [*deviates(attempts, most)[:-1], deviate(last_look(looks))]
    shares = np.array([look.share for look in looks])
    steps = np.random.default_rng(1).standard_normal((200_000, len(shares))) * np.sqrt(np.diff(shares, prepend=0.0))
    scores = np.cumsum(steps, axis=1) / np.sqrt(shares)
    is_end = np.abs(scores) > limits
    first = np.argmax(is_end, axis=1)
    ends = np.where(np.any(is_end, axis=1), scores[np.arange(len(first)), first], 0.0)
    for wrong in (np.mean(ends > 0.0), np.mean(ends < 0.0)):
        assert wrong == pytest.approx(ERROR_PER_SIDE, abs=4.5 * math.sqrt(ERROR_PER_SIDE / len(ends)))


def test_same_attempts_once_more_are_no_other_look():
    looks = looks_at((24, 32), 72)
    assert with_look(looks, 32 / 72) == looks and with_look(looks, 0.1) == looks


def test_after_the_last_look_nothing_is_left_to_decide_with():
    spent = last_look(looks_at((24, 32), 72))
    assert is_spent(spent) and not is_spent(looks_at((24, 32), 72)) and not is_spent(())
    assert math.isinf(deviate(with_look(spent, 40 / 72)))
    assert last_look(()) == ()


def test_most_attempts_spend_everything_and_more_than_most_are_no_more():
    assert is_spent(looks_at((24, 72), 72)) and with_look((), 1.5) == (Look(1.0, ERROR_PER_SIDE),)


@pytest.mark.parametrize("looks", [
    (Look(0.0, 0.0),), (Look(0.5, 0.01), Look(0.5, 0.02)), (Look(0.5, 0.02), Look(0.6, 0.01)), (Look(1.1, 0.01),),
    (Look(0.5, 0.03),), (Look(-0.5, 0.01),), (Look(math.nan, 0.01),), (Look(0.5, math.nan),),
    (Look(math.inf, math.inf),), (Look(0.5, -0.01),)])
def test_looks_of_a_file_that_cannot_be_are_refused(looks):
    assert not are_possible(looks)


@pytest.mark.parametrize("looks", [(), looks_at(EVERY_8, 72), last_look(looks_at((2, 3), 16))])
def test_looks_of_a_test_are_possible(looks):
    assert are_possible(looks)
