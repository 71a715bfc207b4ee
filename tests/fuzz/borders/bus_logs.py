"""Logs of a CAN bus: read to their end, with a notice or a sentence where they are damaged."""
# SPDX-License-Identifier: Apache-2.0
import functools
import math
import pathlib
import random
import warnings
from typing import Callable, Dict, Tuple

import can
import can.io.player
from spoiling import spoilt_bytes, spoilt_text

from mtr_operator.car_link.log.read_log import ReadLog
from mtr_operator.domain.errors import ConnectionFailed

TEXTS = ("asc", "trc", "log", "csv")
KINDS = (*TEXTS, "blf", "db")
FRAMES = 40


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    whole = {kind: whole_log(folder / f"whole.{kind}") for kind in KINDS}
    warnings.simplefilter("ignore")
    # python-can looks through all that is installed for each log; what it finds does not change.
    can.io.player.read_entry_points = functools.lru_cache(None)(can.io.player.read_entry_points)

    def case(chance: random.Random) -> Tuple[str, str]:
        kind = chance.choice(KINDS)
        path = folder / f"case.{kind}"
        path.write_bytes(spoilt(chance, kind, whole))
        return outcome(path)
    return case


def outcome(path: pathlib.Path) -> Tuple[str, str]:
    """Result of a case: what became of a log, and why that cannot be."""
    count = 0
    try:
        for frame in ReadLog(path):
            count += 1
            if not (math.isfinite(frame.time_s) and 0 <= frame.can_id < 2 ** 29 and len(frame.data) <= 64):
                return "taken", f"{path.name}: {frame}"
    except ConnectionFailed as error:
        return "refused", "" if str(error).endswith(".") else str(error)
    return "taken", "" if count else f"{path.name}: no frame and no sentence"


def spoilt(chance: random.Random, kind: str, whole: Dict[str, bytes]) -> bytes:
    """A log of a kind, made wrong as its kind is read."""
    if kind in TEXTS and chance.random() < 0.7:
        return spoilt_text(chance, whole[kind].decode("utf-8")).encode("utf-8", "surrogateescape")
    return spoilt_bytes(chance, whole[kind], (whole[chance.choice(KINDS)],))


def whole_log(path: pathlib.Path) -> bytes:
    """Write a good log of the kind that the path ends with, and return its bytes."""
    with can.Logger(str(path)) as log:
        for number in range(FRAMES):
            log.on_message_received(can.Message(
                timestamp=1.7e9 + 0.1 * number, arbitration_id=0x123 + number, is_extended_id=number % 3 == 0,
                data=bytes(range(number % 9)), channel=0))
    return path.read_bytes()
