"""Parameters of the serial line to the firmware."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass

from mtr_core.parameters import ParameterSet, number


@dataclass(frozen=True)
class SerialParameters(ParameterSet):
    """Parameters of the line and its supervision.

    Attributes:
        baud: of the UART; 57600 is rosserial's default and exact within 0.8 % on a 16 MHz board.
        lost_after_s: time without a valid frame after which the device is lost.
        ask_every_s: period of topic requests to an unknown or lost device.
        frame_gap_s: pause after which an incomplete frame is given up; a device sends a frame without pauses.
        max_payload_bytes: larger frames are corrupt.
        service_timeout_s: time limit of a call.
    """

    baud: int = number(57600, 9600, 1000000, "baud")
    lost_after_s: float = number(1.0, 0.2, 10.0, "s")
    ask_every_s: float = number(0.5, 0.1, 5.0, "s")
    frame_gap_s: float = number(0.05, 0.005, 1.0, "s")
    max_payload_bytes: int = number(512, 64, 4096, "bytes")
    service_timeout_s: float = number(2.0, 0.1, 30.0, "s")
