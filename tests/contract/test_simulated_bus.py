"""What the application reads from the buses of the simulated Cars: every true event, when it was, and its cause."""
# SPDX-License-Identifier: Apache-2.0
import dataclasses

import numpy as np
import pytest

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.ports import KEY_BUTTON, LockState
from mtr_operator.domain.robot_status import RobotStatus
from mtr_operator.domain.supervision.car_signals import IGNITION, SPEED, SignalState
from mtr_simulation.car.can_port import MemoryCanPort
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.car.honest.parameters import LockParameters, NoiseParameters, UhfParameters
from mtr_simulation.truth.log import NoTruthLog

HONEST = ("honest", "honest_868", "honest_slow")
STEP_NS = 20_000_000
KEY = (0.0, 5.0, 1.0)
RELEASED, LOCK_PRESSED, UNLOCK_PRESSED = (1000, 1000), (2000, 1000), (1000, 2000)
# The adapter stamps in whole milliseconds.
STAMP_S = 0.001


class TrueEvents(NoTruthLog):
    """Keeps when the locks moved."""

    def __init__(self):
        self.events = []

    def lock_event(self, event, time_ns, key_xyz):
        self.events.append((event, time_ns * 1e-9))


class Bench:
    """A Car whose buttons always work, its bus, and the application's watch on it."""

    def __init__(self, name):
        choice = chosen_car(name)
        honest = dataclasses.replace(
            choice.honest, uhf=UhfParameters(fading_sigma_db=0.0, margin_at_1m_db=90.0),
            noise=NoiseParameters(sigma_db=0.1, lapse=0.0), locks=LockParameters(relock_s=0.0))
        self.truth, self.port = TrueEvents(), MemoryCanPort()
        self.car = dataclasses.replace(choice, honest=honest).car(1, self.port, self.truth)
        self.profile = load_profile(choice.profile)
        self.watch = LockWatch(self.profile)
        self.step, self.events = 50, []

    def run(self, steps, servo_us=RELEASED):
        """Step Car, bus and Statuses."""
        for _ in range(steps):
            self.step += 1
            time_ns = self.step * STEP_NS
            self.car.step(time_ns, KEY, servo_us)
            for frame in self.port.frames:
                self.watch.frame(CanFrame(frame.can_id, False, frame.data, time_ns * 1e-9,
                                          frame.time_ns // 1_000_000 % 60_000))
            self.port.frames.clear()
            if self.step % 5 == 0:
                self.watch.status(RobotStatus(self.step // 5, 1, round(time_ns * 1e-9, 6)), time_ns * 1e-9 + 1e-4)
                self.events += self.watch.release(time_ns * 1e-9)


@pytest.fixture(name="bench", params=HONEST, scope="module")
def bench_fixture(request):
    """A bench on which 60 presses, at all phases of the bus, have moved the locks."""
    bench = Bench(request.param)
    bench.run(200)
    bench.events.clear()  # that the ECU has booted
    for number in range(60):
        bench.run(15, LOCK_PRESSED if number % 2 else UNLOCK_PRESSED)
        bench.run(107 + number % 7)
    return bench


def test_application_sees_every_event_of_the_car_in_order(bench):
    states = {"locked": LockState.LOCKED, "unlocked": LockState.UNLOCKED}
    assert len(bench.truth.events) == 60
    assert [event.lock_state for event in bench.events] == [states[kind] for kind, _ in bench.truth.events]


def test_its_times_are_true_within_what_it_says_of_them(bench):
    errors_s = np.array([event.time_s - true_s for event, (_, true_s) in zip(bench.events, bench.truth.events)])
    sigmas_s = np.array([event.time_sigma_s for event in bench.events])
    assert abs(errors_s).max() < 0.45
    assert np.sqrt(np.mean((errors_s / sigmas_s) ** 2)) < 1.3
    assert (abs(errors_s) < 2.0 * sigmas_s + STAMP_S).all()


def test_it_knows_the_cause_where_the_lock_message_tells_it(bench):
    assert {event.source for event in bench.events} == {KEY_BUTTON if bench.profile.sources else ""}


@pytest.mark.parametrize("name", ["gentle", *HONEST])
def test_application_reads_ignition_and_speed_of_every_simulated_car(name):
    choice, port = chosen_car(name), MemoryCanPort()
    car, watch = choice.car(1, port, TrueEvents()), LockWatch(load_profile(choice.profile))

    def states(first_step):
        for step in range(first_step, first_step + 100):
            car.step(step * STEP_NS, KEY, RELEASED)
            for frame in port.frames:
                watch.frame(CanFrame(frame.can_id, False, frame.data, frame.time_ns * 1e-9))
            port.frames.clear()
        return {signal.kind: signal.state for signal in watch.signals}
    assert states(50) == {IGNITION: SignalState.CLEAR, SPEED: SignalState.CLEAR}
    car.vehicle.ignition_on = True
    assert states(150) == {IGNITION: SignalState.ACTIVE, SPEED: SignalState.CLEAR}
    car.vehicle.ignition_on, car.vehicle.speed_kmh = False, 0.01
    assert states(250) == {IGNITION: SignalState.CLEAR, SPEED: SignalState.ACTIVE}
