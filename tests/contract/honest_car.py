"""The application's bus parts on the simulated Car in this process, without ROS."""
# SPDX-License-Identifier: Apache-2.0
import math
import threading

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.lock_watch import LockWatch
from mtr_operator.car_link.outputs.extender import BusExtender
from mtr_operator.car_link.outputs.handle import BusHandle
from mtr_operator.car_link.profile import load_profile
from mtr_operator.domain.interfaces.car_bus import CarEquipment
from mtr_operator.domain.ports import CarLink
from mtr_simulation.car.can_port import MemoryCanPort, SentFrame
from mtr_simulation.car.choice import chosen_car
from mtr_simulation.truth.log import TruthLog

STEP_NS = 20_000_000
RELEASED, PRESSED = 1000, 2000


class HonestCarLink(CarLink, CarEquipment):
    """The application's bus parts on the simulated Car, which sees the key where the robot's Statuses say it is."""

    def __init__(self, seed, folder, name="honest_handle"):
        choice = chosen_car(str(name))
        profile = load_profile(choice.profile)
        self._port = MemoryCanPort()
        self.log = TruthLog(folder)
        self._car = choice.car(seed, self._port, self.log)
        self._profile, self._watch = profile, LockWatch(profile)
        self._handle = BusHandle(profile.handle_output, self._send)
        self._extender = BusExtender(profile.extender_output, self._send)
        self._step, self._before = None, None
        self._pressed = {}
        self.truth = choice.reactions(seed)

    def _send(self, message):
        self._port.from_host.append(SentFrame(message.arbitration_id, bytes(message.data)))
        left = threading.Event()
        left.set()
        return left

    def connect(self):
        pass

    def observe(self, status):
        until = round(status.stamp_s * 1e9) // STEP_NS
        key = (status.x + status.key_x * math.cos(status.heading), status.y + status.key_x * math.sin(status.heading),
               status.key_height_m)
        before, first = self._before or key, until - 5 if self._step is None else self._step + 1
        for step in range(first, until + 1):
            part = (step - first + 1) / (until - first + 1)
            place = tuple(a + part * (b - a) for a, b in zip(before, key))
            self._car.step(step * STEP_NS, place, self._servos(status, step), status.heading)
            for frame in self._port.frames:
                self._watch.frame(CanFrame(frame.can_id, False, frame.data, step * STEP_NS * 1e-9,
                                           frame.time_ns // 1_000_000 % 60_000))
            self._port.frames.clear()
        self._step, self._before = until, key
        self._watch.status(status, status.stamp_s + 1e-4)
        return self._watch.release(status.stamp_s)

    def _servos(self, status, step):
        """A press is told when it is over; this Car feels it then, for as long."""
        for press in status.presses:
            self._pressed.setdefault(press.id, (step, round((press.end_s - press.start_s) * 1e9) // STEP_NS))
        is_pressed = any(begin <= step < begin + length for begin, length in self._pressed.values())
        return (PRESSED if is_pressed else RELEASED, RELEASED)

    @property
    def lock_state(self):
        return self._watch.lock_state

    @property
    def facts(self):
        return self._profile.facts

    @property
    def handle(self):
        return self._handle

    @property
    def extender(self):
        return self._extender

    @property
    def problem(self):
        return self._watch.problem

    def close(self):
        pass
