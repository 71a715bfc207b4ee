"""Topics of the firmware, both for the one simulated in this process and for the emulated one."""
# SPDX-License-Identifier: Apache-2.0
import io
import pathlib
from typing import Any, Callable, List, Tuple, Union

from mtr_core import names
from mtr_core.lockstep import direct_publisher
from mtr_core.schedule import FIRMWARE, slot
from mtr_msgs.msg import (
    FirmwareCalibrate,
    FirmwareCommand,
    FirmwareEcho,
    FirmwareHealth,
    FirmwareInputs,
    FirmwarePress,
    FirmwareSignals,
    FirmwareState,
)
from mtr_serial_link.connections import md5_of

from ..conversions import firmware_message, inputs_message
from .emulated import EmulatedFirmware
from .simulated import SimulatedFirmware

MCU = "atmega2560"
INPUTS = slot(80)
# Topic, type of its messages, and their handler.
Subscription = Tuple[str, Any, Callable[[Any], None]]


def emulated_firmware(elf: str) -> EmulatedFirmware:
    """Return the firmware in a file on an emulated microcontroller that is not powered yet."""
    # The emulator is only installed on a developer's machine.
    from mtr_emulator import Emulator

    return EmulatedFirmware(Emulator(MCU, stepped=True, elf=pathlib.Path(elf)), md5_of)


def firmware_topics(firmware: Union[SimulatedFirmware, EmulatedFirmware]) -> "Union[SimulatedTopics, EmulatedTopics]":
    """Return the topics of either firmware."""
    return EmulatedTopics(firmware) if isinstance(firmware, EmulatedFirmware) else SimulatedTopics(firmware)


class SimulatedTopics:
    """Topics of the simulated firmware.

    Attributes:
        subscriptions: topics that the firmware receives.
        publishers: topics that the firmware publishes.
    """

    def __init__(self, firmware: SimulatedFirmware):
        self._firmware = firmware
        self._state = direct_publisher(names.FIRMWARE_STATE, FirmwareState)
        self._inputs = direct_publisher(names.FIRMWARE_INPUTS, FirmwareInputs)
        self.publishers = [self._state, self._inputs]
        self.subscriptions: List[Subscription] = [
            (names.FIRMWARE_COMMAND, FirmwareCommand, self._command),
            (names.FIRMWARE_PRESS, FirmwarePress, self._press),
            (names.FIRMWARE_SIGNALS, FirmwareSignals, self._signals),
        ]

    def _command(self, message: Any) -> None:
        self._firmware.command(message.lift_height_m, message.led_pattern, bool(message.stop), message.latest_us)

    def _press(self, message: Any) -> None:
        self._firmware.press(message.id, message.servos, message.strength, message.hold_ms, message.latest_us)

    def _signals(self, message: Any) -> None:
        self._firmware.signals(message.signal, bool(message.beacon), bool(message.stop_input), message.latest_us)

    def publish(self, time_ns: int) -> None:
        """Publish the firmware's reports that are due."""
        if INPUTS.last_at(time_ns) == time_ns:
            self._inputs.publish(inputs_message(self._firmware.input_state()))
        if FIRMWARE.last_at(time_ns) == time_ns:
            self._state.publish(firmware_message(self._firmware.state()))


class EmulatedTopics:
    """Topics of the emulated firmware, with messages from the serial line."""

    def __init__(self, firmware: EmulatedFirmware):
        self._firmware = firmware
        self._by_topic = {topic: direct_publisher(topic, message_type) for topic, message_type in (
            (names.FIRMWARE_STATE, FirmwareState), (names.FIRMWARE_HEALTH, FirmwareHealth),
            (names.FIRMWARE_ECHO, FirmwareEcho), (names.FIRMWARE_INPUTS, FirmwareInputs))}
        self.publishers = list(self._by_topic.values())
        self.subscriptions: List[Subscription] = [self._subscription(*each) for each in (
            (names.FIRMWARE_COMMAND, FirmwareCommand), (names.FIRMWARE_PRESS, FirmwarePress),
            (names.FIRMWARE_CALIBRATE, FirmwareCalibrate), (names.FIRMWARE_SIGNALS, FirmwareSignals))]

    def publish(self, time_ns: int) -> None:
        """Publish the firmware's messages of this tick."""
        for topic, payload in self._firmware.take_messages():
            publisher = self._by_topic.get(topic)
            if publisher:
                publisher.publish(publisher.data_class().deserialize(payload))

    def _subscription(self, topic: str, message_type: Any) -> Subscription:
        def send(message: Any) -> None:
            buffer = io.BytesIO()
            message.serialize(buffer)
            self._firmware.send(topic, buffer.getvalue())
        return topic, message_type, send
