"""Parameters of the node fault_injection."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core import names
from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Parameters of the node.

    Attributes:
        simulated: the hardware is the simulator's, which can have faults.
        seed: seed of random faults.
        front_scan, rear_scan, imu_data, wheel_odometry, navsat_fix, battery, firmware_state: topics of the drivers;
            they are relayed under /fault_injection.
        status_port, command_port: ports of the robot's link, on 127.0.0.1.
        relay_status_port, relay_command_port: ports of the link's relay on 127.0.0.1; 0: no relay.
        clock_file: file that sets the clock of the nodes, see set_clock.py; empty: the clock cannot be set.
        disk_folder: folder whose disk may be filled; empty: none.
        disk_limit_mib: largest free space that is filled.
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
