"""Bags of anybody: what is decided in them is read, or a sentence says why it cannot be."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
from typing import Callable, Tuple

import rosbag
import rospy
from spoiling import spoilt_bytes

from mtr_core import names
from mtr_msgs.msg import CarEstimate, LocalizedPose
from mtr_recording.bags import decisions_in, messages_in
from mtr_recording.profiles import CannotRecord

MESSAGES = 20


def prepare(folder: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border; folder: for its files."""
    whole = [_bag(folder / f"{compression}.bag", compression) for compression in ("none", "bz2", "lz4")]

    def case(chance: random.Random) -> Tuple[str, str]:
        path = folder / "case.bag"
        path.write_bytes(spoilt_bytes(chance, chance.choice(whole), whole))
        words = set()
        for read in (lambda: decisions_in([path]), lambda: sum(1 for _ in messages_in(path))):
            try:
                read()
                words.add("taken")
            except CannotRecord as error:
                words.add("refused")
                if not str(error).endswith("."):
                    return "refused", f"no sentence: {error}"
        return " and ".join(sorted(words)), ""
    return case


def _bag(path: pathlib.Path, compression: str) -> bytes:
    with rosbag.Bag(str(path), "w", compression=compression) as bag:
        for number in range(MESSAGES):
            time = rospy.Time.from_sec(1000.0 + 0.1 * number)
            bag.write(names.LOCALIZED_POSE, LocalizedPose(valid=True), time)
            bag.write(names.CAR_ESTIMATE, CarEstimate(length=4.5, width=1.8), time)
    return path.read_bytes()
