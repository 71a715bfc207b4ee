"""The four messages of a pairing, at both ends: whoever has not the code, or changes a byte, pairs nobody."""
# SPDX-License-Identifier: Apache-2.0
import copy
import pathlib
import random
from typing import Any, Callable, Dict, NamedTuple, Tuple, TypeVar

import zmq
from spoiling import spoilt_bytes

from mtr_proto.pairing import Hello, LaptopSide, PairingError, RobotSide

CODE = "123456"
NAMES = ("hello", "answer", "proof", "welcome")
# Honest conversations of which one is gone on with: each costs some milliseconds of a curve, in Python.
BEGUN = 16
Side = TypeVar("Side", LaptopSide, RobotSide)


class Begun(NamedTuple):
    """An honest conversation up to a message: what the ends are before it is taken, the message, and what the robot has
    been told by then."""

    laptop: LaptopSide
    robot: RobotSide
    message: bytes
    said: Hello


def prepare(_: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border."""
    laptop_key, robot_key = zmq.curve_keypair()[0], zmq.curve_keypair()[0]
    old = LaptopSide(CODE, laptop_key, "old").hello()
    honest = [begun(laptop_key, robot_key) for _ in range(BEGUN)]

    def case(chance: random.Random) -> Tuple[str, str]:
        wrong, before = chance.choice(NAMES), chance.choice(honest)
        laptop, robot, message, said = before[wrong]
        laptop, robot = untouched(laptop), untouched(robot)
        taken: Any = spoilt_bytes(chance, message, (old,))
        try:
            for name in NAMES[NAMES.index(wrong):]:
                taken = passed(name, taken, laptop, robot)
                if name == "hello":
                    said, taken = taken
        except PairingError as error:
            return "refused", "" if str(error).endswith(".") else f"no sentence: {error}"
        is_right = said.public_key.encode() == laptop_key and taken.robot_key.encode() == robot_key
        # A change may take itself back; then both ends have what they meant.
        return "paired", "" if is_right and said.name == "Jana" else f"{said} {taken} after a changed {wrong}"
    return case


def begun(laptop_key: bytes, robot_key: bytes) -> Dict[str, Begun]:
    """An honest conversation, by the message that is to be taken next."""
    laptop, robot = LaptopSide(CODE, laptop_key, "Jana"), RobotSide(CODE, robot_key)
    message, said, found = laptop.hello(), Hello("", ""), {}
    for name in NAMES:
        found[name] = Begun(untouched(laptop), untouched(robot), message, said)
        answer = passed(name, message, laptop, robot)
        said, message = answer if name == "hello" else (said, answer)
    return found


def passed(name: str, message: bytes, laptop: LaptopSide, robot: RobotSide) -> Any:
    """What the end makes of a message for which it is."""
    if name == "hello":
        return robot.answer(message)
    if name == "proof":
        return robot.welcome(message, "controller")
    return laptop.proof(message) if name == "answer" else laptop.welcomed(message)


def untouched(side: Side) -> Side:
    """A copy that goes on by itself; its secret, too, serves one conversation only."""
    found = copy.copy(side)
    found._secret = copy.copy(side._secret)
    return found
