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
    """What the dispatcher is started with.

    Attributes:
        bind_address: address on which both ports listen; "0.0.0.0" for all interfaces.
        status_port: TCP port on which Status is published.
        command_port: TCP port on which Command is received.
        lockstep_operator: in lock-step time waits for the application's answer to each Status.
        operator_lost_after_wall_s: wall time after which it stops waiting.
        link_timeout_s: silence after which the robot stops at the latest; one turn earlier it may.
        fast_link_timeout_s: the same while the planner drives faster than fast_mps.
        fast_mps: see there; above slow_link_mps, by what the speed may exceed its limit.
        slow_after_s: silence after which the maximum speed is lowered to slow_link_mps, until the application has
            answered a newer Status.
        slow_link_mps: maximum speed then.
        command_lifetime_s: age of the answered Status at which a Command has expired.
        takeover_after_s: silence of the application in control after which another may take over.
        default_speed_mps: maximum speed when a Command names none; not above platform_speed_mps.
        platform_speed_mps: highest maximum speed that a Command may ask for (Jackal data sheet).
        low_battery: charge below which the Operator is warned.
        emergency_stop: the robot has one that its software sees; one that is silent counts as engaged.
        warn_without_emergency_stop: the Operator reads that there is none.
        encrypt_on_loopback: CURVE also where only this computer reaches the link; elsewhere it is always on.
        allow_unencrypted: no CURVE on another address either; robot and window say so in red.
        key_folder: of the robot's key pair and the list of paired keys; empty for mtr_link in $ROS_HOME.
        max_commands_per_s: Commands of one key that are looked at.
        memory_limit_mib: memory of the process at which all connections of the link are cut off.
        memory_folder: of localization and Car locator; with those of ROS and of its logs it is one of those whose disk
            may not be full; empty: they remember nothing.
        full_disk_mb: free space below which the Operator reads that a disk is full, and no test begins.
        disk_period_s: wall time between two looks at it.
        simulated: the robot is simulated; a real one neither maps nor tests without a test area.
        test_area_xy: corners x, y, x, y, ... of the test area in m, in the frame in which the robot stands at its start
            (x ahead, y to the left); empty: the Operator draws it.
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
        """True when only paired keys may use the link."""
        return self.encrypt_on_loopback or not (is_loopback(self.bind_address) or self.allow_unencrypted)

    @property
    def is_exposed(self) -> bool:
        """True when whoever is in the network may use it."""
        return not self.is_encrypted and not is_loopback(self.bind_address)
