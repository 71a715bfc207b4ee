"""Missing inputs at the start cause a warning only if they persist."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.quiet_log import QUIET_S, QuietStart, Throttle

BEGIN_S = 1000.0


def test_what_is_missing_at_the_start_is_a_warning_only_when_it_lasts():
    start = QuietStart()
    assert [start.warns(BEGIN_S + after_s, is_good=False) for after_s in (0.0, QUIET_S - 0.1, QUIET_S, 2.0 * QUIET_S)] \
        == [False, False, True, True]


def test_after_everything_was_good_each_fault_is_a_warning_at_once():
    start = QuietStart()
    start.warns(BEGIN_S, is_good=False)
    start.warns(BEGIN_S + 0.1, is_good=True)
    assert start.warns(BEGIN_S + 0.2, is_good=False)


def test_flood_of_different_messages_is_one_line_of_log_per_kind():  # D4
    throttle = Throttle(10.0)
    said = [throttle.passed("bad", f"A message of {size} bytes.", 0.0005 * size) for size in range(10_000)]
    assert len([sentence for sentence in said if sentence]) == 1 and throttle.passed("other", "x", 5.0) == "x"
    assert throttle.passed("bad", "Once more.", 10.0) == "Once more. (9999 more of this kind before.)"
