"""One rosserial session with a device, without port and ROS: bytes, times and messages in, bytes and events out.

Times are seconds of a clock that never steps; only the answer to the device's TIME request is the robot's clock.
"""
# SPDX-License-Identifier: Apache-2.0
import math
from typing import Callable, Dict, List, NamedTuple, Optional

from . import wire
from .endpoints import Endpoint, Endpoints
from .frames import Frame, FrameParser, encode
from .health import Health, LineProblem
from .parameters import LinkParameters

NS = 1e-9


class Event(NamedTuple):
    """Something that the outside has to act on; exactly one field is set."""

    opened: Optional[Endpoint] = None     # a topic or service of the device is known
    message: Optional[Frame] = None       # a message of a known endpoint; topic_id is the endpoint's
    log: Optional[wire.LogLine] = None    # the device says a sentence
    refused: str = ""                     # an endpoint cannot be served, and why


class Session:
    """Negotiates, keeps the link, and judges it.

    Attributes:
        endpoints: of the device, as far as it has told them.
        health: counters and the state of the line.
        outbox: bytes for the port, in order; whoever writes them takes them out.
    """

    def __init__(self, parameters: LinkParameters, md5_of: Callable[[str], Optional[str]],
                 robot_clock_ns: Callable[[], int]):
        self._parameters = parameters
        self._robot_clock_ns = robot_clock_ns
        self._parser = FrameParser(parameters.max_payload_bytes)
        self._events: List[Event] = []
        self._asked_s = -math.inf
        self._byte_s = -math.inf
        self.endpoints = Endpoints(md5_of)
        self.health = Health(parameters)
        self.outbox: List[bytes] = []

    def start(self, now_s: float) -> None:
        """The port has just been opened."""
        self.health.start(now_s)
        self._ask(now_s)

    def receive(self, data: bytes, now_s: float) -> List[Event]:
        """Bytes from the port."""
        # What was cut off does not go on after a pause: a device sends a frame in one go.
        frames = self._parser.forget() if now_s - self._byte_s > self._parameters.frame_gap_s else []
        frames += self._parser.feed(data)
        self._byte_s = now_s
        for frame in frames:
            self._take(frame, now_s)
        self.health.heard(len(data), self._parser.counts, now_s)
        return self._flush()

    def tick(self, now_s: float) -> List[Event]:
        """To be called now and then, at least each tick_s: asks a silent device for its topics."""
        if self._parser.is_midway and now_s - self._byte_s > self._parameters.frame_gap_s:
            for frame in self._parser.forget():
                self._take(frame, now_s)
            self.health.heard(0, self._parser.counts, now_s)
        wanting = self.problem(now_s) is not LineProblem.NONE or not self.endpoints.by_id
        if wanting and now_s - self._asked_s >= self._parameters.ask_every_s:
            self._ask(now_s)
        return self._flush()

    def send(self, name: str, payload: bytes) -> bool:
        """A message for the device; False when it has no such topic or cannot take it, which is counted."""
        endpoint = self.endpoints.to_device.get(name)
        if endpoint is None or len(payload) > endpoint.info.buffer_bytes:
            self.health.drop(name, len(payload), endpoint.info.buffer_bytes if endpoint else None)
            return False
        self._put(Frame(endpoint.info.topic_id, payload))
        return True

    def stop(self) -> None:
        """Tell the device that nobody listens any more."""
        self._put(Frame(wire.Special.STOP, b""))

    def problem(self, now_s: float) -> LineProblem:
        """What is wrong with the line."""
        return self.health.problem(now_s)

    def _take(self, frame: Frame, now_s: float) -> None:
        self.health.frame(now_s)
        special = self._SPECIAL.get(frame.topic_id)
        try:
            if special:
                special(self, frame, now_s)
            elif frame.topic_id in self.endpoints.by_id:
                self._events.append(Event(message=frame))
            else:
                self._unknown(now_s)
        except wire.WireError as error:
            self.health.refuse(str(error))

    def _take_info(self, frame: Frame, _: float) -> None:
        endpoint, refusal = self.endpoints.add(wire.Special(frame.topic_id), wire.decode_topic_info(frame.payload))
        if refusal:
            self.health.refuse(refusal)
            self._events.append(Event(refused=refusal))
        if endpoint:
            self._events.append(Event(opened=endpoint))

    def _take_time(self, frame: Frame, now_s: float) -> None:
        self._put(Frame(wire.Special.TIME, wire.encode_time(self._robot_clock_ns())))

    def _take_log(self, frame: Frame, _: float) -> None:
        self._events.append(Event(log=wire.decode_log(frame.payload)))

    def _take_parameter(self, frame: Frame, _: float) -> None:
        self.health.refuse("The firmware asks for a parameter; this bridge serves none.")

    def _unknown(self, now_s: float) -> None:
        """The device goes on from an earlier session, or its description was lost on the way."""
        self.health.unknown_topics += 1
        if now_s - self._asked_s >= self._parameters.ask_every_s:
            self._ask(now_s)

    def _ask(self, now_s: float) -> None:
        self._asked_s = now_s
        self._put(Frame(wire.Special.PUBLISHER, b""))

    def _put(self, frame: Frame) -> None:
        self.outbox.append(encode(frame))

    def _flush(self) -> List[Event]:
        events, self._events = self._events, []
        return events

    _SPECIAL: Dict[int, Callable[["Session", Frame, float], None]] = {
        wire.Special.PUBLISHER: _take_info, wire.Special.SUBSCRIBER: _take_info,
        wire.Special.SERVICE_RESPONSE: _take_info, wire.Special.SERVICE_REQUEST: _take_info,
        wire.Special.PARAMETER: _take_parameter, wire.Special.LOG: _take_log, wire.Special.TIME: _take_time,
    }
