"""Parameters of the dispatcher."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.parameters import ParameterSet, number

from .access.curve import is_loopback
from .area.order import corners_from
from .disks.room import FULL_MB


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Start parameters of the dispatcher.

    Attributes:
        bind_address: address on which both ports listen; "0.0.0.0" for all interfaces.
        status_port: TCP port on which Status is published.
        command_port: TCP port on which Command is received.
        lockstep_operator: simulated time waits for the application's answer to each Status.
        operator_lost_after_wall_s: wall time after which it stops waiting.
        link_timeout_s: silence after which the robot stops at the latest; it may stop one period earlier.
        fast_link_timeout_s: the same while the planner drives faster than fast_mps.
        fast_mps: see fast_link_timeout_s; above slow_link_mps by the amount that the speed may exceed its limit.
        slow_after_s: silence after which the maximum speed is lowered to slow_link_mps, until the application has
            answered a newer Status.
        slow_link_mps: maximum speed after slow_after_s.
        command_lifetime_s: age of the answered Status at which a Command has expired.
        takeover_after_s: silence of the application in control after which another may take over.
        default_speed_mps: maximum speed when a Command has none; not above platform_speed_mps.
        platform_speed_mps: highest maximum speed that a Command may request (Jackal data sheet).
        low_battery: charge, 0 to 1, below which the Operator is warned.
        emergency_stop: the software can read the robot's emergency stop; a silent one counts as engaged.
        warn_without_emergency_stop: notify the Operator that the robot has none.
        encrypt_on_loopback: CURVE also on a loopback address; on any other address it is always on.
        allow_unencrypted: no CURVE on other addresses either; robot and window show a red warning.
        key_folder: folder of the robot's key pair and the list of paired keys; empty for mtr_link in $ROS_HOME.
        max_commands_per_s: rate of Commands that are processed per key.
        memory_limit_mib: memory of the process at which all connections of the link are cut off.
        memory_folder: folder in which localization and Car locator store their memory, checked for disk space like
            the folders of ROS and its logs; empty: they store nothing.
        full_disk_mb: free space below which a disk counts as full: the Operator is notified, and no test begins.
        disk_period_s: wall time between two checks of the disks.
        simulated: the robot is simulated; a real one neither maps nor tests without a test area.
        test_area_xy: corners x, y, x, y, ... of the test area in m, in the frame of the robot at its start (x
            ahead, y to the left); empty: the Operator draws it.
        service_folder: folder of the file that stores service mode; empty: mtr_service in $ROS_HOME, and for a
            simulated robot the ROS master until the robot ends.
        service_release_s: time for which each of the two agreements to leave service mode counts.
    """

    bind_address: str = "127.0.0.1"
    status_port: int = number(3334, 1, 65535)
    command_port: int = number(3333, 1, 65535)
    lockstep_operator: bool = False
    operator_lost_after_wall_s: float = number(5.0, 0.1, 60.0, "s")
    link_timeout_s: float = number(1.0, 0.4, 5.0, "s")
    fast_link_timeout_s: float = number(0.8, 0.4, 5.0, "s")
    fast_mps: float = number(0.35, 0.05, 2.0, "m/s")
    slow_after_s: float = number(0.4, 0.2, 5.0, "s")
    slow_link_mps: float = number(0.3, 0.05, 2.0, "m/s")
    command_lifetime_s: float = number(1.0, 0.2, 5.0, "s")
    takeover_after_s: float = number(3.0, 1.0, 60.0, "s")
    default_speed_mps: float = number(0.5, 0.05, 2.0, "m/s")
    platform_speed_mps: float = number(2.0, 0.05, 2.0, "m/s")
    low_battery: float = number(0.2, 0.0, 1.0)
    emergency_stop: bool = False
    warn_without_emergency_stop: bool = True
    encrypt_on_loopback: bool = False
    allow_unencrypted: bool = False
    key_folder: str = ""
    max_commands_per_s: float = number(500.0, 50.0, 10000.0, "1/s")
    memory_limit_mib: int = number(400, 150, 4000, "MiB")
    memory_folder: str = ""
    full_disk_mb: float = number(FULL_MB, 1.0, 100000.0, "MB")
    disk_period_s: float = number(10.0, 0.05, 600.0, "s")
    simulated: bool = False
    test_area_xy: Tuple[float, ...] = ()
    service_folder: str = ""
    service_release_s: float = number(60.0, 10.0, 300.0, "s")

    def __post_init__(self) -> None:
        super().__post_init__()
        corners_from(self.test_area_xy)
        check_range("default_speed_mps", self.default_speed_mps, 0.05, self.platform_speed_mps, "m/s")
        if self.status_port == self.command_port:
            raise ConfigurationError(f"Parameters status_port and command_port are both {self.status_port}; "
                                     "they must differ.")
        if self.allow_unencrypted and self.encrypt_on_loopback:
            raise ConfigurationError("Parameters allow_unencrypted and encrypt_on_loopback are both true; they "
                                     "contradict each other.")

    @property
    def is_encrypted(self) -> bool:
        """True if only paired keys may use the link."""
        return self.encrypt_on_loopback or not (is_loopback(self.bind_address) or self.allow_unencrypted)

    @property
    def is_exposed(self) -> bool:
        """True if every computer in the network may use the link."""
        return not self.is_encrypted and not is_loopback(self.bind_address)
