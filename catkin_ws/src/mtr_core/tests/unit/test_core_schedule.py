"""Ticks of a slot."""
# SPDX-License-Identifier: Apache-2.0
import pytest

from mtr_core import schedule
from mtr_core.schedule import CLOCK_STEP, SIMULATION_START_NS, Slot, slot

SLOTS = {name: value for name, value in vars(schedule).items() if isinstance(value, Slot)}


def test_tick_itself_is_the_last_one_and_not_the_next():
    assert slot(100, 20).last_at(1_020_000_000) == 1_020_000_000
    assert slot(100, 20).next_after(1_020_000_000) == 1_120_000_000


def test_nanosecond_before_a_tick_belongs_to_the_tick_before():
    assert slot(100, 20).last_at(1_019_999_999) == 920_000_000
    assert slot(100, 20).next_after(1_019_999_999) == 1_020_000_000


def test_last_tick_before_the_phase_is_negative():
    assert slot(100, 20).last_at(0) == -80_000_000


@pytest.mark.parametrize("name", sorted(SLOTS))
def test_period_and_phase_are_multiples_of_the_clock_step(name):
    assert SLOTS[name].period_ns % CLOCK_STEP.period_ns == 0
    assert SLOTS[name].phase_ns % CLOCK_STEP.period_ns == 0
    assert 0 <= SLOTS[name].phase_ns < SLOTS[name].period_ns


def test_simulated_clock_starts_at_a_clock_step_that_is_not_zero():
    assert SIMULATION_START_NS > 0
    assert CLOCK_STEP.last_at(SIMULATION_START_NS) == SIMULATION_START_NS
