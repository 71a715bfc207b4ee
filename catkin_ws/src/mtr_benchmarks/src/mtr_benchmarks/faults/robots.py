"""Kinds of robots on which cells are run: their time base and their link to the Operator. No ROS inside."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import pathlib
import subprocess
from dataclasses import dataclass, field
from typing import Dict, Iterator

from mtr_graph_watch.environment import closed_environment

from .matrix import CAR_BUS, GUARDED, LOCKSTEP, MACHINE_CLOCK, PACED, SATELLITES, SMALL_DISK

# Size of the disk that is filled, with room for logs until then.
SMALL_DISK_SIZE = "24m"
# The disk counts as full below this free space, MB; the check period is in s of wall time and short, because a fault
# lasts 2 s.
SMALL_DISK_LIMITS = {"/dispatcher/full_disk_mb": 2.0, "/dispatcher/disk_period_s": 0.1}


@dataclass(frozen=True)
class RobotKind:
    """One kind of robot.

    Attributes:
        arguments: arguments of sim.launch. variables: environment variables.
        parameters: node parameters, by their full names.
        real_time_factor: simulated seconds per second; 0: as fast as possible.
        by_relay: the Operator reaches the robot through the relay that injects link faults, and simulated time does not
            wait for his answers; else it does.
        is_simulated: stamps are of the simulated clock; else of the machine's adjustable clock.
        has_small_disk: the nodes write to a separate disk, which can be filled.
        hears_car: the application receives the Car's bus.
        has_receiver: the robot has a satellite receiver, which the simulator does not provide.
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


# Nodes that have ended are restarted, as on a robot.
_RESPAWN = {"respawn": "true"}
# Environment of setup/robot/start; each robot has its own master.
_CLOSED = {name: value for name, value in closed_environment({}).items() if name != "ROS_MASTER_URI"}
ROBOTS = {
    LOCKSTEP: RobotKind(),
    # Delays of the link and starts of nodes are in wall time.
    PACED: RobotKind(_RESPAWN, real_time_factor=1.0, by_relay=True),
    CAR_BUS: RobotKind(_RESPAWN, real_time_factor=1.0, by_relay=True, hears_car=True),
    MACHINE_CLOCK: RobotKind({**_RESPAWN, "machine_clock": "true"}, real_time_factor=1.0, by_relay=True,
                             is_simulated=False),
    # In lock-step the simulator waits for drive control's own message; the base guard uses wall time.
    GUARDED: RobotKind({**_RESPAWN, "machine_clock": "true", "graph_watch": "true", "base_guard": "true"}, _CLOSED,
                       real_time_factor=1.0, by_relay=True, is_simulated=False),
    # Free disk space is checked by wall time, so simulated time must not run faster.
    SMALL_DISK: RobotKind(parameters=SMALL_DISK_LIMITS, real_time_factor=1.0, has_small_disk=True),
    SATELLITES: RobotKind(has_receiver=True),
}


@contextlib.contextmanager
def small_disk(folder: pathlib.Path) -> Iterator[None]:
    """Mount a small disk at a folder, which is created.

    Raises:
        subprocess.CalledProcessError: the permission to mount is missing.
    """
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={SMALL_DISK_SIZE}", "tmpfs", str(folder)], check=True)
    try:
        yield
    finally:
        subprocess.run(["umount", "--lazy", str(folder)], check=True)
