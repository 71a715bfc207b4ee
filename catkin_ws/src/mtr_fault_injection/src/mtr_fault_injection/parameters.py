"""Parameters of the node fault_injection."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core import names
from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the node is started with.

    Attributes:
        simulated: the hardware is the simulator's, which can have faults of its own.
        seed: of whatever is random in a fault.
        front_scan, rear_scan, imu_data, wheel_odometry, navsat_fix, battery, firmware_state: topics of the drivers;
            what is said there goes on under /fault_injection.
        status_port, command_port: of the robot's link, on 127.0.0.1.
        relay_status_port, relay_command_port: where the relay of the link listens on 127.0.0.1; 0: there is none.
        clock_file: through which the clock of the nodes is set, see set_clock.py; empty: it cannot be.
        disk_folder: whose disk may be filled; empty: none.
        disk_limit_mib: free space of a disk that is filled at most.
    """

    simulated: bool = False
    seed: int = number(1, 0, 2**31 - 1)
    front_scan: str = names.FRONT_SCAN
    rear_scan: str = names.REAR_SCAN
    imu_data: str = names.IMU_DATA
    wheel_odometry: str = names.WHEEL_ODOMETRY
    navsat_fix: str = names.NAVSAT_FIX
    battery: str = names.BATTERY
    firmware_state: str = names.FIRMWARE_STATE
    status_port: int = number(3334, 1, 65535)
    command_port: int = number(3333, 1, 65535)
    relay_status_port: int = number(4334, 0, 65535)
    relay_command_port: int = number(4333, 0, 65535)
    clock_file: str = ""
    disk_folder: str = ""
    disk_limit_mib: int = number(1024, 1, 65536, "MiB")
