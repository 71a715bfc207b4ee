"""Parameters of the manual controller."""
# SPDX-License-Identifier: Apache-2.0
from dataclasses import dataclass
from typing import Tuple

from mtr_core.errors import ConfigurationError, check_range
from mtr_core.parameters import ParameterSet, number

MAX_INDEX = 31


@dataclass(frozen=True)
class Parameters(ParameterSet):
    """Start parameters of the node. Buttons and axes are indices of sensor_msgs/Joy.

    The defaults fit the Jackal's PS4 controller: hold L1 to drive slowly, R1 to drive fast. Circle is the emergency
    stop, share and options together release it; up and down on the cross move the lift.

    Attributes:
        slow_button: dead-man button for slow driving.
        fast_button: dead-man button for fast driving.
        e_stop_button: engages the motion lock at once.
        release_buttons: exactly these buttons held for release_after_s release the lock.
        linear_axis: forward is positive.
        angular_axis: counterclockwise is positive.
        lift_axis: up is positive.
        slow_mps, slow_radps: velocities at full deflection with the slow button.
        fast_mps, fast_radps: the same with the fast button; drive control's limits with the key raised.
        lift_mps: speed of the lift while its axis is deflected and a dead-man button held.
        dead_zone: deflection below which an axis counts as released.
        silent_after_s: age of the newest message at which the controller is lost; its driver publishes every 0.04 s.
            Together with the stopping time it yields the 0.5 s of docs/robot-motion.md.
        frozen_after_s: time without a change after which a controller that drives is lost. No hand is that still, but a
            driver may repeat the last message of a lost controller (joystick_drivers issue 92).
        heartbeat_after_s: age of the newest report, of motion sensors or raw, at which a controller that also reports
            while idle is lost; see presence/.
        release_after_s: see release_buttons.
        driver: name of the node that publishes /joy; empty: any node, as long as it is the only one.
        device: path of the controller's device, e.g. /dev/input/js0; the controller is lost when it disappears. Empty:
            not checked.
    """

    slow_button: int = number(4, 0, MAX_INDEX)
    fast_button: int = number(5, 0, MAX_INDEX)
    e_stop_button: int = number(1, 0, MAX_INDEX)
    release_buttons: Tuple[int, ...] = (8, 9)
    linear_axis: int = number(1, 0, MAX_INDEX)
    angular_axis: int = number(0, 0, MAX_INDEX)
    lift_axis: int = number(7, 0, MAX_INDEX)
    slow_mps: float = number(0.4, 0.05, 2.0, "m/s")
    slow_radps: float = number(0.6, 0.05, 3.0, "rad/s")
    fast_mps: float = number(0.75, 0.05, 2.0, "m/s")
    fast_radps: float = number(1.2, 0.05, 3.0, "rad/s")
    lift_mps: float = number(0.1, 0.01, 0.5, "m/s")
    dead_zone: float = number(0.05, 0.0, 0.5)
    silent_after_s: float = number(0.1, 0.08, 2.0, "s")
    frozen_after_s: float = number(2.0, 0.2, 60.0, "s")
    heartbeat_after_s: float = number(0.3, 0.1, 2.0, "s")
    release_after_s: float = number(1.0, 0.2, 10.0, "s")
    driver: str = ""
    device: str = ""

    def __post_init__(self) -> None:
        super().__post_init__()
        for button in self.release_buttons:
            check_range("release_buttons", button, 0, MAX_INDEX)
        check_range("length of release_buttons", len(self.release_buttons), 2, 4)
        buttons = (self.slow_button, self.fast_button, self.e_stop_button, *self.release_buttons)
        axes = (self.linear_axis, self.angular_axis, self.lift_axis)
        if len(set(buttons)) < len(buttons) or len(set(axes)) < len(axes):
            raise ConfigurationError("All buttons must differ, and so must all axes; they are "
                                     f"{', '.join(map(str, buttons))} and {', '.join(map(str, axes))}.")
