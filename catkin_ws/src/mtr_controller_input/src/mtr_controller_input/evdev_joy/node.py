"""Publishes sensor_msgs/Joy from a Linux input device: on each change, and as a sign of life while it is there."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import select
from dataclasses import dataclass
from typing import Iterator, Optional, Tuple

import evdev
import rospy
from sensor_msgs.msg import Joy

from mtr_core import names
from mtr_core.parameters import ParameterSet, number
from mtr_lockstep import run_node

from .gamepad import EV_ABS, EV_KEY, AxisRange, Gamepad, is_gamepad

SEARCH_AGAIN_S = 1.0


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """What the node is started with.

    Attributes:
        device: path of the controller, e.g. /dev/input/event5; empty: the first gamepad that is found.
        alive_period_s: a controller that is there and still is published again after so long.
    """

    device: str = ""
    alive_period_s: float = number(0.04, 0.01, 0.1, "s")


class EvdevJoyNode:
    """Searches a controller, reads it until it is gone, and searches again. Says nothing while there is none."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._joy = rospy.Publisher(names.JOY, Joy, queue_size=10, tcp_nodelay=True)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            device = find(self._parameters.device)
            if device is None:
                rospy.logwarn_once("There is no game controller yet.")
                rospy.rostime.wallsleep(SEARCH_AGAIN_S)
                continue
            rospy.loginfo("Game controller: %s, %s.", device.name, device.path)
            with contextlib.closing(device):
                self._read(device)
            rospy.logwarn("The game controller is gone.")

    def _read(self, device: evdev.InputDevice) -> None:
        """Publish until the device is gone."""
        gamepad = Gamepad(*_shape(device))
        while not rospy.is_shutdown():
            try:
                ready, _, _ = select.select([device.fd], [], [], self._parameters.alive_period_s)
                events = device.read() if ready else ()
                changed = [gamepad.take(event.type, event.code, event.value) for event in events]
                # Asking it for its state fails when it is gone, though nothing was to be read.
                device.absinfo(0)
            except OSError:
                return
            if any(changed) or not ready:
                self._publish(gamepad)

    def _publish(self, gamepad: Gamepad) -> None:
        message = Joy()
        message.header.stamp = rospy.Time.now()
        message.axes, message.buttons = gamepad.state()
        self._joy.publish(message)


def find(path: str) -> Optional[evdev.InputDevice]:
    """The controller, None when there is none."""
    for candidate in [path] if path else sorted(evdev.list_devices()):
        with contextlib.suppress(OSError):
            device = evdev.InputDevice(candidate)
            axes, buttons, _ = _shape(device)
            if is_gamepad(axes, buttons):
                return device
            device.close()
    return None


def _shape(device: evdev.InputDevice) -> Tuple[dict, list, dict]:
    """Axes with their ranges, buttons, and the axes' present values."""
    capabilities = device.capabilities()
    infos = dict(capabilities.get(EV_ABS, []))
    axes = {code: AxisRange(info.min, info.max, info.flat) for code, info in infos.items()}
    return axes, list(_codes(capabilities.get(EV_KEY, []))), {code: info.value for code, info in infos.items()}


def _codes(keys: list) -> Iterator[int]:
    for key in keys:
        yield key if isinstance(key, int) else key[0]


def main() -> int:
    """Run the node; its exit status."""
    return run_node("evdev_joy", Parameters, EvdevJoyNode)
