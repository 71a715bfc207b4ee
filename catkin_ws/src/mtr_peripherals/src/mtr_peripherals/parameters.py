"""Parameters of the peripherals' node."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.parameters import ParameterSet, number

from .calibration import Calibration


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Start parameters of the node.

    Attributes:
        firmware_silent_after_s: age of the newest FirmwareState at which the robot brakes at the latest, because the
            firmware has failed. The silence is reported 0.28 s earlier, for the ticks of three nodes and the reaction
            of the wheels.
        order_silent_after_s: age at which DesiredState and RobotMode are no longer valid.
        emergency_silent_after_s: age of an emergency stop's message at which it counts as engaged; its period is 0.1 s.
        emergency_owners: required emergency stops; any other one counts from its first message on.
        battery_silent_after_s: age at which the battery's charge is unknown.
        emulated_firmware: in simulation, the flashed firmware runs on an emulated board; its clock starts at another
            time, and its reports are delayed.
        stop_input: a stop chain is connected to the board's stop input; an open or silent input is a stop. It has its
            own topic, which must be in drive control's e_stop_topics.
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
