"""The dead-man switch, the emergency stop, the lift and lost controllers."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_controller_input.core import RELEASED, Controller, Joy, Outcome, velocity
from mtr_controller_input.parameters import Parameters
from mtr_core.errors import ConfigurationError
from mtr_core.problems import NO_PROBLEM, Problem

PARAMETERS = Parameters()
SLOW_BUTTON, FAST_BUTTON, E_STOP, SHARE, OPTIONS = 4, 5, 1, 8, 9
TICK_S = 0.04


def buttons(*held):
    return tuple(int(index in held) for index in range(12))


def sticks(forward=0.0, left=0.0, lift=0.0):
    return (left, forward, 0.0, 0.0, 0.0, 0.0, 0.0, lift)


NONE, SLOW, FAST = buttons(), buttons(SLOW_BUTTON), buttons(FAST_BUTTON)
IDLE = Joy(sticks(), NONE)
DRIVING = Joy(sticks(forward=1.0), SLOW)
RELEASING = Joy(sticks(), buttons(SHARE, OPTIONS))


class Hand:
    """A controller in a hand: its driver repeats the state, and each repetition is a tick."""

    def __init__(self, parameters=PARAMETERS):
        self.controller, self.now_s, self._wobble = Controller(parameters), 100.0, 0.0
        self.hold(RELEASING, parameters.release_after_s + 2 * TICK_S)

    def hold(self, joy, duration_s=TICK_S, still=False):
        """Return the last outcome while this state is held; a stick in a hand trembles slightly."""
        for _ in range(round(duration_s / TICK_S)):
            self.now_s += TICK_S
            self._wobble = 0.0 if still else 0.01 - self._wobble
            self.controller.take(Joy((*joy.axes[:2], self._wobble, *joy.axes[3:]), joy.buttons), self.now_s)
            outcome = self.controller.step(self.now_s)
        return outcome

    def play_back(self, joy, age_s, duration_s=1.0):
        """Return the last outcome while a recording is played at twice the rate of the driver's released controller."""
        for _ in range(round(duration_s / TICK_S)):
            self.hold(IDLE)
            for _ in range(2):
                self.controller.take(joy, self.now_s, age_s)
            outcome = self.controller.step(self.now_s)
            assert not outcome.velocity.active and not outcome.lift_mps
        return outcome

    def pull_the_plug(self, duration_s):
        """Return the outcome after a time without messages."""
        self.now_s += duration_s
        return self.controller.step(self.now_s)


def test_without_a_dead_man_button_nothing_is_wanted():
    assert velocity(PARAMETERS, sticks(1.0, 1.0), NONE) == RELEASED


@pytest.mark.parametrize("held, linear, angular", [(SLOW, 0.4, 0.6), (FAST, 0.75, 1.2),
                                                   (buttons(SLOW_BUTTON, FAST_BUTTON), 0.75, 1.2)])
def test_full_deflection_gives_the_velocity_of_the_button(held, linear, angular):
    assert velocity(PARAMETERS, sticks(1.0, 1.0), held) == (linear, angular, True)


def test_held_button_without_deflection_holds_the_robot():
    assert velocity(PARAMETERS, sticks(0.04, -0.04), SLOW) == (0.0, 0.0, True)


@pytest.mark.parametrize("axes", [(), (math.nan, math.inf), (0.0,)])
def test_missing_or_broken_axis_counts_as_released(axes):
    assert velocity(PARAMETERS, axes, SLOW)[:2] == (0.0, 0.0)


def test_deflection_beyond_one_is_one():
    assert velocity(PARAMETERS, sticks(3.0, -3.0), SLOW) == (0.4, -0.6, True)


def test_controller_without_the_button_counts_as_released():
    assert velocity(PARAMETERS, sticks(1.0), (1,)) == RELEASED


def released():
    """Return a controller whose emergency stop was released before time 0."""
    controller = Controller(PARAMETERS)
    for now_s in (-2.0, -1.0):
        controller.take(RELEASING, now_s)
        controller.step(now_s)
    return controller


def test_controller_that_was_never_heard_locks():  # A4
    assert "has not been heard" in Controller(PARAMETERS).step(1e6).lock_reason.text


def test_controller_that_was_just_started_locks_until_it_is_released_on_purpose():  # A4
    controller = Controller(PARAMETERS)
    for joy, duration_s in ((IDLE, 3.0), (DRIVING, 3.0), (RELEASING, PARAMETERS.release_after_s / 2.0), (IDLE, 1.0)):
        for tick in range(round(duration_s / TICK_S)):
            controller.take(joy, tick * TICK_S)
            assert "was started" in controller.step(tick * TICK_S).lock_reason.text
    for tick in range(round((PARAMETERS.release_after_s + 2 * TICK_S) / TICK_S)):
        controller.take(RELEASING, tick * TICK_S)
        outcome = controller.step(tick * TICK_S)
    assert not outcome.lock_reason


def test_person_drives_while_the_button_is_held_and_hands_back_when_it_is_released():
    hand = Hand()
    assert hand.hold(DRIVING, 1.0) == Outcome(velocity=(0.4, 0.0, True))
    assert hand.hold(IDLE) == Outcome()


def test_silent_controller_locks_and_stays_locked_until_it_is_back_and_released():
    hand = Hand()
    hand.hold(DRIVING, 1.0)
    assert not hand.pull_the_plug(0.1).lock_reason
    lost = hand.pull_the_plug(0.02)
    assert lost.velocity == RELEASED
    assert "lost" in lost.lock_reason.text
    assert hand.hold(DRIVING, 1.0).lock_reason
    assert hand.hold(IDLE) == Outcome()


def test_idle_controller_that_is_unplugged_is_a_lost_emergency_stop():
    hand = Hand()
    hand.hold(IDLE, 1.0)
    assert hand.pull_the_plug(0.2).lock_reason


def test_controller_whose_device_is_gone_is_lost_though_its_driver_repeats_the_last_message():
    hand = Hand()
    hand.hold(DRIVING, 1.0)
    assert "lost" in hand.controller.step(hand.now_s, is_present=False).lock_reason.text


def test_drive_that_never_changes_is_a_lost_controller():
    hand = Hand()
    assert hand.hold(DRIVING, 1.9, still=True).velocity.active
    assert "does not change" in hand.hold(DRIVING, 0.3, still=True).lock_reason.text
    assert hand.hold(DRIVING, 0.3).lock_reason
    assert hand.hold(IDLE) == Outcome()


def test_idle_controller_that_is_present_may_be_still():
    """Its reports determine its presence, see test_controller_input_presence.py."""
    assert Hand().hold(IDLE, 60.0, still=True) == Outcome()


def test_held_button_without_deflection_may_be_still():
    assert Hand().hold(Joy(sticks(), SLOW), 10.0, still=True).velocity == (0.0, 0.0, True)


def test_emergency_stop_locks_at_once_and_releasing_the_button_does_not_unlock():
    hand = Hand()
    hand.hold(DRIVING, 0.4)
    stopped = hand.hold(Joy(sticks(1.0), buttons(SLOW_BUTTON, E_STOP)))
    assert stopped.velocity == RELEASED
    assert "emergency stop" in stopped.lock_reason.text
    assert hand.hold(DRIVING, 5.0).lock_reason


def test_press_between_two_ticks_is_not_missed():
    controller = Controller(PARAMETERS)
    controller.take(Joy(sticks(), buttons(E_STOP)), 1.00)
    controller.take(IDLE, 1.01)
    assert controller.step(1.02).lock_reason


def test_emergency_stop_is_released_by_both_buttons_held_and_nothing_else():
    hand = Hand()
    hand.hold(Joy(sticks(), buttons(E_STOP)))
    for held in (buttons(SHARE), buttons(OPTIONS), buttons(SHARE, OPTIONS, SLOW_BUTTON)):
        assert hand.hold(Joy(sticks(), held), 2.0).lock_reason
    assert hand.hold(Joy(sticks(), buttons(SHARE, OPTIONS)), 0.9).lock_reason
    assert not hand.hold(Joy(sticks(), buttons(SHARE, OPTIONS)), 0.3).lock_reason


def test_emergency_stop_outlasts_a_lost_controller():
    hand = Hand()
    hand.hold(Joy(sticks(), buttons(E_STOP)))
    hand.pull_the_plug(3.0)
    assert "emergency stop" in hand.hold(IDLE, 1.0).lock_reason.text


@pytest.mark.parametrize("deflection, rate", [(1.0, 0.1), (-1.0, -0.1), (0.0, 0.0)])
def test_lift_moves_only_while_the_dead_man_button_is_held(deflection, rate):
    assert Hand().hold(Joy(sticks(lift=deflection), SLOW)).lift_mps == rate
    assert Hand().hold(Joy(sticks(lift=deflection), NONE)).lift_mps == 0.0


@pytest.mark.parametrize("bad", [{"slow_mps": 3.0}, {"slow_button": 40}, {"dead_zone": 0.9},
                                 {"silent_after_s": float("nan")}, {"release_buttons": (8, 77)},
                                 {"release_buttons": (8,)}])
def test_parameter_out_of_range_is_a_sentence(bad):
    with pytest.raises(ConfigurationError, match=next(iter(bad))):
        Parameters(**bad)


@pytest.mark.parametrize("bad", [{"slow_button": 5}, {"e_stop_button": 8}, {"lift_axis": 1}])
def test_two_inputs_on_one_index_are_an_error(bad):
    with pytest.raises(ConfigurationError, match="must differ"):
        Parameters(**bad)


def test_ends_of_the_allowed_times_are_still_allowed():
    controller = released()
    controller.take(DRIVING, 0.0)
    assert not controller.step(PARAMETERS.silent_after_s).lock_reason
    controller.take(DRIVING, PARAMETERS.frozen_after_s)
    assert not controller.step(PARAMETERS.frozen_after_s).lock_reason


def test_message_from_the_future_is_of_a_lost_controller():
    controller = Controller(PARAMETERS)
    controller.take(IDLE, 1.0)
    assert controller.step(0.5).lock_reason


def test_emergency_stop_is_released_when_the_time_is_up():
    controller = Controller(PARAMETERS)
    controller.take(Joy(sticks(), buttons(E_STOP)), 0.0)
    for now_s in (1.0, 1.0 + PARAMETERS.release_after_s):
        controller.take(Joy(sticks(), buttons(SHARE, OPTIONS)), now_s)
        outcome = controller.step(now_s)
    assert not outcome.lock_reason


def test_deflection_of_the_dead_zone_counts():
    assert velocity(PARAMETERS, sticks(PARAMETERS.dead_zone), SLOW).linear_mps > 0.0


def test_button_beyond_the_last_one_is_released():
    assert velocity(PARAMETERS, sticks(1.0), (0,) * FAST_BUTTON) == RELEASED


OLD_AGES_S = (0.11, 5.0, 86400.0, 1.8e9, -0.2, -3600.0)


@pytest.mark.parametrize("age_s", OLD_AGES_S)
@pytest.mark.parametrize("joy", [DRIVING, Joy(sticks(1.0, 1.0), FAST), Joy(sticks(lift=1.0), SLOW), RELEASING])
def test_recording_that_is_played_back_moves_nothing_beside_the_driver(joy, age_s):
    assert Hand().play_back(joy, age_s) == Outcome()


@pytest.mark.parametrize("age_s", OLD_AGES_S)
def test_recording_that_is_played_back_without_a_driver_neither_releases_nor_drives_and_is_named(age_s):
    controller = Controller(PARAMETERS)
    for joy in (RELEASING, DRIVING):
        for tick in range(50):
            controller.take(joy, tick * TICK_S, age_s)
            outcome = controller.step(tick * TICK_S)
            assert outcome.velocity == RELEASED and outcome.lock_reason.code == "controller_input.old_stamps"


def test_driver_whose_stamps_become_old_is_lost_with_the_reason():
    hand = Hand()
    hand.hold(DRIVING, 1.0)
    for _ in range(10):
        hand.now_s += TICK_S
        hand.controller.take(DRIVING, hand.now_s, 30.0)
        outcome = hand.controller.step(hand.now_s)
    assert outcome.velocity == RELEASED and outcome.lock_reason.code == "controller_input.old_stamps"
    assert hand.hold(IDLE) == Outcome()


def test_emergency_stop_counts_however_old_its_message_is():
    hand = Hand()
    hand.controller.take(Joy(sticks(), buttons(E_STOP)), hand.now_s, 3.0)
    assert "emergency stop" in hand.hold(DRIVING, 1.0).lock_reason.text


@pytest.mark.parametrize("age_s", [math.nan, 0.0, 0.05, PARAMETERS.silent_after_s, -0.02])
def test_driver_without_stamps_or_with_true_ones_drives(age_s):
    hand = Hand()
    hand.now_s += TICK_S
    hand.controller.take(DRIVING, hand.now_s, age_s)
    assert hand.controller.step(hand.now_s).velocity.active


def test_second_publisher_locks_and_nothing_moves_until_it_has_ended_and_the_buttons_were_released():
    hand = Hand()
    hand.hold(DRIVING, 0.4)
    intrusion = Problem("controller_input.second_publisher", "Node /play_1 also publishes.")
    assert hand.controller.step(hand.now_s, intrusion=intrusion) == Outcome(lock_reason=intrusion)
    assert hand.hold(DRIVING).lock_reason and hand.hold(IDLE) == Outcome()
    assert hand.controller.step(hand.now_s, intrusion=NO_PROBLEM) == Outcome()
