"""The four messages of a pairing, at both ends: whoever has not the code, or changes a byte, pairs nobody."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
from typing import Callable, Tuple

import zmq
from spoiling import spoilt_bytes

from mtr_proto.pairing import LaptopSide, PairingError, RobotSide

CODE = "123456"


def prepare(_: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border."""
    laptop_key, robot_key = zmq.curve_keypair()[0], zmq.curve_keypair()[0]
    old = LaptopSide(CODE, laptop_key, "old").hello()

    def case(chance: random.Random) -> Tuple[str, str]:
        laptop, robot = LaptopSide(CODE, laptop_key, "Jana"), RobotSide(CODE, robot_key)
        wrong = chance.choice(("hello", "answer", "proof", "welcome"))

        def passed(name: str, data: bytes) -> bytes:
            return data if name != wrong else spoilt_bytes(chance, data, (old,))
        try:
            hello = laptop.hello()
            said, answer = robot.answer(passed("hello", hello))
            proof = laptop.proof(passed("answer", answer))
            welcome = robot.welcome(passed("proof", proof), "controller")
            came = passed("welcome", welcome)
            paired = laptop.welcomed(came)
        except PairingError as error:
            return "refused", "" if str(error).endswith(".") else f"no sentence: {error}"
        is_right = said.public_key.encode() == laptop_key and paired.robot_key.encode() == robot_key
        # A change may take itself back; then both ends have what they meant.
        return "paired", "" if is_right and said.name == "Jana" else f"{said} {paired} after a changed {wrong}"
    return case
