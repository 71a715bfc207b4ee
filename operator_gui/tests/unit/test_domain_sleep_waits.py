"""Which waits tell most of a key's sleep time."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_operator.domain.scenarios.sleep_time.waits import Asleep, WaitPlan, WaitSearch, WaitTrial, tried

PLAN = WaitPlan(shortest_s=30.0, longest_s=1800.0, interval_s=10.0, confirmations=2, trials_limit=24, span_s=3.0)


def search_of(plan, *trials):
    return WaitSearch(plan, [WaitTrial(rest_s, answered) for rest_s, answered in trials])


@pytest.mark.parametrize("sleep_s", [31.0, 60.0, 61.0, 179.0, 300.0, 1799.0])
def test_interval_holds_the_sleep_time_and_is_as_narrow_as_wanted(sleep_s):
    search = WaitSearch(PLAN, tried(PLAN, sleep_s))
    assert search.asleep is Asleep.MEASURED
    assert search.low_s <= sleep_s <= search.high_s <= search.low_s + PLAN.interval_s
    assert sum(rest_s >= search.low_s - PLAN.interval_s for rest_s in search.answered_s) >= PLAN.confirmations
    assert sum(rest_s <= search.high_s + PLAN.interval_s for rest_s in search.unanswered_s) >= PLAN.confirmations
    assert len(search.trials) <= 20


def test_waits_grow_until_the_key_is_silent():
    assert [trial.rest_s for trial in tried(PLAN, 200.0)[:4]] == [30.0, 60.0, 120.0, 243.0]


def test_key_that_never_sleeps_is_awake_for_at_least_the_longest_rest():
    search = WaitSearch(PLAN, tried(PLAN, float("inf")))
    assert search.asleep is Asleep.LATER and (search.low_s, search.high_s) == (1800.0, None)
    assert search.answered_s == [30.0, 60.0, 120.0, 240.0, 480.0, 960.0, 1800.0, 1800.0]


def test_key_that_sleeps_at_once_has_only_an_upper_end():
    search = WaitSearch(PLAN, tried(PLAN, 0.0))
    assert search.asleep is Asleep.SOONER and search.low_s is None
    assert search.high_s <= PLAN.interval_s + PLAN.span_s


def test_answers_that_contradict_each_other_make_the_interval_wide_and_not_false():
    """A key whose sleep time varies from trial to trial: silent after 100 s, answering after 130 s."""
    search = search_of(PLAN, (60.0, True), (130.0, True), (100.0, False), (160.0, False))
    assert (search.low_s, search.high_s) == (60.0, 160.0)
    # What lies between 100 and 130 s stays open: the gaps on both sides are halved until they are narrow.
    while (wait_s := search.next_wait_s()) is not None:
        search.trials.append(WaitTrial(wait_s, wait_s < 115.0))
    assert search.low_s < 100.0 and search.high_s > 130.0
    assert search.high_s - search.low_s <= 2.0 * PLAN.interval_s + 30.0


def test_search_ends_with_the_trials_allowed():
    plan = WaitPlan(30.0, 1800.0, 10.0, 2, 5, 3.0)
    search = WaitSearch(plan, tried(plan, 200.0))
    assert len(search.trials) == 5 and search.low_s <= 200.0 <= search.high_s


def test_nothing_is_known_before_the_first_trial():
    search = WaitSearch(PLAN)
    assert search.asleep is Asleep.UNKNOWN and (search.low_s, search.high_s) == (None, None)
    assert search.next_wait_s() == PLAN.shortest_s
