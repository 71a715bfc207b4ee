"""Self-check on demand: compares the Car's position with the mapped one."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib

from mtr_operator.domain.absent_car import AbsentCarLink
from mtr_operator.domain.actions.control_loop import ControlLoop
from mtr_operator.domain.actions.preparation import check_car, prepare_to_check
from mtr_operator.domain.actions.robot import Robot
from mtr_operator.domain.errors import RobotFailed
from mtr_operator.domain.robot_status import CheckState
from mtr_operator.terminal import show

from ..display import Display
from ..enter import Enter
from ..interrupt import Interrupt
from ..links import robot_link
from ..release import Release

_SPEED_MPS = 0.5


def check(options: argparse.Namespace) -> None:
    """Let the robot check the Car and print the result; RobotFailed if the Car has moved."""
    with contextlib.closing(Display(None)) as display, contextlib.closing(robot_link(options)) as link, \
            Interrupt() as interrupt:
        link.connect()
        loop = ControlLoop(link, AbsentCarLink("The Car's bus is not connected."), display, interrupt.is_requested,
                           Release(display.say, Enter()))
        robot = Robot(loop)
        try:
            prepare_to_check(loop, robot)
            robot.set_maximum_speed(_SPEED_MPS)
            found = check_car(robot)
        finally:
            loop.halt()
    if found is None:
        raise RobotFailed("The robot's software is too old to check where the Car stands.")
    if found.state is CheckState.FAILED:
        raise RobotFailed(found.message)
    show(found.message)
