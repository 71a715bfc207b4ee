"""The whole simulated robot and its Car, one tick after the other: what sim.launch runs as nine processes."""
# SPDX-License-Identifier: Apache-2.0
import collections
import pathlib
from dataclasses import dataclass, replace
from typing import Deque, Optional

from mtr_core.schedule import SIMULATION_START_NS
from mtr_description.shipped import shipped_base, shipped_geometry, shipped_urdf
from mtr_dispatcher.status.builder import Identity
from mtr_msgs.msg import MotionLock
from mtr_simulation.car.can_port import CanPort
from mtr_simulation.parameters import SimulatorParameters
from mtr_simulation.physics.robot import shipped_robot
from mtr_simulation.physics.wheels import parameters_of
from mtr_simulation.world import World

from ..car_sheet import data_sheet_of
from . import wire
from .car_locator import CarLocatorPart
from .dispatcher import DispatcherPart
from .drive_control import DriveControlPart
from .localization import LocalizationPart
from .motion_planner import MotionPlannerPart
from .parameters import simulated_robot
from .peripherals import PeripheralsPart
from .state_machine import StateMachinePart
from .topics import Topics

# One start of the robot is as another.
_ROBOT_SESSION_ID = 1
SOFTWARE = "cores"


@dataclass(frozen=True)
class CoresOptions:
    """What is simulated.

    Attributes:
        seed: of every random number.
        car: name of a shipped Car, or path of its file.
        site: what stands around the Car.
        truth_folder: for the true events; None: they are not written.
    """

    seed: int = 1
    car: str = "honest"
    site: str = "lot"
    truth_folder: Optional[pathlib.Path] = None


class CoresRobot:
    """Lets time pass from Status to Status of the dispatcher.

    Attributes:
        time_ns: simulated time.
        world: the simulator.
    """

    def __init__(self, options: CoresOptions, port: CanPort):
        """port: takes the frames of the Car's bus."""
        folder = str(options.truth_folder) if options.truth_folder else ""
        self.time_ns = SIMULATION_START_NS
        self.world = World(SimulatorParameters(seed=options.seed, car=options.car, scenario=options.site,
                                               truth_dir=folder),
                           robot=shipped_robot(), base=parameters_of(shipped_base()), port=port)
        self._commands: Deque[bytes] = collections.deque()
        self._status: Optional[bytes] = None
        self._make_parts(options.site)

    def _make_parts(self, site: str) -> None:
        parameters, robot, urdf, topics = simulated_robot(), shipped_geometry(), shipped_urdf(), Topics()
        key = robot.key()
        locator = replace(parameters.car_locator, sheet=data_sheet_of(site))
        self._locator = CarLocatorPart(topics, locator, robot.lidars(), self._order)
        self._localization = LocalizationPart(topics, urdf, self._locator.take_map)
        topics.pose.listen(self._locator.take_pose)
        self._drive = DriveControlPart(topics, urdf, self.world.sim.command)
        self._peripherals = PeripheralsPart(topics, parameters.peripherals, key, self.world.firmware)
        self._dispatcher = DispatcherPart(topics, parameters.dispatcher,
                                          Identity(_ROBOT_SESSION_ID, SOFTWARE, key.x_m, key.y_m), self._lock)
        # What a part reads of another is of a tick before: their order within a tick does not matter.
        self._parts = (self._drive, MotionPlannerPart(topics, parameters.motion_planner, robot.footprint()),
                       StateMachinePart(topics, parameters.state_machine, self._lock), self._peripherals,
                       self._locator)

    def take(self, command: bytes) -> None:
        """A Command of the application, an answer to the newest Status."""
        self._commands.append(command)

    def next_status(self) -> bytes:
        """Go on with what the answers to the last Status ask for, until the next one."""
        if self._status is None:
            self._localization.begin(self.time_ns)
        else:
            self._dispatcher.answer(self.time_ns, self._commands)
        self._tick()
        while self._dispatcher.slot.last_at(self.time_ns) != self.time_ns:
            self._tick()
        self._status = self._dispatcher.status(self.time_ns)
        return self._status

    def close(self) -> None:
        """End the firmware, and close the truth's file."""
        self.world.close()

    def _tick(self) -> None:
        sensors = self.world.step()
        self.time_ns = sensors.time_ns
        front, rear = (scan and wire.scan(scan) for scan in (sensors.front_scan, sensors.rear_scan))
        sensors = sensors._replace(odometry=wire.odometry(sensors.odometry), front_scan=front, rear_scan=rear)
        self._localization.step(sensors)
        for sensing in (self._drive, self._locator, self._peripherals):
            sensing.sense(sensors)
        for part in self._parts:
            if part.slot.last_at(self.time_ns) == self.time_ns:
                part.step(self.time_ns)

    def _lock(self, lock: MotionLock) -> None:
        self._drive.take_lock(lock)

    def _order(self, order: object) -> None:
        self._localization.take_order(order)
