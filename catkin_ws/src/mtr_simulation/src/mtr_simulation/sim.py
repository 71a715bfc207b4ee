"""Simulated robot in its world: physics and sensors, one tick of the schedule at a time."""
# SPDX-License-Identifier: Apache-2.0
import math
from dataclasses import dataclass, field, replace
from typing import List, Optional, Set

import mujoco

from mtr_core import names
from mtr_core.errors import ConfigurationError
from mtr_core.schedule import CLOCK_STEP, LIDAR, SIMULATION_START_NS
from mtr_core.se2 import Pose2
from mtr_description.mounts import Mount

from .noise import stream
from .physics.base_state import BaseState, base_state, mean_spin, rotate_back
from .physics.mjcf import model_xml
from .physics.mjcf_robot import LIFT_STIFFNESS_NPM
from .physics.robot import RobotModel, shipped_robot
from .physics.tyres import Surface, TyreParameters, Tyres
from .physics.wheels import BaseParameters, Wheels
from .sensors.battery import battery
from .sensors.imu import Imu, ImuParameters
from .sensors.lidar import Lidar, LidarParameters
from .sensors.readings import Scan, Sensors
from .site.cables import Cables
from .site.person import Person
from .site.scenario import Scenario
from .site.surroundings import uneven_ground
from .true_state import TrueState

GRAVITY_MPS2 = 9.81
TICK_S = CLOCK_STEP.period_ns * 1e-9
# Time in which the robot settles on its tyres before the clock starts.
SETTLING_S = 0.5


@dataclass(frozen=True)
class SimParameters:
    """Parameters of the robot's parts.

    Attributes:
        timestep_s: step of the physics; a whole fraction of 20 ms. Turning and slip are the same from 1 to 5 ms.
        rear_lidar: the rear LiDAR exists.
    """

    timestep_s: float = 0.005
    rear_lidar: bool = True
    base: BaseParameters = field(default_factory=BaseParameters)
    tyres: TyreParameters = field(default_factory=TyreParameters)
    lidar: LidarParameters = field(default_factory=LidarParameters)
    imu: ImuParameters = field(default_factory=ImuParameters)

    def __post_init__(self) -> None:
        if self.timestep_s not in (0.001, 0.002, 0.004, 0.005):
            raise ConfigurationError(f"Parameter timestep_s is {self.timestep_s:g} s; allowed is 0.001, 0.002, 0.004 "
                                     "or 0.005 s.")
        if round(self.lidar.rotation_s * 1e9) != LIDAR.period_ns:
            raise ConfigurationError(f"Parameter rotation_s is {self.lidar.rotation_s:g} s; allowed is "
                                     f"{LIDAR.period_ns * 1e-9:g} s, the period of the scans.")


class Sim:
    """Robot's physics and sensors for one seed and scenario.

    Attributes:
        scenario: simulated scenario.
        robot: shape and masses.
        time_ns: simulated time, an exact multiple of the clock step.
        scans_wanted: False saves the LiDARs' computation, half of the total; an incomplete sweep is not returned.
            Nothing else changes, so that the number of subscribers has no effect on a run.
    """

    def __init__(self, seed: int, scenario: Scenario, parameters: Optional[SimParameters] = None,
                 robot: Optional[RobotModel] = None):
        """robot: default: the robot of mtr_description."""
        parameters, robot = parameters or SimParameters(), robot or shipped_robot()
        self.robot = robot
        self.scenario, self.time_ns, self.scans_wanted = scenario, SIMULATION_START_NS, True
        self._model = mujoco.MjModel.from_xml_string(model_xml(
            scenario, robot, scenario.start_in_world(seed), parameters.timestep_s, parameters.base.max_wheel_torque_nm))
        # The world frame belongs to the site: a slope is an inclined gravity, and everything else stays level.
        self._gravity = scenario.gravity(GRAVITY_MPS2)
        self._model.opt.gravity[:] = self._gravity
        self._data = mujoco.MjData(self._model)
        self._steps = round(TICK_S / parameters.timestep_s)
        self._wheels = Wheels(self._model, self._data, robot, parameters.base)
        ground = uneven_ground(seed, scenario.ground_tilt_rad) if scenario.ground_tilt_rad else None
        cables = Cables(scenario.cables, robot.wheel_radius_m) if scenario.cables else None
        self._tyres = Tyres(self._model, self._data, robot, Surface(scenario.friction, ground, cables),
                            parameters.tyres)
        self._person = Person(self._model, self._data, scenario.person) if scenario.person else None
        self._imu = Imu(parameters.imu, TICK_S, stream(seed, "imu"))
        self._lidars = {mount.frame: self._lidar(mount, parameters.lidar, seed)
                        for mount in (robot.front_lidar, robot.rear_lidar if parameters.rear_lidar else None) if mount}
        self._lift_joint = int(self._model.joint("lift").qposadr[0])
        self._lift_servo = self._model.actuator("lift").id
        self._car_from_world = scenario.world_from_car.inverse()
        self._has_cast, self._sweep_is_whole = False, True
        self._state: Optional[BaseState] = None
        self._settle()

    def command(self, linear_mps: float, angular_radps: float) -> None:
        """Set the velocity command, as on the base's topic."""
        self._wheels.command(linear_mps, angular_radps)

    def set_lift(self, height_m: float) -> None:
        """Set the height that the lift's firmware has reached; the carriage follows."""
        # The servo is a spring; the carriage's weight is compensated, so that it does not sag.
        weight = (self.robot.carriage_mass_kg + self.robot.key_mass_kg) * GRAVITY_MPS2
        self._data.ctrl[self._lift_servo] = height_m + weight / LIFT_STIFFNESS_NPM

    def kidnap(self, world_from_base: Pose2) -> None:
        """Put the robot down elsewhere: no time passes and the wheels do not turn."""
        pose, data = world_from_base, self._data
        data.qpos[0:2] = pose.x, pose.y
        data.qpos[2] = self.robot.base_height_m
        data.qpos[3:7] = math.cos(0.5 * pose.heading), 0.0, 0.0, math.sin(0.5 * pose.heading)
        data.qvel[0:6] = 0.0
        self._tyres.lift_off()
        mujoco.mj_forward(self._model, data)
        self._state = None

    def step(self) -> Sensors:
        """Advance one tick of 20 ms; return the readings at its end."""
        quaternion, velocity = self._data.qpos[3:7].tolist(), self._data.qvel[0:3].tolist()
        self.cast_ahead()
        self._sweep_is_whole = self._has_cast and (self._sweep_is_whole or not self._sweep_step())
        self._has_cast = False
        for step in range(self._steps):
            base = self._base()
            if step and self._sweep_is_whole:
                self._cast(base, step)
            self._physics(base)
        self.time_ns += CLOCK_STEP.period_ns
        if self._person:
            self._person.move(self._elapsed_s())
        return self._sense(quaternion, velocity)

    def stand(self) -> Sensors:
        """Return the readings at the end of 20 ms in which the world and the robot stopped.

        A sweep that has begun is lost, because its beams would belong to two times.
        """
        self._sweep_is_whole = False
        force = rotate_back(self._base().rotation, *(-each for each in self._gravity))
        return Sensors(self.time_ns, self._imu.read((0.0, 0.0, 0.0), force), self._wheels.odometry(TICK_S),
                       battery(self._elapsed_s()), None, None)

    def cast_ahead(self) -> None:
        """Cast the beams of the current instant, which no command can change; uses the waiting time."""
        if self.scans_wanted and not self._has_cast:
            self._has_cast = True
            self._cast(self._base(), 0)

    def truth(self) -> TrueState:
        """Return the current true state."""
        base = self._base()
        lift = float(self._data.qpos[self._lift_joint])
        key = base.point(*self.robot.key_in_base(lift))
        forward, left, _ = rotate_back(base.rotation, *base.velocity)
        pose = base.pose()
        return TrueState(self.time_ns, pose, self._car_from_world @ pose, key,
                         (*self._car_from_world.apply(key[0], key[1]), key[2]), forward, left,
                         base.angular_velocity[2], base.tilt_rad(self._gravity), lift)

    def contacts(self) -> Set[str]:
        """Return the names of the bodies that the robot touches now: car, parked_0, person, world (poles, walls,
        ground)."""
        touched: Set[str] = set()
        if not self._data.ncon:
            return touched
        for contact in self._data.contact[:self._data.ncon]:
            bodies = [self._model.geom_bodyid[geom] for geom in (contact.geom1, contact.geom2)]
            touched |= {self._model.body(self._model.body_rootid[body]).name for body in bodies}
        return touched - {"base_link"}

    def wheel_loads_n(self) -> List[float]:
        """Return the upward force of the ground on each wheel in the last physics step."""
        return self._tyres.loads_n()

    def _elapsed_s(self) -> float:
        return (self.time_ns - SIMULATION_START_NS) * 1e-9

    def _base(self) -> BaseState:
        """Return the cached state of the base; it is read more often than it changes."""
        if self._state is None:
            position, speed = self._data.qpos[0:7].tolist(), self._data.qvel[0:6].tolist()
            self._state = base_state(position[:3], position[3:], speed[:3], speed[3:])
        return self._state

    def _cast(self, base: BaseState, step: int) -> None:
        """Cast the beams that belong to a physics step of this tick."""
        for lidar in self._lidars.values():
            lidar.cast(base, self._sweep_step() + step)

    def _sweep_step(self) -> int:
        """Return the number of physics steps since the sweep began."""
        return (self.time_ns - SIMULATION_START_NS) % LIDAR.period_ns // CLOCK_STEP.period_ns * self._steps

    def _physics(self, base: BaseState) -> None:
        self._tyres.apply(base)
        self._wheels.drive()
        mujoco.mj_step(self._model, self._data)
        self._state = None

    def _settle(self) -> None:
        self.set_lift(0.0)
        if self._person:
            self._person.move(0.0)
        for _ in range(round(SETTLING_S / self._model.opt.timestep)):
            self._physics(self._base())
        self._wheels.odometry(TICK_S)
        self._data.time = 0.0

    def _sense(self, quaternion: List[float], velocity: List[float]) -> Sensors:
        """Return the readings for the tick that began with this orientation and velocity."""
        base = self._base()
        spin = mean_spin(quaternion, self._data.qpos[3:7].tolist(), TICK_S)
        change = [(new - old) / TICK_S for new, old in zip(base.velocity, velocity)]
        force = rotate_back(base.rotation, *(each - pull for each, pull in zip(change, self._gravity)))
        return Sensors(self.time_ns, self._imu.read(spin, force), self._wheels.odometry(TICK_S),
                       battery(self._elapsed_s()), *self._scans())

    def _scans(self) -> List[Optional[Scan]]:
        """Return the sweeps of front and rear LiDAR if they end at this tick and are complete."""
        if self._sweep_step():
            return [None, None]
        scans = {frame: lidar.scan(self.time_ns - LIDAR.period_ns) for frame, lidar in self._lidars.items()}
        return [scans.get(frame) if self._sweep_is_whole else None for frame in (names.FRONT_LIDAR, names.REAR_LIDAR)]

    def _lidar(self, mount: Mount, parameters: LidarParameters, seed: int) -> Lidar:
        if parameters.height_m is not None:
            mount = replace(mount, z_m=parameters.height_m - self.robot.base_height_m)
        return Lidar(self._model, self._data, mount, parameters, (seed, mount.frame))

