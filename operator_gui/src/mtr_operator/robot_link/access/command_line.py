"""The commands `pair` and `keys`."""
# SPDX-License-Identifier: Apache-2.0
from __future__ import annotations

import argparse

from mtr_operator.domain.errors import OperatorError
from mtr_proto.keys import fingerprint

from .key_chain import KeyChain
from .pairing import pair


def pair_with(options: argparse.Namespace) -> None:
    """Pair with the robot that shows a code; OperatorError states why it failed."""
    code = options.code or _asked("Code that the robot shows: ")
    robot = pair(options.host, code, options.name or "", options.port)
    print(f"Paired with {robot.host} as {robot.role}; the robot's key: {fingerprint(robot.key)}")


def show_keys(options: argparse.Namespace) -> None:
    """Print this laptop's key and the paired robots, or forget one."""
    chain = KeyChain()
    if options.forget:
        if not chain.forget(options.forget):
            raise OperatorError(f"No robot at {options.forget} is paired; mtr-operator keys lists those that are.")
        print(f"Forgotten: {options.forget}. The robot still knows this laptop until its key is revoked there.")
        return
    print(f"This laptop's key: {fingerprint(chain.own_keys().public.decode('ascii'))}")
    robots = chain.robots()
    width = max((len(robot.host) for robot in robots), default=0)
    for robot in robots:
        print(f"{robot.host:{width}}  {robot.role:10}  {robot.date}  {fingerprint(robot.key)}")
    if not robots:
        print("No robot is paired.")


def _asked(question: str) -> str:
    try:
        return input(question)
    except EOFError:
        raise OperatorError("No code was given; type it, or say --code.") from None
