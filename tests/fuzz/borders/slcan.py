"""Lines of an slcan adapter at its driver, and what becomes of the frames that it takes."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
import re
from typing import Callable, List, Tuple

from spoiling import spoilt_bytes

from mtr_operator.car_link.can_frame import CanFrame
from mtr_operator.car_link.drivers.slcan import StampedSlcanBus
from mtr_operator.car_link.message_table import MessageTable
from mtr_operator.car_link.profile import CarProfile, load_profile, profile_names

# As the manual of the Lawicel CAN232 has it: kind, identifier, and nothing but digits to the end of the line.
FRAME = re.compile(rb"([trdb][0-7][0-9A-Fa-f]{2}|[TRDB][01][0-9A-Fa-f]{7})[0-9A-Fa-f]+")
LINE_END = re.compile(rb"[\r\a]")
FD_BYTES = (*range(9), 12, 16, 20, 24, 32, 48, 64)
MAX_LINES = 64
DIGITS = b"0123456789ABCDEF"


def prepare(_: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border."""
    profiles = [load_profile(name) for name in profile_names()]
    bus = StampedSlcanBus("loop://", bitrate=500_000)

    def case(chance: random.Random) -> Tuple[str, str]:
        lines = [line(chance, profiles) for _ in range(chance.randint(1, 6))]
        data = b"".join(lines)
        if chance.random() < 0.8:
            data = spoilt_bytes(chance, data, lines)
        bus._buffer[:] = data + b"\r"
        table, words, nonsense, taken = MessageTable(), set(), "", 0
        for _ in range(data.count(b"\r") + data.count(b"\a") + 1):
            message, _ = bus._recv_internal(0.0)
            words.add("nothing" if message is None else "frame")
            if message is not None:
                taken += 1
                nonsense = nonsense or nonsense_in(message, bus.stamp_ms) or use(message, table, profiles, bus.stamp_ms)
        frames = sum(bool(FRAME.fullmatch(each)) for each in LINE_END.split(data))
        return " and ".join(sorted(words)), nonsense or ("" if taken <= frames else f"{taken} taken, {frames} there")
    return case


def line(chance: random.Random, profiles: List[CarProfile]) -> bytes:
    """A good line of some kind."""
    profile = chance.choice(profiles)
    kind = chance.choice("ttTrRdDbBzFvZ\r")
    if kind in "zFvZ\r":
        return {"F": b"F%02X\r" % chance.randrange(256), "v": b"v0102\r"}.get(kind, kind.encode() + b"\r")
    limit = 2 ** 29 if kind in "TRDB" else 2 ** 11
    can_id = chance.choice((profile.message.frame_id, chance.getrandbits(29))) % limit
    code = chance.randrange(16 if kind in "dDbB" else 9)
    data = b"" if kind in "rR" else bytes(chance.choice(DIGITS) for _ in range(2 * FD_BYTES[code]))
    stamp = chance.choice((b"", b"%04X" % chance.randrange(60_000)))
    return kind.encode() + (b"%08X" if kind in "TRDB" else b"%03X") % can_id + b"%X" % code + data + stamp + b"\r"


def nonsense_in(message: object, stamp_ms: object) -> str:
    """What cannot be of a frame."""
    limit = 2 ** 29 if message.is_extended_id else 2 ** 11
    size = len(message.data)
    if not 0 <= message.arbitration_id < limit or size not in FD_BYTES or (size > 8 and not message.is_fd):
        return f"{message}"
    return "" if stamp_ms is None or 0 <= stamp_ms < 60_000 else f"stamp {stamp_ms}"


def use(message: object, table: MessageTable, profiles: List[CarProfile], stamp_ms: object) -> str:
    """As the application does."""
    if message.is_error_frame or message.is_remote_frame:
        return ""
    table.frame(CanFrame(message.arbitration_id, message.is_extended_id, bytes(message.data), 1.0, stamp_ms))
    table.messages(2.0)
    for profile in profiles:
        reading = profile.decode(message.arbitration_id, message.is_extended_id, bytes(message.data))
        if reading is not None and not profile.is_message(message.arbitration_id, message.is_extended_id):
            return f"{reading} of another message: {message}"
    return ""
