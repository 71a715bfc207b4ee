"""What a board sends, at the host's session; the board's end of the line is firmware/tests/host/test_fuzz.cpp."""
# SPDX-License-Identifier: Apache-2.0
import pathlib
import random
import struct
from typing import Callable, List, Tuple

from spoiling import spoilt_bytes

from mtr_serial_link.board_topics import FIRMWARE_TOPICS, board_topics
from mtr_serial_link.frames import SerialFrame, encode
from mtr_serial_link.parameters import SerialParameters
from mtr_serial_link.session import SerialSession
from mtr_serial_link.wire import LogLine, ReservedId, TopicInfo, encode_log, encode_topic_info

MD5 = "0123456789abcdef0123456789abcdef"
STATE_ID = 101
INFOS = [TopicInfo(number, text.split()[1], text.split()[2], MD5, 512)
         for number, text in enumerate(FIRMWARE_TOPICS, STATE_ID)]
KINDS = [ReservedId.PUBLISHER if text.startswith("from") else ReservedId.SUBSCRIBER for text in FIRMWARE_TOPICS]
# Beyond it the host would answer more than it is asked.
MAX_ANSWER_FRAMES = 2


def prepare(_: pathlib.Path) -> Callable[[random.Random], Tuple[str, str]]:
    """The case of this border."""
    def case(chance: random.Random) -> Tuple[str, str]:
        session = SerialSession(SerialParameters(), lambda _: MD5, lambda: 1_000_000_000, board_topics(FIRMWARE_TOPICS))
        session.start(0.0)
        session.outbox.clear()
        frames = [frame(chance) for _ in range(chance.randint(1, 12))]
        data = b"".join(map(encode, frames))
        if chance.random() < 0.9:
            data = spoilt_bytes(chance, data, [encode(each) for each in frames])
        events, now_s = [], 0.0
        while data:
            size = chance.choice((1, 7, 64, 600))
            now_s += chance.choice((0.0, 0.001, 0.1))
            events += session.receive(data[:size], now_s)
            events += session.tick(now_s)
            data = data[size:]
        events += session.tick(now_s + 1.0)
        # Good frames afterwards are understood, whatever came before: the board says again what it is.
        events += session.receive(b"".join(encode(each) for each in described()), now_s + 2.0)
        session.tick(now_s + 3.0)
        return "taken" if any(event.message for event in events) else "refused", nonsense_in(session, events)
    return case


def described() -> List[SerialFrame]:
    """All that the board offers."""
    return [SerialFrame(kind, encode_topic_info(info)) for kind, info in zip(KINDS, INFOS)]


def frame(chance: random.Random) -> SerialFrame:
    """A good frame, or one with a payload as nobody would send it."""
    kind = chance.randrange(8)
    if kind < 2:
        return chance.choice(described())
    if kind == 2:
        info = chance.choice(INFOS)._replace(topic_id=chance.choice((0, 99, 100, 65535)),
                                             name=chance.choice(("", "/x", "a" * 300, "/firmware/state")),
                                             buffer_bytes=chance.choice((-1, 0, 2 ** 31 - 1)))
        return SerialFrame(chance.choice(KINDS), encode_topic_info(info))
    if kind == 3:
        return SerialFrame(ReservedId.LOG, encode_log(LogLine(chance.randrange(256), "word " * chance.randrange(40))))
    if kind == 4:
        return SerialFrame(chance.choice((ReservedId.TIME, ReservedId.PARAMETER, ReservedId.STOP)), bytes(8))
    if kind == 5:
        return SerialFrame(chance.choice((0, 1, 2, 3, 6, 7)), struct.pack("<HI", 200, 2 ** 32 - 1) + bytes(20))
    return SerialFrame(STATE_ID + chance.randrange(len(INFOS)), bytes(chance.randrange(256) for _ in range(
        chance.choice((0, 10, 100, 511)))))


def nonsense_in(session: SerialSession, events: List[object]) -> str:
    """What cannot be after good frames at the end."""
    known = {info.name for info in INFOS}
    if {each.info.name for each in session.endpoints.by_id.values()} != known:
        return f"endpoints {sorted(each.info.name for each in session.endpoints.by_id.values())}"
    if len(session.outbox) > 200:
        return f"{len(session.outbox)} frames wait for the board"
    return next((f"message of {event.message.topic_id}" for event in events
                 if event.message and event.message.topic_id < 100), "")
