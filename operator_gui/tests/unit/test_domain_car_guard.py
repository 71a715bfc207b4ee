"""Ignition, gear, speed and doors of the Car stop the robot, end the test and void the line; the rest is kept."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest

from mtr_operator.domain.actions.skipping import Skipping
from mtr_operator.domain.errors import CarActive
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.supervision.car_guard import DOOR_CLOSING_S, CarGuard
from mtr_operator.domain.supervision.car_signals import DOOR, GEAR, IGNITION, SPEED, CarSignal, SignalState

CLEAR, ACTIVE, UNKNOWN = SignalState.CLEAR, SignalState.ACTIVE, SignalState.UNKNOWN
AUTOLOCK = SCENARIOS["autolock"]
ONE_A_SIDE = {"measurements_distance_m": 10.0, "self_check": False}


def signals(kind, state):
    """A Car that names one signal."""
    return (CarSignal(kind, "Signal of Message", state, "driver" if kind == DOOR else ""),)


class Moments(Skipping):
    """Remembers at which robot time each line began."""

    def __init__(self, world):
        super().__init__()
        self.world, self.begun = world, {}

    def begin(self, number):
        self.begun.setdefault(number, self.world.time_s)
        super().begin(number)


def run_until_active(run_scenario, world, kind, scenario=AUTOLOCK, *, parameters=ONE_A_SIDE, line=2):
    """A test in which the signal becomes active 2 s after a line has begun; the error that ends it."""
    moments = Moments(world)
    world.signals = lambda time_s: signals(
        kind, ACTIVE if time_s >= moments.begun.get(line, math.inf) + 2.0 else CLEAR)
    with pytest.raises(CarActive) as error:
        run_scenario(scenario, scenario.parameters_type.from_mapping(parameters), skipping=moments)
    return error.value, moments


@pytest.mark.parametrize("kind, sentence", [
    (IGNITION, "The Car's ignition is on (signal Signal of Message)."),
    (GEAR, "The Car's gear is not P (signal Signal of Message)."),
    (SPEED, "The Car moves (signal Signal of Message)."),
    (DOOR, "A door or lid of the Car is open: driver (signal Signal of Message).")])
def test_signal_stops_the_robot_voids_the_line_and_keeps_those_before(run_scenario, world, robot_link, kind, sentence):
    error, moments = run_until_active(run_scenario, world, kind)
    assert str(error) == f"The robot was stopped. {sentence} Secure the Car, then continue the test."
    first, second = run_scenario.progress.results
    assert not first.invalid_count and first.reason == ""
    assert second.invalid_count and second.reason == f"The robot was stopped. {sentence}"
    assert run_scenario.saved[-1] == [first, second] and list(moments.begun) == [1, 2]
    assert run_scenario.progress.session["ended before its end"] == str(error)
    assert robot_link.answers[-1][1].stop and world.speed_mps == 0.0


def test_stop_answers_the_very_status_and_nothing_that_moves_follows(run_scenario, world, robot_link):
    _, moments = run_until_active(run_scenario, world, SPEED)
    period_s, active_s = 0.1, moments.begun[2] + 2.0
    at = next(index for index, (status_id, _) in enumerate(robot_link.answers)
              if 1.0 + period_s * status_id >= active_s - 1e-6)
    assert len(robot_link.answers) > at and all(desired.stop and desired.press is None
                                                for _, desired in robot_link.answers[at:])


@pytest.mark.parametrize("name", sorted(set(SCENARIOS) - {"digital_key"}))
@pytest.mark.usefixtures("output", "extender")
def test_each_scenario_leaves_its_line_at_once(run_scenario, world, name):
    scenario = SCENARIOS[name]
    kind = scenario.parameters_type
    _, moments = run_until_active(run_scenario, world, IGNITION, scenario,
                                  parameters={**kind.from_mapping(kind.proposed()).to_mapping(), "self_check": False},
                                  line=1)
    result, = run_scenario.progress.results
    assert result.invalid_count and result.reason.startswith("The robot was stopped.")
    # Halting takes longer than leaving the line.
    assert world.time_s <= moments.begun[1] + 2.0 + 1.0


@pytest.mark.parametrize("kind", [IGNITION, GEAR, SPEED])
def test_no_test_begins_while_a_signal_is_active(run_scenario, world, robot_link, kind):
    world.signals = lambda time_s: signals(kind, ACTIVE)
    with pytest.raises(CarActive, match="^The test does not begin. The Car"):
        run_scenario(AUTOLOCK, AUTOLOCK.parameters_type.from_mapping(ONE_A_SIDE))
    assert not any(desired.waypoint or desired.key_height_m for _, desired in robot_link.answers)


@pytest.mark.parametrize("told", [(), signals(IGNITION, UNKNOWN), signals(IGNITION, CLEAR), signals(DOOR, ACTIVE)],
                         ids=["not named", "silent", "off", "door open from the start"])
def test_what_is_unknown_or_was_open_before_stops_nothing(run_scenario, world, told):
    world.signals = lambda time_s: told
    results = run_scenario(AUTOLOCK, AUTOLOCK.parameters_type.from_mapping(ONE_A_SIDE))
    assert not any(result.invalid_count for result in results)


def test_guard_watches_from_its_beginning_and_keeps_its_first_reason():
    guard = CarGuard()
    assert not guard.learn(signals(SPEED, ACTIVE), 1.0) and guard.reason == ""
    assert guard.begin(signals(IGNITION, ACTIVE)) == "The Car's ignition is on (signal Signal of Message)."
    assert guard.learn(signals(SPEED, ACTIVE), 2.0) and guard.reason.startswith("The Car moves")
    assert not guard.learn(signals(IGNITION, ACTIVE), 3.0) and guard.reason.startswith("The Car moves")


def test_door_that_was_open_counts_once_it_was_closed():
    guard = CarGuard()
    assert guard.begin(signals(DOOR, ACTIVE)) == ""
    assert not guard.learn(signals(DOOR, ACTIVE), 1.0)
    # Silence is no closing.
    assert not guard.learn(signals(DOOR, UNKNOWN), 2.0) and not guard.learn(signals(DOOR, ACTIVE), 3.0)
    assert not guard.learn(signals(DOOR, CLEAR), 4.0) and guard.learn(signals(DOOR, ACTIVE), 5.0)


def test_door_may_open_while_its_handle_is_pulled_and_is_closed_soon():
    guard = CarGuard()
    guard.begin(signals(DOOR, CLEAR))
    with guard.handle_pulled():
        assert not guard.learn(signals(DOOR, ACTIVE), 100.0)
    assert not guard.learn(signals(DOOR, ACTIVE), 101.0)
    assert not guard.learn(signals(DOOR, CLEAR), 102.0)
    assert not guard.learn(signals(DOOR, ACTIVE), 101.0 + DOOR_CLOSING_S - 0.1)
    assert guard.learn(signals(DOOR, ACTIVE), 101.0 + DOOR_CLOSING_S)


def test_robot_clock_that_is_set_back_gives_a_door_no_more_time():
    guard = CarGuard()
    guard.begin(signals(DOOR, CLEAR))
    with guard.handle_pulled():
        guard.learn(signals(DOOR, ACTIVE), 5000.0)
    assert not guard.learn(signals(DOOR, ACTIVE), 5001.0)
    assert not guard.learn(signals(DOOR, ACTIVE), 10.0)
    assert guard.learn(signals(DOOR, ACTIVE), 10.0 + DOOR_CLOSING_S)


def test_ignition_stops_the_robot_while_a_handle_is_pulled():
    guard = CarGuard()
    guard.begin(signals(IGNITION, CLEAR))
    with guard.handle_pulled():
        assert guard.learn(signals(IGNITION, ACTIVE), 100.0)
