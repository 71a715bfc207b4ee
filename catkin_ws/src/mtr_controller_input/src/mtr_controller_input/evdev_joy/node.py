"""Publishes sensor_msgs/Joy from a Linux input device: on each change, and as a sign of life while it exists."""
# SPDX-License-Identifier: Apache-2.0
import contextlib
import time
from dataclasses import dataclass

import evdev
import rospy
from sensor_msgs.msg import Joy

from mtr_core import names
from mtr_core.lockstep import run_node
from mtr_core.parameters import ParameterSet, number

from ..presence.presence import Presence
from .device import State, find, states

SEARCH_AGAIN_S = 1.0


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Start parameters of the node.

    Attributes:
        device: path of the controller, e.g. /dev/input/event5; empty: the first gamepad found.
        alive_period_s: period of publication for a controller whose state does not change.
        heartbeat_after_s: age of the newest report at which a controller that also reports while idle is lost.
    """

    device: str = ""
    alive_period_s: float = number(0.04, 0.01, 0.1, "s")
    heartbeat_after_s: float = number(0.3, 0.1, 2.0, "s")


class EvdevJoyNode:
    """Searches for a controller, reads it until it is gone, and searches again. Without one it publishes nothing."""

    def __init__(self, parameters: Parameters):
        self._parameters = parameters
        self._joy = rospy.Publisher(names.JOY, Joy, queue_size=10, tcp_nodelay=True)

    def spin(self) -> None:
        """Run until shutdown."""
        while not rospy.is_shutdown():
            path = self._parameters.device
            device = find([path] if path else sorted(evdev.list_devices()))
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
        before: State = ([], [])
        with contextlib.closing(Presence(device.path, self._parameters.heartbeat_after_s)) as presence:
            for state in states(device, self._parameters.alive_period_s):
                if rospy.is_shutdown():
                    return
                # The manual controller detects the loss by the silence.
                if presence.update(time.monotonic(), is_idle=state == before):
                    self._publish(state)
                before = state

    def _publish(self, state: State) -> None:
        message = Joy()
        message.header.stamp = rospy.Time.now()
        message.axes, message.buttons = state
        self._joy.publish(message)


def main() -> int:
    """Run the node and return its exit status."""
    return run_node("evdev_joy", Parameters, EvdevJoyNode)
