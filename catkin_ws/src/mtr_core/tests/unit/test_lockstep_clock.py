"""The steady clock of the nodes on the robot's own time."""
# SPDX-License-Identifier: Apache-2.0
import time

from mtr_core.lockstep import clock

SUSPENDED_NS = 3600 * 1_000_000_000


def test_time_for_which_the_machine_was_suspended_counts_as_age(monkeypatch):  # A1, A10
    monkeypatch.setattr(clock, "is_simulated", lambda: False)
    read, before = time.clock_gettime_ns, (clock.steady_ns(), clock.steady_at(0))
    # What Linux shows after it was suspended: CLOCK_MONOTONIC has stood meanwhile, CLOCK_BOOTTIME has not.
    monkeypatch.setattr(time, "clock_gettime_ns",
                        lambda which: read(which) + (SUSPENDED_NS if which == time.CLOCK_BOOTTIME else 0))
    assert clock.steady_ns() - before[0] >= SUSPENDED_NS
    assert clock.steady_at(0) - before[1] >= SUSPENDED_NS
