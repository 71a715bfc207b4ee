"""Device side of the protocol, for tests of the host."""
# SPDX-License-Identifier: Apache-2.0
from typing import Callable, Dict, List, Sequence, Tuple

from . import wire
from .frames import FrameParser, SerialFrame, encode


class FakeSerialDevice:
    """Microcontroller with given endpoints, which answers negotiation and requests.

    Attributes:
        endpoints: described on request, (kind, description).
        answers: topic id of a request -> topic id of its response and the function that computes it.
        received: messages on its own topics.
        asked: number of requests for its topics.
        times: received times of the host's clock, ns.
        stopped: True after the host's stop message.
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
        """Process bytes from the host and return the answer."""
        return b"".join(self._answer(frame) for frame in self._parser.feed(data))

    def ask_time(self) -> bytes:
        """Return a TIME request."""
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
