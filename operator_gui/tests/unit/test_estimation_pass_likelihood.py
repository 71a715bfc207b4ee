"""What passes make of a boundary: the table of each hypothesis, with a timer that starts again or without."""
# SPDX-License-Identifier: Apache-2.0
import numpy as np
import pytest

from mtr_operator.domain.estimation.passes import likelihood
from mtr_operator.domain.estimation.passes.likelihood import ALL_TIMINGS, Circumstances, Pass, likelihood_of
from mtr_operator.domain.estimation.passes.timing import TIMINGS, has_timer

SLOW_TIMINGS = tuple(number for number, timing in enumerate(TIMINGS) if timing.polled_s > 0.8)
PASSES = (Pass(1.2, 0.4), Pass(1.4, 0.13))
# With no timer at all, with one in some of the hypotheses, and in all of them.
REACTIONS_S = (0.2, 0.4, 0.6), (0.3, 1.4, 2.5), (4.0, 5.0, 6.0)


def by_hypothesis(each, boundary_m, given, timings):
    """The same, one hypothesis after the other."""
    number = round(np.log(each.speed_mps) / np.log(1.06))
    rows = []
    for timing in timings:
        for reaction_s in given.reactions_s:
            is_timer = bool(has_timer(np.array([reaction_s]))[timing, 0])
            table = likelihood._pass_table(number, given.cycle_s, given.sigma_m, is_timer)
            late_m = (each.along_m - boundary_m - each.speed_mps * np.array([[reaction_s]])) * (
                1.06 ** number / each.speed_mps)
            rows.append(table[timing][likelihood._bins(late_m)[0]])
    return np.array(rows).reshape(len(timings), len(given.reactions_s), -1)


@pytest.mark.parametrize("timings", [ALL_TIMINGS, SLOW_TIMINGS])
@pytest.mark.parametrize("reactions_s", REACTIONS_S)
def test_likelihood_is_that_of_each_hypothesis_to_the_last_bit(reactions_s, timings):
    given = Circumstances(0.1, 0.003, reactions_s)
    boundary_m, log = likelihood_of(PASSES, given, timings)
    first, second = (by_hypothesis(each, boundary_m, given, timings) for each in PASSES)
    assert np.array_equal(log, first + second)


def test_slow_reactions_are_where_a_timer_starts_again():
    is_timer = has_timer(np.array([0.3, 1.4, 2.5, 5.0]))
    assert not is_timer[:, 0].any() and is_timer[:, 3].all()
    assert 0 < is_timer[:, 1].sum() < len(TIMINGS)
