"""The device's side of the protocol in a few lines, for tests of the host's side."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict, List, Sequence, Tuple

from . import wire
from .frames import FrameParser, SerialFrame, encode


class FakeSerialDevice:
    """Answers negotiation and requests, as a microcontroller with these endpoints would.

    Attributes:
        endpoints: what it describes when asked, (kind, description).
        answers: by topic id of a request, the topic id of its response and the function that makes it.
        received: messages on its own topics.
        asked: how often it was asked for its topics.
        times: times of the host's clock that it received, ns.
        stopped: the host has said goodbye.
    """

    def __init__(self, endpoints: Sequence[Tuple[wire.ReservedId, wire.TopicInfo]] = ()):
        self.endpoints = list(endpoints)
        self.answers: Dict[int, Tuple[int, Callable[[bytes], bytes]]] = {}
        self.received: List[SerialFrame] = []
        self.times: List[int] = []
        self.asked = 0
        self.stopped = False
        self._parser = FrameParser()

    def receive(self, data: bytes) -> bytes:
        """Take bytes from the host; returns its answer."""
        return b"".join(self._answer(frame) for frame in self._parser.feed(data))

    def ask_time(self) -> bytes:
        """A TIME request."""
        return encode(SerialFrame(wire.ReservedId.TIME, bytes(8)))

    def _answer(self, frame: SerialFrame) -> bytes:
        if frame.topic_id == wire.ReservedId.PUBLISHER:
            self.asked += 1
            infos = [encode(SerialFrame(kind, wire.encode_topic_info(info))) for kind, info in self.endpoints]
            return self.ask_time() + b"".join(infos)
        if frame.topic_id == wire.ReservedId.TIME:
            self.times.append(wire.decode_time(frame.payload))
        elif frame.topic_id == wire.ReservedId.STOP:
            self.stopped = True
        elif frame.topic_id in self.answers:
            response_id, answer = self.answers[frame.topic_id]
            return encode(SerialFrame(response_id, answer(frame.payload)))
        else:
            self.received.append(frame)
        return b""
