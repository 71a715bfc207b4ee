"""Service mode on demand: disable wheels, lift and servos for work on the robot, or release them."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse
import contextlib
import sys

from mtr_operator.domain.actions.trouble import Cancelled
from mtr_operator.domain.robot_status import ServiceState
from mtr_operator.domain.supervision.service_order import ServiceOrder
from mtr_operator.terminal import show

from ..interrupt import Interrupt
from ..links import robot_link

QUESTION = ("See that nobody works at mast, lift, servos or wheels. Press Enter to release service mode, Ctrl-C to "
            "leave it active.")
ENDED = "Service mode has ended. Nothing moves before the next order."
INACTIVE = "The robot is not in service mode."


def order_service(options: argparse.Namespace) -> None:
    """Enter or leave service mode, or print its state; RobotFailed if the robot does not follow."""
    if options.order == "leave":
        _confirm()
    with contextlib.closing(robot_link(options)) as link, Interrupt() as interrupt:

        def look() -> None:
            if interrupt.is_requested():
                raise Cancelled("Interrupted; service mode is as the robot reports it.")

        link.connect()
        order = ServiceOrder(link, look)
        state = order.enter() if options.order == "enter" else order.state()
        if options.order == "leave" and state.is_active:
            order.leave(show)
            show(ENDED)
        else:
            show(text_of(state))


def text_of(state: ServiceState) -> str:
    """Return the state and its reason."""
    return state.text if state.is_active else INACTIVE


def _confirm() -> None:
    show(QUESTION)
    # The end of the input does not confirm.
    if not sys.stdin.readline():
        raise Cancelled("Nobody has confirmed; service mode remains active.")
