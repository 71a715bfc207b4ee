"""Ignition, gear, speed and doors as a profile names them, from the frames of a bus to the end of a test."""
# SPDX-License-Identifier: Apache-2.0
import math

import pytest
from further_car import DOORS, DOORS_ID, OTHER_ID, Bench, written

from mtr_operator.car_link.profile import load_profile, profile_names
from mtr_operator.car_link.spoken_car import SpokenCar
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.errors import CarActive, ConnectionFailed, RobotFailed
from mtr_operator.domain.results.progress import Progress
from mtr_operator.domain.runner import Runner
from mtr_operator.domain.scenarios import SCENARIOS
from mtr_operator.domain.supervision.car_signals import DOOR, GEAR, IGNITION, SPEED, SignalState, unknown_unless_active
from mtr_operator.robot_link.fake import FakeRobotLink

CLEAR, ACTIVE, UNKNOWN = SignalState.CLEAR, SignalState.ACTIVE, SignalState.UNKNOWN
# The signals of the message of causes stand for others.
GEARS = "stop_signals: {gear: {message: Cause, signal: Key, parked: [3], unknown: [15]}}\n"


def states(bench):
    """State of each signal by kind and name."""
    return {signal.kind + signal.name: signal.state for signal in bench.watch.signals}


@pytest.mark.parametrize("raw, state", [(3, CLEAR), (0, ACTIVE), (4, ACTIVE), (14, ACTIVE), (15, UNKNOWN)])
def test_value_that_is_not_listed_as_safe_stops(tmp_path, raw, state):
    bench = Bench(written(tmp_path, GEARS))
    bench.key = raw
    bench.run(0.2)
    assert states(bench) == {GEAR: state}
    signal, = bench.watch.signals
    assert signal.source == "Key of Cause"


def test_doors_of_the_profile_are_signals_too(tmp_path):
    bench = Bench(written(tmp_path, DOORS))
    assert states(bench) == {DOOR + "driver": CLEAR, DOOR + "passenger": CLEAR}
    bench.doors = 2
    bench.run(0.1)
    assert states(bench) == {DOOR + "driver": CLEAR, DOOR + "passenger": ACTIVE}


@pytest.mark.parametrize("silence_s, state", [(1.9, CLEAR), (2.2, UNKNOWN)])
def test_safe_signal_that_falls_silent_is_unknown(tmp_path, silence_s, state):
    bench = Bench(written(tmp_path, DOORS))
    send = bench.send
    bench.send = lambda can_id, data: send(OTHER_ID if can_id == DOORS_ID else can_id, data)
    bench.run(silence_s)
    assert set(states(bench).values()) == {state}


def test_active_signal_that_falls_silent_stays_active(tmp_path):
    bench = Bench(written(tmp_path, DOORS))
    bench.doors = 1
    bench.run(0.1)
    send = bench.send
    bench.send = lambda can_id, data: None if can_id == DOORS_ID else send(can_id, data)
    bench.run(60.0)
    assert states(bench)[DOOR + "driver"] is ACTIVE
    assert {each.state for each in unknown_unless_active(bench.watch.signals)} == {ACTIVE, UNKNOWN}


def test_reopened_adapter_knows_nothing_until_the_next_frames(tmp_path):
    bench = Bench(written(tmp_path, GEARS, DOORS))
    bench.watch.restart()
    assert set(states(bench).values()) == {UNKNOWN}
    bench.run(0.1)
    assert set(states(bench).values()) == {CLEAR}


def test_frame_too_short_for_the_signal_reports_nothing(tmp_path):
    bench = Bench(written(tmp_path, DOORS))
    bench.watch.restart()
    bench.send(DOORS_ID, b"")
    assert set(states(bench).values()) == {UNKNOWN}


@pytest.mark.parametrize("lines, words", [
    ("stop_signals: [gear]\n", "stop_signals must be a table of ignition, gear, speed"),
    ("stop_signals: {brake: {message: Cause, signal: Key, parked: [0]}}\n", "must be a table of ignition, gear, speed"),
    ("stop_signals: {gear: {signal: Key, parked: [0]}}\n", "gear of stop_signals must be a table of message, signal"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: [0], on: [1]}}\n", "bus and unknown are optional"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: []}}\n", "gear of stop_signals has no parked value"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: [16]}}\n", "no parked value that the signal Key can"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: 3}}\n", "has parked: 3; allowed is a list of whole"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: [yes]}}\n", "allowed is a list of whole numbers"),
    ("stop_signals: {gear: {message: Cause, signal: Key, parked: [1], unknown: [1]}}\n", "lists 1 as parked and as"),
    ("stop_signals: {gear: {message: Cause, signal: What, parked: [1]}}\n", "has no signal"),
    ("stop_signals: {gear: {bus: body, message: Cause, signal: Key, parked: [1]}}\n", "the bus body, which is not in")])
def test_wrong_entry_is_a_sentence(tmp_path, lines, words):
    with pytest.raises(ConnectionFailed, match=words):
        load_profile(written(tmp_path, lines))


@pytest.mark.parametrize("name", profile_names())
def test_shipped_profiles_name_ignition_and_speed(name):
    assert {stop.kind for stop in load_profile(name).further.stops} == {IGNITION, SPEED}


class Played(SpokenCar):
    """Changes what the Car reports at a robot time."""

    at_s, stops = math.inf, {}

    def next_status(self, timeout_s):
        status = super().next_status(timeout_s)
        if status is not None and status.stamp_s >= self.at_s:
            self._frames.stops = self.stops
        return status


@pytest.fixture(name="played")
def played_fixture(request):
    """A Car on virtual buses, with the substitute of a robot."""
    played = Played(FakeRobotLink(), f"stop-{request.node.name}")
    played.car.connect()
    played.connect()
    yield played
    played.car.close()
    played.close()


def test_ignition_on_the_bus_ends_a_test_and_the_lines_before_are_kept(played):
    scenario = SCENARIOS["autolock"]
    parameters = scenario.parameters_type.from_mapping({"measurements_distance_m": 10.0, "self_check": False})
    progress = Progress(scenario.name, parameters.to_mapping())
    loop = ControlLoop(played, played.car)
    begin = loop.skipping.begin

    def begun(number):
        begin(number)
        if number == 2:
            played.at_s, played.stops = loop.now_s + 2.0, {IGNITION: 2}
    loop.skipping.begin = begun
    with pytest.raises(CarActive, match="ignition is on .signal TerminalState of IgnitionStatus"):
        Runner(scenario, parameters, loop, progress, lambda _: None).run()
    first, second = progress.results
    assert not first.invalid_count and second.invalid_count
    assert second.reason == "The robot was stopped. The Car's ignition is on (signal TerminalState of IgnitionStatus)."
    # Robot time that frames, Status and the halt take.
    assert loop.now_s - played.at_s < 1.5 and loop.status.speed_mps == 0.0


def test_no_output_is_switched_while_the_ignition_is_on(tmp_path):
    bench_car = SpokenCar(FakeRobotLink(), "stop-output", profile="mtr_honest_car")
    link = bench_car.car
    link._settings = type(link._settings)("virtual", "stop-output", is_listening=False)
    link.connect()
    bench_car.connect()
    try:
        for _ in range(30):
            link.observe(bench_car.next_status(1.0))
        link.handle.request(1.0)
        link.handle.release()
        bench_car._frames.stops = {IGNITION: 2}
        for _ in range(30):
            link.observe(bench_car.next_status(1.0))
        with pytest.raises(RobotFailed, match="^No output at the Car is switched. The Car's ignition is on"):
            link.handle.request(1.0)
        with pytest.raises(RobotFailed, match="^No output at the Car is switched"):
            link.extender.switch(True)
        # What is active can always be made idle.
        link.handle.release()
        link.extender.switch(False)
    finally:
        link.close()
        bench_car.close()
