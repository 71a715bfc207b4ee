"""The robots on which cells are run: what time is for them, and how the Operator reaches them. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import subprocess
from dataclasses import dataclass, field
from typing import Dict, Iterator

from mtr_bringup.graph_watch.environment import closed_environment

from .matrix import CAR_BUS, GUARDED, LOCKSTEP, MACHINE_CLOCK, PACED, SATELLITES, SMALL_DISK

# Of a disk that is filled: room for logs until then.
SMALL_DISK_SIZE = "24m"
# It is full below that, MB, and looked at so often, s of wall time: a fault lasts 2 s.
SMALL_DISK_LIMITS = {"/dispatcher/full_disk_mb": 2.0, "/dispatcher/disk_period_s": 0.1}


@dataclass(frozen=True)
class RobotKind:
    """One of them.

    Attributes:
        arguments: of sim.launch. variables: of its environment.
        parameters: of its nodes, by their whole names.
        real_time_factor: simulated seconds per second, 0: as fast as the machine can.
        by_relay: the Operator reaches the robot through the relay that has the link's faults, and time waits for no
            answer of his; else it waits.
        is_simulated: stamps are of the simulated clock; else of one of the machine that is set.
        has_small_disk: the nodes write to a disk of its own, which can be filled.
        hears_car: the application listens to the Car's bus.
        has_receiver: of satellites, which the simulator has not.
    """

    arguments: Dict[str, str] = field(default_factory=dict)
    variables: Dict[str, str] = field(default_factory=dict)
    parameters: Dict[str, float] = field(default_factory=dict)
    real_time_factor: float = 0.0
    by_relay: bool = False
    is_simulated: bool = True
    has_small_disk: bool = False
    hears_car: bool = False
    has_receiver: bool = False


# As the nodes of a robot: who has ended is started again.
_RESPAWN = {"respawn": "true"}
# As setup/robot/start does it; each robot has a master of its own.
_CLOSED = {name: value for name, value in closed_environment({}).items() if name != "ROS_MASTER_URI"}
ROBOTS = {
    LOCKSTEP: RobotKind(),
    # The link's delays are of the wall clock, and so is the start of a node.
    PACED: RobotKind(_RESPAWN, real_time_factor=1.0, by_relay=True),
    CAR_BUS: RobotKind(_RESPAWN, real_time_factor=1.0, by_relay=True, hears_car=True),
    MACHINE_CLOCK: RobotKind({**_RESPAWN, "machine_clock": "true"}, real_time_factor=1.0, by_relay=True,
                             is_simulated=False),
    # In lock-step the simulator waits for drive control's own word; a guard before the base goes by the wall clock.
    GUARDED: RobotKind({**_RESPAWN, "machine_clock": "true", "graph_watch": "true", "base_guard": "true"}, _CLOSED,
                       real_time_factor=1.0, by_relay=True, is_simulated=False),
    # Room on a disk is asked for by the wall clock, which simulated time must not run away from.
    SMALL_DISK: RobotKind(parameters=SMALL_DISK_LIMITS, real_time_factor=1.0, has_small_disk=True),
    SATELLITES: RobotKind(has_receiver=True),
}


@contextlib.contextmanager
def small_disk(folder: pathlib.Path) -> Iterator[None]:
    """A disk of its own at a folder, which is made; subprocess.CalledProcessError for who may not mount one."""
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={SMALL_DISK_SIZE}", "tmpfs", str(folder)], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)
