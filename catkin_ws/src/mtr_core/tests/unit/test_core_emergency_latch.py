"""Emergency stops whose owners fall silent: the cases of drive control's test_motion_locks.cpp."""
# SPDX-License-Identifier: Apache-2.0
from mtr_core.emergency_latch import EmergencyLatch

OWNER = "controller_input"
PERIOD_S = 0.1


class Owner:
    """An owner that publishes ten times a second."""

    def __init__(self):
        self.latch, self.now_s = EmergencyLatch(0.5), 1.0

    def says(self, engaged, duration_s):
        """Publish for duration_s and return True if the emergency stop then counts as engaged."""
        for _ in range(round(duration_s / PERIOD_S)):
            self.latch.take(OWNER, engaged, self.now_s)
            self.now_s += PERIOD_S
        return OWNER in self.latch


def test_owner_that_was_never_heard_or_engaged_is_not_latched():
    owner = Owner()
    assert OWNER not in owner.latch and not owner.says(False, 1.0)


def test_engaged_one_is_released_by_its_owner():
    owner = Owner()
    assert owner.says(True, 1.0) and not owner.says(False, PERIOD_S)


def test_of_an_owner_that_restarts_and_says_nothing_of_it_stays_engaged():  # A4
    owner = Owner()
    owner.says(True, 1.0)
    owner.now_s += 2.0
    assert owner.says(False, 10.0)


def test_of_an_owner_that_restarted_is_released_after_it_was_engaged_anew():  # A4
    owner = Owner()
    owner.says(True, 1.0)
    owner.now_s += 2.0
    owner.says(False, 1.0)
    assert owner.says(True, 1.0) and not owner.says(False, PERIOD_S)


def test_that_was_released_before_its_owner_restarted_is_forgotten():
    owner = Owner()
    owner.says(True, 1.0)
    owner.says(False, 1.0)
    owner.now_s += 2.0
    assert not owner.says(False, PERIOD_S)
