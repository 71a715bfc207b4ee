"""Parameters of the peripherals' node."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.parameters import ParameterSet, number

from .calibration import Calibration


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the node is started with.

    Attributes:
        firmware_silent_after_s: age of the newest FirmwareState at which the robot brakes at the latest because the
            firmware has failed; that is told 0.28 s earlier, by ticks of three nodes and what the wheels take.
        order_silent_after_s: age of DesiredState and RobotMode at which they hold no longer.
        emergency_silent_after_s: age of an emergency stop's word at which it counts as engaged; it speaks every 0.1 s.
        emergency_owners: emergency stops that have to be heard; each other one counts from its first word on.
        battery_silent_after_s: age at which the battery's charge is unknown.
        emulated_firmware: in simulation, the firmware is the flashed one on an emulated board: its clock starts
            elsewhere, and its reports take time to come.
        stop_input: a stop chain is connected to the board's stop input; an open or silent input is a stop. It is
            reported on a topic of its own, which belongs to drive control's e_stop_topics.
        calibration: of the servos.
    """

    firmware_silent_after_s: float = number(1.0, 0.4, 5.0, "s")
    order_silent_after_s: float = number(0.5, 0.2, 5.0, "s")
    emergency_silent_after_s: float = number(0.5, 0.2, 2.0, "s")
    emergency_owners: Tuple[str, ...] = ()
    battery_silent_after_s: float = number(30.0, 1.0, 600.0, "s")
    emulated_firmware: bool = False
    stop_input: bool = False
    calibration: Calibration = Calibration()
